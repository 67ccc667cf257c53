#include "verdict/missing_scan.hpp"

#include <algorithm>
#include <cmath>

#include "errors/short_number.hpp"
#include "loads/force_range.hpp"
#include "mechanics/traction_law.hpp"
#include "numeric/constants.hpp"
#include "numeric/rounding.hpp"

namespace mems_stiction {
namespace {

/// Light does not tell apart what is nearer than some 0.3 um: two of these pixels [m].
constexpr double kPixelOfLight = 150e-9;
/// No tip draws less [m].
constexpr double kSmallestPixel = 1e-9;
/// Pixels along the side of a usual scan.
constexpr double kFewPixels = 100.0;
constexpr double kManyPixels = 500.0;
/// By as much as this the shortest wave exceeds two pixels where a tip has drawn it.
constexpr double kByTip = 1.01;

std::string inUnits(double length) {
  return length < 0.9995e-6 ? shortNumber(length * 1e9, 3) + " nm"
                            : shortNumber(length * 1e6, 3) + " um";
}

/// At a wave of this length flattening costs a quarter of the work of adhesion [m].
double flattenedHeight(double wavelength, const Options& options) {
  const double modulus = ContactPair(options.lower, options.upper).contact_modulus;
  return std::sqrt(options.interface.work_of_adhesion * wavelength / (2.0 * kPi * modulus));
}

}  // namespace

ShortWaves shortWaves(const UnresolvedWaves& waves, const Options& options) {
  ShortWaves found;
  found.waves = waves;
  if (!(options.interface.work_of_adhesion > 0.0)) return found;  // nothing holds
  const double reach = std::max(forceRange(options.interface, options.lower, options.upper),
                                options.capillary.law().gapLimit());
  const double flattened = flattenedHeight(waves.shortest_shown, options);
  found.limit = std::max(reach, flattened);
  if (!found.areUnresolved()) return found;
  // h falls as p^H, what is flattened as p^(1/2)
  double share = std::pow(reach / waves.rms_height, 1.0 / waves.hurst);
  const double excess = waves.hurst - 0.5;
  if (excess > 0.0)
    share = std::max(share, std::pow(std::min(flattened / waves.rms_height, 1.0), 1.0 / excess));
  found.needed_pitch = std::max(roundedDown(0.5 * waves.shortest_shown * share), kSmallestPixel);
  return found;
}

std::string whatIsMissing(const ShortWaves& found, const std::string& who) {
  if (!found.areUnresolved()) return "";
  const bool is_by_tip = found.waves.shortest_shown > kByTip * 2.0 * found.waves.pitch;
  const std::string waves =
      is_by_tip ? "than " + inUnits(found.waves.shortest_shown) + ", which are the tip's,"
                : "than two pixels of " + inUnits(found.waves.pitch);
  const std::string what = " what holds: waves shorter " + waves + " have an rms height of some " +
                           shortNumber(found.waves.rms_height * 1e9, 2) +
                           " nm, and adhesion bridges " + shortNumber(found.limit * 1e9, 2) +
                           " nm; ";
  constexpr double kRoundOff = 1e-9;
  if (!is_by_tip && found.waves.pitch <= (1.0 + kRoundOff) * kSmallestPixel) {
    return who + what + "no scan resolves them: they need pixels below " + inUnits(kSmallestPixel) +
           "; are these heights noise?";
  }
  const std::string instrument = found.needed_pitch <= kPixelOfLight ? "AFM" : "a scan";
  return who + what + "missing is " + instrument + (is_by_tip ? " with a sharper tip" : "") + ", " +
         inUnits(kFewPixels * found.needed_pitch) + " to " +
         inUnits(kManyPixels * found.needed_pitch) + " wide, pixels of " +
         inUnits(found.needed_pitch) + " or less, beside which coarser scans serve as wide ones";
}

}  // namespace mems_stiction
