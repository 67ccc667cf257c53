#include "mems_stiction/configuration/configuration.hpp"

#include <cstdint>
#include <string>
#include <utility>

#include "configuration/usual_values.hpp"
#include "contact/guidance_setting.hpp"
#include "height_map/scan_sanity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/height_map/scan_identity.hpp"
#include "surface/counter_surface.hpp"

namespace mems_stiction {

void ScanLimits::describe(OptionVisitor& visitor) {
  visitor.integer(
      "limits/max_pixels", max_pixels, Range::within(1, 1000000000),
      "scans with more pixels, after refinement, are refused; a pixel takes up to 150 bytes");
  visitor.number(kMaxTime, max_time, "s", Range::nonNegative(),
                 "a scan that takes longer is given up, so that it does not hold up the next ones; "
                 "0 = no limit");
  visitor.flag(kAcceptImplausible, accept_implausible,
               "take scans and constants that no instrument, material or device has: they are "
               "refused otherwise");
}

std::string ScanLimits::howToAccept() {
  return std::string("; ") + kAcceptImplausible +
         ": true takes it as it is (--accept-implausible of programs)";
}

void ScanLimits::checkPlausibility(const HeightMap& cleaned, bool is_probe) const {
  if (accept_implausible) return;
  const std::vector<std::string> lines = scanRemarks(cleaned, is_probe).implausible;
  if (!lines.empty()) throw SurfaceError("implausible: " + lines.front() + howToAccept());
}

void ScanLimits::checkSize(const HeightMap& scan, int refinement) const {
  const std::uint64_t factor = static_cast<std::uint64_t>(refinement);
  const std::uint64_t rows = static_cast<std::uint64_t>(scan.rows()) * factor;
  const std::uint64_t cols = static_cast<std::uint64_t>(scan.cols()) * factor;
  if (rows * cols <= static_cast<std::uint64_t>(max_pixels)) return;
  throw SurfaceError("a scan of " + std::to_string(cols) + " x " + std::to_string(rows) +
                     " pixels" + (factor > 1 ? ", as refined," : "") +
                     " is larger than limits/max_pixels = " + std::to_string(max_pixels));
}

void Configuration::describe(OptionVisitor& visitor) {
  model.describe(visitor);
  spatial_roughness.describe(visitor);
  part.describe(visitor);
  scan.describe(visitor);
  limits.describe(visitor);
  resolution.describe(visitor);
  preprocessing.describe(visitor);
  counter_surface.describe(visitor);
  device.describe(visitor);
  describeGuidance(visitor, model.guidance);
  device_force.describe(visitor);
  uncertainty.describe(visitor);
  half_space.describe(visitor);
}

double Configuration::tipRadius() const {
  return resolution.tip_radius > 0.0 ? resolution.tip_radius : preprocessing.tip.radius;
}

std::vector<std::string> Configuration::validate() const {
  std::vector<std::string> violations = model.validate();
  for (const std::vector<std::string>& of_section :
       {rangeViolations(spatial_roughness), rangeViolations(scan), rangeViolations(limits),
        rangeViolations(resolution), rangeViolations(preprocessing),
        rangeViolations(counter_surface), rangeViolations(uncertainty), rangeViolations(half_space),
        rangeViolations(device_force)}) {
    violations.insert(violations.end(), of_section.begin(), of_section.end());
  }
  const std::vector<std::string> of_device = device.validate();
  violations.insert(violations.end(), of_device.begin(), of_device.end());
  if (model.load.device_force > 0.0 && !(device.contact_area > 0.0)) {
    violations.push_back(
        "load/device_force: " + numberText(model.load.device_force) +
        " N is not allowed without device/contact_area; must be 0 N, or the area be stated");
  }
  if (scan.height_scale == 0.0) {
    violations.emplace_back(
        "scan/height_scale: 0 m per unit of the pixel is not allowed, it makes every surface flat; "
        "must not be 0");
  }
  if ((scan.pitch_x > 0.0) != (scan.pitch_y > 0.0)) {
    violations.push_back("scan/pitch_x: " + numberText(scan.pitch_x) + " m with scan/pitch_y " +
                         numberText(scan.pitch_y) +
                         " m is not allowed; both must be > 0 m, or both 0");
  }
  const SpatialRoughnessOptions& fit = spatial_roughness;
  if (fit.hurst_shortest_wavelength > 0.0 && fit.hurst_longest_wavelength > 0.0 &&
      fit.hurst_shortest_wavelength >= fit.hurst_longest_wavelength) {
    violations.push_back(
        "output/hurst_longest_wavelength: " + numberText(fit.hurst_longest_wavelength) +
        " m is not allowed, must be > output/hurst_shortest_wavelength " +
        numberText(fit.hurst_shortest_wavelength) + " m");
  }
  if (!limits.accept_implausible) {
    for (const std::string& line : settingRemarks(*this).implausible) {
      violations.push_back(line + ScanLimits::howToAccept());
    }
  }
  const std::pair<const char*, const std::string&> names[] = {{"part/id", part.id},
                                                              {"part/serial", part.serial},
                                                              {"part/lot", part.lot},
                                                              {"part/wafer", part.wafer}};
  for (const auto& [key, name] : names) {
    if (name.size() <= kLongestName) continue;
    violations.push_back(std::string(key) + ": a name of " + std::to_string(name.size()) +
                         " bytes is not allowed, must have at most " +
                         std::to_string(kLongestName));
  }
  if (counter_surface.type == CounterSurfaceType::kFile && counter_surface.file.empty()) {
    violations.emplace_back(
        "counter_surface/file: '' is not allowed with counter_surface/type file; must name a file");
  }
  if (counter_surface.isMeasured() && counter_surface.facing == CounterSurfaceFacing::kUnstated) {
    violations.push_back(facingComplaint());
  }
  return violations;
}

void Configuration::check() const {
  std::vector<std::string> violations = validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

}  // namespace mems_stiction
