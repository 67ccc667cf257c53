/// Forces across a gap in closed form, and the voltage at which a plate gives way.

#include <cmath>

#include "mechanics/surface_forces.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "paper/cell_forces.hpp"
#include "verification/closed_forms.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {

Section surfaceForcesSection() {
  using namespace surface_forces;
  constexpr double kHamaker = 65e-21;
  const char* kPlates = "Israelachvili 2011, chapter 13";
  const char* kField = "eps0 U^2/(2 (d + t/eps_r)^2)";
  InterfaceOptions interface;
  interface.hamaker_constant = kHamaker;
  interface.insulator_thickness = 100e-9;
  interface.insulator_relative_permittivity = 3.9;
  const double cell_area = 400e-18;
  const CellForces cell(interface, PaperOptions().cutoff_distance, 10.0, cell_area);
  InterfaceOptions vacuum = interface;
  vacuum.insulator_thickness = 0.0;

  Section section{"Forces across the gap", {}};
  section.rows = {
      published("(2), pressure of plates, 65 zJ, 10 nm", "Pa", kPlates,
                vanDerWaalsPressure(10e-9, kHamaker), "3.448e3"),
      published("(2), the same by one cell of the model", "Pa", kPlates,
                cell.vanDerWaals(10e-9) / cell_area, "3.448e3"),
      exact("a cell closer than the cut-off of 0.165 nm", "Pa", "A/(6 pi D0^3)",
            cell.vanDerWaals(0.05e-9) / cell_area,
            kHamaker / (6.0 * closed_form::kPi * std::pow(0.165e-9, 3))),
      published("(3), 10 V across 100 nm of vacuum", "Pa", kField,
                electrostaticPressure(100e-9, 10.0, 0.0, 1.0), "44.271e3"),
      published("(3), vacuum, by one cell of the model", "Pa", kField,
                CellForces(vacuum, PaperOptions().cutoff_distance, 10.0, cell_area)
                        .electrostatic(100e-9) /
                    cell_area,
                "44.271e3"),
      published("(3), 10 V, closed on 100 nm of oxide", "Pa", kField,
                electrostaticPressure(0.0, 10.0, 100e-9, 3.9), "673.36e3"),
      published("(3), oxide, by one cell of the model", "Pa", kField,
                cell.electrostaticInContact() / cell_area, "673.36e3"),
      exact("(3), 10 V, 40 nm of vacuum on 100 nm of oxide", "Pa", kField,
            cell.electrostatic(40e-9) / cell_area,
            0.5 * closed_form::kVacuumPermittivity * std::pow(10.0 / (40e-9 + 100e-9 / 3.9), 2)),
      published("pull-in, k = 1 N/m, g = 2 um, A = 1e-8 m^2", "V", "sqrt(8 k g^3/(27 eps0 A))",
                pullInVoltage(1.0, 2e-6, 1e-8), "5.1741"),
  };
  // the largest voltage at which the field of a plate moved by x is balanced by k x
  double largest = 0.0;
  for (int step = 1; step < 20000; ++step) {
    const double travel = 2e-6 * step / 20000.0;
    const double gap = 2e-6 - travel + 0.3e-6 / 3.9;
    largest = std::fmax(
        largest, std::sqrt(2.0 * travel * gap * gap / (closed_form::kVacuumPermittivity * 1e-8)));
  }
  section.rows.push_back(near("pull-in with 0.3 um of oxide", "V",
                              "largest voltage that the spring balances, by search",
                              pullInVoltage(1.0, 2e-6, 1e-8, 0.3e-6, 3.9), largest, 1e-7,
                              "a maximum found in steps of 5e-5 of the gap"));
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
