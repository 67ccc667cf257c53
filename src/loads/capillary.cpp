#include "mems_stiction/loads/capillary.hpp"

#include <algorithm>
#include <cmath>

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
  visitor.number("interface/temperature", temperature, "K", Range::positive(), "temperature of vapor and surfaces");
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

double cellsBelow(const GapOrder& order, double limit) {
  const int bucket_count = static_cast<int>(order.buckets().size());
  const double limit_in_widths = limit / order.bucketWidth();
  if (limit_in_widths < order.orderedBuckets()) return order.countBelow(limit);
  double count = static_cast<double>(order.cells().size());
  for (int bucket = order.orderedBuckets(); bucket < bucket_count; ++bucket) {
    // the largest gap is the last bucket's upper end, and below any limit past it
    const double covered = std::clamp(limit_in_widths - bucket, 0.0, 1.0);
    if (covered == 0.0) break;
    count += covered * order.buckets()[static_cast<std::size_t>(bucket)].count;
  }
  return count;
}

double capillaryForce(const GapOrder& order, double approach, int contact_count, const CapillaryForce& force,
                      double cell_area) {
  if (!force.isOn()) return 0.0;
  const double filled = cellsBelow(order, approach + force.gapLimit()) - contact_count;
  return std::max(0.0, filled) * force.forcePerCell(cell_area);
}

}  // namespace mems_stiction
