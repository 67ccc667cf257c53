#include "roughness/merged_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "roughness/power_spectrum.hpp"

namespace mems_stiction {
namespace {

constexpr double kBandsPerDecade = 10.0;
/// Rings below this belong to the window and the levelling.
constexpr double kFirstRing = 2.5;
/// Of Nyquist's wave number: beyond it pixels blur and alias.
constexpr double kTrustOfNyquist = 0.5;
/// Independent powers per wave vector of half a plane under Hann's window: (sum w^2)^2/(N sum w^4), both axes.
constexpr double kHannFreedom = 0.264;

struct Sum {
  double power = 0.0;
  double count = 0.0;
  double freedom = 0.0;
};

int bandOf(double wave_number) { return static_cast<int>(std::floor(kBandsPerDecade * std::log10(wave_number))); }

using Bands = std::map<int, Sum>;

/// - @p most_trusted wave numbers above it are another scan's [rad/m]
void addRings(const PowerSpectrum& spectrum, double width, double least, double most, Bands& bands) {
  for (const SpectrumRing& ring : spectrum.rings) {
    if (ring.wave_number < least || ring.wave_number > most) continue;
    Sum& sum = bands[bandOf(ring.wave_number)];
    sum.power += ring.count * ring.density;
    sum.count += ring.count;
    sum.freedom += 0.5 * ring.count * kHannFreedom;
  }
  (void)width;
}

}  // namespace

MergedSpectrum mergedSpectrum(const std::vector<SpectrumSource>& scans) {
  double finest = 0.0;
  for (const SpectrumSource& scan : scans) {
    finest = std::max(finest, kPi / std::max(scan.surface->pitchX(), scan.surface->pitchY()));
  }
  Bands together;
  for (const SpectrumSource& scan : scans) {
    const HeightMap& surface = *scan.surface;
    const double width = 2.0 * kPi / std::max(surface.cols() * surface.pitchX(), surface.rows() * surface.pitchY());
    const double shorter = 2.0 * kPi / std::min(surface.cols() * surface.pitchX(), surface.rows() * surface.pitchY());
    const double nyquist = kPi / std::max(surface.pitchX(), surface.pitchY());
    // the finest scan is all that is known of the shortest waves
    const double most = nyquist > 0.75 * finest ? nyquist : kTrustOfNyquist * nyquist;
    const PowerSpectrum spectrum = powerSpectrum(surface, SpectrumWindow::kHann);
    addRings(spectrum, width, kFirstRing * std::max(width, shorter), most, together);
  }
  MergedSpectrum merged;
  for (const auto& [band, sum] : together) {
    if (!(sum.power > 0.0)) continue;
    merged.bands.push_back(
        {std::pow(10.0, (band + 0.5) / kBandsPerDecade), sum.power / sum.count, std::max(sum.freedom, 0.5)});
  }
  if (merged.bands.empty())
    throw SurfaceError("no scan is large enough for a spectrum: 16 pixels a side are the least");
  return merged;
}

}  // namespace mems_stiction
