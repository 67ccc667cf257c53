#include "mems_stiction/device/device_force.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "device/made_surface.hpp"
#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/verdict/margin_uncertainty.hpp"
#include "numeric/constants.hpp"
#include "roughness/merged_spectrum.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {
namespace {

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

/// Standard deviation [-]
double deviation(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

DeviceForce deviceForce(const DeviceSurfaces& surfaces, const DeviceArea& area, const Options& model,
                        const UncertaintyOptions& uncertainty, const DeviceForceOptions& options,
                        const std::function<void(double)>& on_progress) {
  check(surfaces, area, options);
  AdhesionModel adhesion(model);
  DeviceForce force;
  force.area = area.area;
  std::vector<ScanWaves> waves;
  double finest = 0.0;
  double force_per_area = 0.0;
  for (const NamedScan& scan : surfaces.scans) {
    waves.emplace_back(scan.surface);
    const double pitch = std::max(scan.surface.pitchX(), scan.surface.pitchY());
    if (finest == 0.0 || pitch < finest) finest = pitch;
  }
  int finest_scans = 0;
  Prediction last;
  for (const NamedScan& scan : surfaces.scans) {
    if (std::max(scan.surface.pitchX(), scan.surface.pitchY()) > 1.5 * finest) continue;
    last = adhesion.predict(scan.surface);
    force_per_area += last.pull_off_force / last.nominal_area;
    ++finest_scans;
    force.parts_of_scans.push_back({last.nominal_area, last.pull_off_force});
  }
  force.linear_pull_off_force = force_per_area / finest_scans * area.area;
  const std::vector<ScanTrust> trust = trustOf(waves);
  const MergedSpectrum spectrum = mergedSpectrum(waves, trust, stretchOf(waves, trust));
  force.pitch = options.pitch > 0.0 ? options.pitch : finest;
  const int side = std::max(
      16,
      static_cast<int>(std::lround(std::sqrt(std::min(area.area / (force.pitch * force.pitch), options.max_cells)))));
  std::vector<double> forces;
  std::vector<double> works;
  std::vector<double> counts;
  std::vector<double> gaps;
  for (int i = 0; i < options.realisations; ++i) {
    if (on_progress) on_progress(static_cast<double>(i) / options.realisations);
    const HeightMap made = madeSurface(spectrum, side, side, force.pitch,
                                       static_cast<std::uint64_t>(options.seed) * 1000 + static_cast<std::uint64_t>(i));
    last = adhesion.predict(made);
    const double scale = area.area / last.nominal_area;
    force.realisations.push_back(
        {last.pull_off_force * scale, last.apparent_work_of_adhesion, last.pull_off_contact_count, last.mean_gap});
    forces.push_back(std::log(last.pull_off_force * scale));
    works.push_back(std::log(last.apparent_work_of_adhesion));
    counts.push_back(last.pull_off_contact_count);
    gaps.push_back(last.mean_gap);
  }
  force.pull_off_force = std::exp(median(forces));
  force.apparent_work_of_adhesion = std::exp(median(works));
  force.contacts = median(counts);
  force.separation_at_rest = median(gaps);
  const double factor = std::sqrt(1.0 + 1.0 / options.realisations);
  force.force_deviation = deviation(forces) * factor;
  force.work_deviation = deviation(works) * factor;
  const double student = studentQuantile(options.realisations - 1);
  UncertaintyOptions constants = uncertainty;
  constants.scan_sampling = false;
  const AdhesionSpread spread = adhesionSpread(last, model, constants);
  const auto end = [&](const std::vector<double>& samples, double share, double of_surfaces) {
    return std::exp((share < 0.5 ? -1.0 : 1.0) * std::hypot(std::log(quantile(samples, share)), student * of_surfaces));
  };
  force.pull_off_force_lower = force.pull_off_force * end(spread.pull_off, kLowerShare, force.force_deviation);
  force.pull_off_force_upper = force.pull_off_force * end(spread.pull_off, kUpperShare, force.force_deviation);
  force.apparent_work_of_adhesion_lower =
      force.apparent_work_of_adhesion * end(spread.apparent_work, kLowerShare, force.work_deviation);
  force.apparent_work_of_adhesion_upper =
      force.apparent_work_of_adhesion * end(spread.apparent_work, kUpperShare, force.work_deviation);
  for (const SpectrumBand& band : spectrum.bands) {
    BandOfWaves shown;
    shown.wavelength = 2.0 * kPi / band.wave_number;
    shown.density = band.density;
    force.spectrum.push_back(shown);
  }
  return force;
}

}  // namespace mems_stiction
