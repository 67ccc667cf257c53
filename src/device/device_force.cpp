#include "mems_stiction/device/device_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "device/device_area.hpp"
#include "device/made_surface.hpp"
#include "device/surface_law.hpp"
#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/verdict/margin_uncertainty.hpp"
#include "numeric/constants.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {
namespace {

/// The spectrum still rises towards its longest waves from this slope on, by more than its standard error [-].
constexpr double kRising = 1.0;

void check(const DeviceSurfaces& surfaces, const DeviceArea& area, const DeviceForceOptions& options) {
  std::vector<std::string> violations = rangeViolations(options);
  if (!Range::positive().contains(area.area)) {
    violations.push_back("device/contact_area: " + numberText(area.area) + " m^2 is not allowed, must be > 0 m^2");
  }
  if (area.contacts < 1) {
    violations.push_back("device/contacts: " + std::to_string(area.contacts) + " is not allowed, must be >= 1");
  }
  if (surfaces.scans.empty()) violations.emplace_back("the force of a device needs at least one scan of its surface");
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

double deviation(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double longerPitch(const HeightMap& surface) { return std::max(surface.pitchX(), surface.pitchY()); }

std::vector<HeightMap> mapsOf(const std::vector<NamedScan>& scans) {
  std::vector<HeightMap> maps;
  for (const NamedScan& scan : scans) maps.push_back(scan.surface);
  return maps;
}

/// The laws of both surfaces; the upper one may be a plane.
struct Laws {
  SurfaceLaw lower;
  std::optional<SurfaceLaw> upper;
};

/// What the scans say, and what they would say if they had been other ones of the same surface.
class Surfaces {
 public:
  Surfaces(const DeviceSurfaces& scanned, double side)
      : lower_(mapsOf(scanned.scans)), upper_(mapsOf(scanned.counter_surface)), side_(side) {
    laws_.lower = surfaceLawOf(lower_);
    if (!upper_.empty()) laws_.upper = surfaceLawOf(upper_);
  }

  const Laws& laws() const { return laws_; }

  /// Of scans like those that there are, made by the laws.
  Laws again(std::uint64_t seed) const {
    Laws laws;
    laws.lower = again(laws_.lower, lower_, seed);
    if (laws_.upper) laws.upper = again(*laws_.upper, upper_, seed + 500);
    return laws;
  }

 private:
  SurfaceLaw again(const SurfaceLaw& law, const std::vector<HeightMap>& scans, std::uint64_t seed) const {
    std::mt19937_64 engine(seed);
    const SpectrumContinuation continuation = drawnContinuation(law, side_, engine);
    std::vector<HeightMap> made;
    for (const HeightMap& scan : scans) made.push_back(madeScan(law, continuation, scan, side_, engine()));
    return surfaceLawOf(made);
  }

  std::vector<HeightMap> lower_;
  std::vector<HeightMap> upper_;
  double side_;
  Laws laws_;
};

/// Logarithms of figures, by realisation.
struct Logs {
  std::vector<double> force;
  std::vector<double> work;

  void add(const Realisation& realisation) {
    force.push_back(std::log(std::max(realisation.pull_off_force, std::numeric_limits<double>::min())));
    work.push_back(std::log(std::max(realisation.apparent_work_of_adhesion, std::numeric_limits<double>::min())));
  }
};

/// The end of a 95 % interval over the median: constants and model by their samples, surfaces by Student's distribution.
double endOf(const std::vector<double>& samples, double share, double of_surfaces) {
  const double of_constants = samples.empty() ? 0.0 : std::log(quantile(samples, share));
  return std::exp((share < 0.5 ? -1.0 : 1.0) * std::hypot(of_constants, of_surfaces));
}

/// What chi^2/freedom is not below, or above, in 2.5 % of cases (Wilson and Hilferty).
double chiSquareFactor(double freedom, double normal) {
  const double term = 2.0 / (9.0 * freedom);
  return std::pow(std::max(1.0 - term + normal * std::sqrt(term), 0.0), 3);
}

void showSpectrum(const SurfaceLaw& law, double side, DeviceForce& force) {
  const MergedSpectrum& spectrum = law.heights;
  const double from = std::min(2.0 * kPi / side, spectrum.bands.front().wave_number);
  for (const SpectrumBand& band : spectrum.bands) {
    BandOfWaves shown;
    shown.wavelength = 2.0 * kPi / band.wave_number;
    shown.density = band.density;
    shown.density_lower = band.density * chiSquareFactor(band.freedom, -1.96);
    shown.density_upper = band.density * chiSquareFactor(band.freedom, 1.96);
    shown.rms_height = spectrum.rootMean(0, band.wave_number, spectrum.largest_wave_number);
    shown.rms_slope = spectrum.rootMean(1, from, band.wave_number);
    shown.rms_curvature = spectrum.rootMean(2, from, band.wave_number);
    force.spectrum.push_back(shown);
  }
}

void warnOfLongWaves(const SurfaceLaw& law, const DeviceSurfaces& surfaces, double side, DeviceForce& force) {
  const double longest = law.longestWave();
  if (longest >= side || law.slope - law.slope_deviation < kRising) return;
  const NamedScan* widest = &surfaces.scans.front();
  for (const NamedScan& scan : surfaces.scans) {
    if (scan.surface.cols() * scan.surface.pitchX() > widest->surface.cols() * widest->surface.pitchX()) {
      widest = &scan;
    }
  }
  force.warnings.push_back("roughness still rises towards the longest waves that the scans show (" +
                           shortNumber(longest * 1e6, 2) + " um, by " + widest->name +
                           "): measure a field of at least " + shortNumber(side * 1e6, 2) + " um, pixels of " +
                           shortNumber(longest / 16.0 * 1e9, 2) +
                           " nm will do. Until then the interval holds what longer waves may do");
}

}  // namespace

DeviceForce deviceForce(const DeviceSurfaces& surfaces, const DeviceArea& area, const Options& model,
                        const UncertaintyOptions& uncertainty, const DeviceForceOptions& options,
                        const std::function<void(double)>& on_progress) {
  check(surfaces, area, options);
  DeviceForce force;
  force.area = area.area;
  const auto progress = [&](double share) {
    if (on_progress) on_progress(share);
  };
  progress(0.0);

  AdhesionModel adhesion(model);
  double finest = std::numeric_limits<double>::infinity();
  for (const NamedScan& scan : surfaces.scans) finest = std::min(finest, longerPitch(scan.surface));
  double force_per_area = 0.0;
  double work = 0.0;
  int conforming = 0;
  Prediction scan_prediction;
  for (const NamedScan& scan : surfaces.scans) {
    if (longerPitch(scan.surface) > 1.5 * finest) continue;
    Options of_scan = model;
    of_scan.load.mechanical_load *= scan.surface.area() / surfaces.scans.front().surface.area();
    adhesion.setOptions(of_scan);
    scan_prediction = adhesion.predict(scan.surface);
    force_per_area += scan_prediction.pull_off_force / scan_prediction.nominal_area;
    work += scan_prediction.apparent_work_of_adhesion;
    if (scan_prediction.is_conforming) ++conforming;
    force.parts_of_scans.push_back({scan_prediction.nominal_area, scan_prediction.pull_off_force});
  }
  const auto fine_count = static_cast<double>(force.parts_of_scans.size());
  force.linear_pull_off_force = force_per_area / fine_count * area.area;
  force.pitch = options.pitch > 0.0 ? options.pitch : finest;

  const DevicePieces pieces = piecesOf(area, force.pitch, options.max_cells);
  const Surfaces known(surfaces, pieces.side());
  showSpectrum(known.laws().lower, pieces.side(), force);
  warnOfLongWaves(known.laws().lower, surfaces, pieces.side(), force);

  Logs stated;  // by the law of the scans
  Logs others;  // by the laws that other scans of the same surface would give
  std::vector<double> counts;
  std::vector<double> gaps;
  DeviceAreaSolver solver(model, surfaces.scans.front().surface.area(), pieces);
  for (int i = 0; i < options.realisations; ++i) {
    const std::uint64_t seed = static_cast<std::uint64_t>(options.seed) * 1000003 + static_cast<std::uint64_t>(i) * 1009;
    const Realisation realisation = solver.realise(known.laws().lower, known.laws().upper, seed);
    progress((i + 0.5) / options.realisations);
    force.realisations.push_back(realisation);
    stated.add(realisation);
    counts.push_back(realisation.contacts);
    gaps.push_back(realisation.separation_at_rest);
    const Laws again = known.again(seed + 1);
    others.add(solver.realise(again.lower, again.upper, seed + 2));
    progress((i + 1.0) / options.realisations);
  }
  force.pull_off_force = std::exp(median(stated.force));
  force.apparent_work_of_adhesion = std::exp(median(stated.work));
  force.contacts = median(counts);
  force.separation_at_rest = median(gaps);
  const double once_more = std::sqrt(1.0 + 1.0 / options.realisations);
  force.force_deviation = deviation(others.force) * once_more;
  force.work_deviation = deviation(others.work) * once_more;

  UncertaintyOptions constants = uncertainty;
  constants.scan_sampling = false;
  Prediction like = scan_prediction;
  like.pull_off_exponents = solver.lastForceExponents();
  like.work_exponents = solver.lastWorkExponents();
  const AdhesionSpread spread = adhesionSpread(like, model, constants);
  const double student = studentQuantile(options.realisations - 1);
  const auto take = [&](const std::vector<double>& samples, double of_surfaces, double value, double& lower,
                        double& upper) {
    lower = value * endOf(samples, kLowerShare, student * of_surfaces);
    upper = value * endOf(samples, kUpperShare, student * of_surfaces);
  };
  take(spread.pull_off, force.force_deviation, force.pull_off_force, force.pull_off_force_lower,
       force.pull_off_force_upper);
  take(spread.apparent_work, force.work_deviation, force.apparent_work_of_adhesion,
       force.apparent_work_of_adhesion_lower, force.apparent_work_of_adhesion_upper);
  for (const std::string& warning : solver.warnings()) force.warnings.push_back(warning);
  return force;
}

}  // namespace mems_stiction
