/// The sums (2) and (3) over a surface, where they have an integral.

#include <cmath>

#include "mems_stiction/paper/paper_options.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "paper/cell_forces.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "support/pinned_surface.hpp"
#include "verification/closed_forms.hpp"
#include "verification/grid_convergence.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr double kHamaker = 65e-21;
constexpr double kThickness = 100e-9;
constexpr double kPermittivity = 3.9;
constexpr double kVoltage = 10.0;
constexpr const char* kPromise = "the sums from histograms keep 2e-4 of the sum over cells";

InterfaceOptions insulated() {
  InterfaceOptions interface;
  interface.hamaker_constant = kHamaker;
  interface.insulator_thickness = kThickness;
  interface.insulator_relative_permittivity = kPermittivity;
  return interface;
}

/// Loads of a surface whose pin alone touches, that of the pin itself taken away.
NormalLoad heldApart(const HeightMap& surface, double gap, double voltage) {
  GapField field;
  field.compute(pinnedSurface(surface, gap));
  GapOrder order;
  order.build(field, 0.5);
  GapLoads loads;
  loads.prepare(order);
  const CellForces forces(insulated(), PaperOptions().cutoff_distance, voltage, field.cellArea());
  NormalLoad load = loads.at(0.0, 1, forces, 0.0);
  load.electrostatic -= 0.5 * closed_form::kVacuumPermittivity * field.cellArea() *
                        std::pow(voltage * kPermittivity / kThickness, 2);
  return load;
}

std::vector<Row> plateRows() {
  const double area = 400e-9 * 300e-9;
  const double gap = 10e-9;
  std::vector<Row> rows = {
      limit("(2), parallel plates of 0.12 um^2, 10 nm", "N", "A/(6 pi D^3) times area",
            kHamaker * area / (6.0 * closed_form::kPi * gap * gap * gap), 1e-9,
            "sums of up to 7500 equal cells", {1.0, "no integral is taken: exact at every pitch"}),
      limit("(3), the same plates, 10 V, 100 nm of oxide", "N",
            "eps0 U^2/(2 (d + t/eps_r)^2) times area",
            0.5 * closed_form::kVacuumPermittivity * area *
                std::pow(kVoltage / (gap + kThickness / kPermittivity), 2),
            1e-9, "sums of up to 7500 equal cells",
            {1.0, "no integral is taken: exact at every pitch"})};
  return onGrids(
      rows, {"columns", {25, 50, 100}, 1}, [=](double cols, const Phase&) -> std::vector<double> {
        const double pitch = 400e-9 / cols;
        const NormalLoad load =
            heldApart(analytic::flat(static_cast<int>(0.75 * cols), static_cast<int>(cols), pitch,
                                     300e-9 / static_cast<int>(0.75 * cols)),
                      gap, kVoltage);
        return {load.van_der_waals, load.electrostatic};
      });
}

/// Gap d0 + s x over a strip of length L and width W.
std::vector<Row> wedgeRows() {
  const double length = 1e-6, width = 100e-9, slope = 0.05, nearest = 5e-9;
  const double farthest = nearest + slope * length;
  const double near_field = nearest + kThickness / kPermittivity;
  const double far_field = farthest + kThickness / kPermittivity;
  std::vector<Row> rows = {
      limit("(2), wedge from 5 to 55 nm", "N", "A W/(12 pi s) (1/d0^2 - 1/d1^2)",
            kHamaker * width / (12.0 * closed_form::kPi * slope) *
                (1.0 / (nearest * nearest) - 1.0 / (farthest * farthest)),
            1e-3, kPromise, {1.8, "a sum over cells is the midpoint rule: second order"}),
      limit("(3), wedge from 5 to 55 nm", "N", "eps0 U^2 W/(2 s) (1/d0' - 1/d1')",
            0.5 * closed_form::kVacuumPermittivity * kVoltage * kVoltage * width / slope *
                (1.0 / near_field - 1.0 / far_field),
            1e-3, kPromise, {1.8, "a sum over cells is the midpoint rule: second order"})};
  return onGrids(rows, {"columns", {25, 50, 100, 200}, 1},
                 [=](double cols, const Phase&) -> std::vector<double> {
                   const double pitch = length / cols;
                   const HeightMap wedge =
                       analytic::tiltedPlane(10, static_cast<int>(cols), pitch, width / 10, -slope,
                                             0.0, -slope * 0.5 * length);
                   const NormalLoad load = heldApart(wedge, nearest, kVoltage);
                   return {load.van_der_waals, load.electrostatic};
                 });
}

