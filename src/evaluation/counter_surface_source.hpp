#pragma once

/// @file
/// The configured counter-surface, ready on the grid of whatever scan comes: cleaned, mounted, in
/// its pose.
///
/// A measured counter-surface is cleaned as the scan is (same steps; the tip is taken off while its
/// asperities point up), then turned over if it faces up, then put in its pose. A generated one
/// needs no cleaning. No work is done twice: a measured surface is cleaned once, a generated one is
/// drawn once per scan grid and, with a correlation, fitted to each scan; either is resampled once
/// per pose.

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "surface/counter_surface.hpp"

namespace mems_stiction {

/// Gives the counter-surface that belongs over a scan, of whatever type is configured.
class CounterSurfaceSource {
 public:
  /// - @p scan how pixels of the file become heights, where it does not say so itself
  /// - @p cleaning the steps of the scan, without refinement, which is left to the caller
  /// - @p limits whether implausible heights are taken
  CounterSurfaceSource(const CounterSurfaceOptions& options, const ScanOptions& scan,
                       const PipelineOptions& cleaning, const ScanLimits& limits);

  /// Reads and cleans the file of type file; nothing for other types.
  /// @throw FileError, OptionsError, SurfaceError naming the file.
  void load();

  /// @throw OptionsError if the pose is out of range; then nothing changes.
  void setPose(const SurfacePose& pose);
  const SurfacePose& pose() const { return options_.pose; }

  /// A surface that was measured beside the scans takes the place of the configured one; empty: no
  /// longer. It is cleaned when it is first asked for.
  /// @throw OptionsError if counter_surface/facing does not say how it lies; then nothing changes.
  void setMeasured(const HeightMap& measured);

  /// The counter-surface on the scan's grid; empty for a level plane. A measured one of another
  /// grid is not resampled, it belongs to another scan: it is returned as it is, and the model
  /// refuses the pair.
  /// @throw SurfaceError for type topic without a measured surface, or one that is implausible,
  /// cannot be cleaned, cannot be drawn on this grid or does not overlap it.
  HeightMap over(const HeightMap& scan);

  /// What is odd about the counter-surface that over() has given for this scan, in words: a
  /// measured one that does not look like a scan (scan_sanity.hpp), or that covers less than nine
  /// tenths of the scan's valid pixels.
  std::vector<std::string> warnings(const HeightMap& scan) const;

  /// How many measured surfaces have been cleaned so far. For any thread.
  std::uint64_t cleanings() const { return cleanings_; }

 private:
  /// The measured surface or that of the file, cleaned and turned over, before its pose.
  HeightMap mounted(const HeightMap& measured);
  /// What lies over the scan before its pose, on whatever grid it has.
  HeightMap unplaced(const HeightMap& scan);

  CounterSurfaceOptions options_;
  ScanOptions scan_;
  ScanCleaner cleaner_;
  ScanLimits limits_;
  HeightMap measured_;          ///< beside the scans, as it came
  HeightMap mounted_measured_;  ///< the same before its pose; empty: not asked for yet
  HeightMap surface_;  ///< mounted, before its pose; of type file, or as drawn on the latest grid
  HeightMap placed_;   ///< in its pose, on the latest grid
  std::vector<std::string> warnings_;           ///< about the surface of the file
  std::vector<std::string> measured_warnings_;  ///< about the measured one
  std::atomic<std::uint64_t> cleanings_{0};
};

}  // namespace mems_stiction
