#include "mems_stiction/loads/capillary.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/approach/gap_order.hpp"
#include "mems_stiction/base/constants.hpp"

namespace mems_stiction {
namespace {

/// Molar gas constant [J/(mol K)], exact since 2019 (CODATA 2018).
constexpr double kGasConstant = 8.31446261815324;

}  // namespace

void CapillaryOptions::describe(OptionVisitor& visitor) {
  visitor.number(
      "interface/relative_humidity", relative_humidity, "", Range{0.0, 1.0, false, true},
      "humidity over saturation for the explicit capillary term; 0 = off, the work of adhesion then holds it");
  visitor.number("interface/surface_tension", surface_tension, "N/m", Range::positive(),
                 "surface tension of the condensed liquid");
  visitor.number("interface/contact_angle", contact_angle, "rad", Range::within(0.0, 0.5 * kPi),
                 "contact angle of the condensed liquid on both surfaces");
  visitor.number("interface/temperature", temperature, "K", Range::positive(), "temperature of vapour and surfaces");
  visitor.number("interface/molar_volume", molar_volume, "m^3/mol", Range::positive(),
                 "molar volume of the condensed liquid");
}

CapillaryForce::CapillaryForce(const CapillaryOptions& options) {
  if (options.relative_humidity <= 0.0) return;
  const double undersaturation = -std::log(options.relative_humidity);
  pressure_ = kGasConstant * options.temperature * undersaturation / options.molar_volume;
  kelvin_radius_ = options.surface_tension / pressure_;
  gap_limit_ = 2.0 * kelvin_radius_ * std::cos(options.contact_angle);
}

double capillaryForce(const GapOrder& order, double approach, int contact_count, const CapillaryForce& force,
                      double cell_area) {
  if (!force.isOn()) return 0.0;
  const double filled = order.cellsBelow(approach + force.gapLimit()) - contact_count;
  return std::max(0.0, filled) * force.forcePerCell(cell_area);
}

}  // namespace mems_stiction
