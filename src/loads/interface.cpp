#include "mems_stiction/loads/interface.hpp"

namespace mems_stiction {

void InterfaceOptions::describe(OptionVisitor& visitor) {
  visitor.number("interface/work_of_adhesion", work_of_adhesion, "J/m^2", Range::nonNegative(),
                 "thermodynamic work of adhesion of the flat interface");
  visitor.number("interface/hamaker_constant", hamaker_constant, "J", Range::nonNegative(),
                 "Hamaker constant of the pair across the medium in the gap, of native films where "
                 "bodies have them; 0 = z0 is interface/equilibrium_distance");
  visitor.number("interface/retardation_length", retardation_length, "m", Range::nonNegative(),
                 "gap at which retardation has halved the attraction; 0 = not retarded");
  visitor.number(
      "interface/equilibrium_distance", equilibrium_distance, "m", Range::positive(),
      "z0 of Tabor's parameter, and of the attraction where interface/hamaker_constant is 0");
  visitor.number(
      "interface/insulator_thickness", insulator_thickness, "m", Range::nonNegative(),
      "thickness of the insulator between the electrodes; must be > 0 when voltage or contact "
      "potential is not 0");
  visitor.number("interface/insulator_relative_permittivity", insulator_relative_permittivity, "",
                 Range{1.0}, "relative permittivity of the insulator");
  visitor.number("interface/hardness_ratio_limit", hardness_ratio_limit, "",
                 Range::openWithin(0.0, 1.0),
                 "a of equation (12): hardness ratios beyond it deform the softer body only");
}

void LoadOptions::describe(OptionVisitor& visitor) {
  visitor.number("load/max_voltage", max_voltage, "V", Range::positive(),
                 "largest voltage that may be set");
  visitor.number("load/max_mechanical_load", max_mechanical_load, "N", Range::positive(),
                 "largest mechanical load that may be set");
  visitor.number("load/voltage", voltage, "V", Range::within(-max_voltage, max_voltage),
                 "voltage between the surfaces");
  visitor.number(
      "load/contact_potential", contact_potential, "V",
      Range::within(-kMostContactPotential, kMostContactPotential),
      "potential between the surfaces that stays when voltage and load have gone; adds to "
      "the size of the voltage, whatever its sign");
  visitor.number("load/mechanical_load", mechanical_load, "N",
                 Range::within(0.0, max_mechanical_load),
                 "external force that presses the scanned area together");
  visitor.number(
      "load/pressure", pressure, "Pa", Range::nonNegative(),
      "instead of mechanical_load: pressure on the nominal area, whatever the size of the scan");
  visitor.number("load/device_force", device_force, "N", Range::nonNegative(),
                 "instead of both: force on the whole device; a scan carries its share of "
                 "device/contact_area");
}

}  // namespace mems_stiction
