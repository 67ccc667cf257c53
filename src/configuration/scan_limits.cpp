#include "mems_stiction/configuration/scan_limits.hpp"

#include <cstdint>
#include <string>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

void ScanLimits::describe(OptionVisitor& visitor) {
  visitor.integer("limits/max_pixels", max_pixels, Range::within(1, 1000000000),
                  "scans with more pixels, after refinement, are refused; a pixel takes up to 150 bytes");
  visitor.number(kMaxTime, max_time, "s", Range::nonNegative(),
                 "a scan that takes longer is given up, so that it does not hold up the next ones; 0 = no limit");
}

void ScanLimits::checkSize(const HeightMap& scan, int refinement) const {
  const std::uint64_t factor = static_cast<std::uint64_t>(refinement);
  const std::uint64_t rows = static_cast<std::uint64_t>(scan.rows()) * factor;
  const std::uint64_t cols = static_cast<std::uint64_t>(scan.cols()) * factor;
  if (rows * cols <= static_cast<std::uint64_t>(max_pixels)) return;
  throw SurfaceError("a scan of " + std::to_string(cols) + " x " + std::to_string(rows) + " pixels" +
                     (factor > 1 ? ", as refined," : "") +
                     " is larger than limits/max_pixels = " + std::to_string(max_pixels));
}

}  // namespace mems_stiction