/// A paraboloid of radius R at a distance D from a plane; what lies beyond the square frame is
/// added by quadrature.
std::vector<Row> sphereRows() {
  const double radius = 500e-9, gap = 5e-9, side = 800e-9;
  // outside the square: polar, per octant r > (side/2)/cos(phi), where the integral over r is
  // closed
  const int rays = 2000;
  double outside = 0.0;
  for (int i = 0; i < rays; ++i) {
    const double phi = closed_form::kPi / 4.0 * (i + 0.5) / rays;
    const double rim = 0.5 * side / std::cos(phi);
    const double rim_gap = gap + rim * rim / (2.0 * radius);
    outside += 8.0 * closed_form::kPi / 4.0 / rays * radius * kHamaker /
               (12.0 * closed_form::kPi * rim_gap * rim_gap);
  }
  const double whole = kHamaker * radius / (6.0 * gap * gap);
  std::vector<Row> rows = {limit("(2), sphere of 500 nm before a plate, 5 nm", "N", "A R/(6 D^2)",
                                 whole, 1e-3, kPromise,
                                 {4.0, "midpoint rule of a smooth bell: faster than any power"})};
  return onGrids(rows, {"columns", {8, 12, 16, 24}, 4},
                 [=](double cols, const Phase& phase) -> std::vector<double> {
                   const double pitch = side / cols;
                   const auto count = static_cast<int>(cols);
                   const HeightMap sphere =
                       analytic::paraboloid(count, count, pitch, pitch, radius,
                                            (phase.x - 0.5) * pitch, (phase.y - 0.5) * pitch);
                   return {heldApart(sphere, gap, 0.0).van_der_waals + outside};
                 });
}

std::vector<Row> bumpRows() {
  const int rows = 40, cols = 91;
  const double pitch_x = 5e-9, pitch_y = 12e-9, height = 50e-9;
  Options options = paperOptions();
  options.interface = insulated();
  options.load.voltage = kVoltage;
  options.load.max_voltage = 100.0;
  options.deformation =
      Deformation::kElastic;  // so steep a bump would flow until the flat touches too
  const Prediction found = AdhesionModel(options).predict(
      analytic::flatWithBump(rows, cols, pitch_x, pitch_y, height, 5));
  const double cell = pitch_x * pitch_y;
  const double apart = (rows * cols - 25) * cell;
  const double insulator = kThickness / kPermittivity;
  const double gap = height - found.approach;
  const double field = 0.5 * closed_form::kVacuumPermittivity * kVoltage * kVoltage;
  return {
      near("(2), flat held off by a bump of 50 nm", "N", "A/(6 pi h^3) times the open area",
           found.van_der_waals_force, kHamaker * apart / (6.0 * closed_form::kPi * gap * gap * gap),
           1e-9, "sums of 3615 equal cells"),
      near("(3), the same, the bump closed on its oxide", "N",
           "open area and bump, each in closed form", found.electrostatic_force,
           field * apart / ((gap + insulator) * (gap + insulator)) +
               field * 25 * cell / (insulator * insulator),
           1e-9, "sums of 3615 equal cells"),
      exact("total load of these", "N", "F_w + F_e + F_m", found.normal_load,
            found.van_der_waals_force + found.electrostatic_force)};
}

}  // namespace

Section loadSumsSection() {
  Section section{"Loads summed over a surface", {}};
  for (const auto& rows : {plateRows(), wedgeRows(), sphereRows(), bumpRows()}) {
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  }
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
