#include "mems_stiction/loads/capillary.hpp"

#include <algorithm>

#include "approach/gap_order.hpp"
#include "mechanics/traction_law.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {

void CapillaryOptions::describe(OptionVisitor& visitor) {
  visitor.number("interface/relative_humidity", relative_humidity, "", Range{0.0, 1.0, false, true},
                 "humidity over saturation for the explicit capillary term; 0 = off, the work of "
                 "adhesion then holds it");
  visitor.number("interface/surface_tension", surface_tension, "N/m", Range::positive(),
                 "surface tension of the condensed liquid");
  visitor.number("interface/contact_angle", contact_angle, "rad", Range::within(0.0, 0.5 * kPi),
                 "contact angle of the condensed liquid on both surfaces");
  visitor.number("interface/temperature", temperature, "K", Range::positive(),
                 "temperature of vapour and surfaces");
  visitor.number("interface/molar_volume", molar_volume, "m^3/mol", Range::positive(),
                 "molar volume of the condensed liquid");
  visitor.number("interface/water_film", water_film, "m", Range::nonNegative(),
                 "thickness of the water that is adsorbed on each face at this humidity: it fills "
                 "gaps beside the Kelvin gap; 0 = none");
}

WaterLaw CapillaryOptions::law() const {
  return {relative_humidity, surface_tension, contact_angle, temperature, molar_volume, water_film};
}

double capillaryForce(const GapOrder& order, double approach, int contact_count,
                      const WaterLaw& water, double cell_area) {
  if (!water.isOn()) return 0.0;
  const double filled = order.cellsBelow(approach + water.gapLimit()) - contact_count;
  return std::max(0.0, filled) * (water.pressure() * cell_area);
}

}  // namespace mems_stiction
