#pragma once

/// @file
/// The configured counter-surface, ready on the grid of whatever scan comes: cleaned, mounted, in its pose.
///
/// A measured counter-surface is cleaned as the scan is (same steps; the tip is taken off while its asperities point
/// up), then turned over if it faces up, then put in its pose. A generated one needs no cleaning. Results are kept: a
/// file is read and cleaned once, a surface is drawn once per scan grid and resampled once per pose.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "mems_stiction/surface/counter_surface.hpp"

namespace mems_stiction {

/// Gives the counter-surface that belongs over a scan, of whatever type is configured.
class CounterSurfaceSource {
 public:
  /// - @p scan how pixels of the file become heights, where it does not say so itself
  /// - @p cleaning the steps of the scan; the last one, refinement, is left to the caller
  CounterSurfaceSource(const CounterSurfaceOptions& options, const ScanOptions& scan, const PipelineOptions& cleaning);

  /// Reads and cleans the file of type file; nothing for other types.
  /// @throw FileError, OptionsError, SurfaceError naming the file.
  void load();

  /// @throw OptionsError if the pose is out of range; then nothing changes.
  void setPose(const SurfacePose& pose);

  /// The counter-surface on the scan's grid; empty for a level plane.
  /// @throw SurfaceError for type topic, which has no surface of its own, or one that cannot be drawn on this grid or
  /// does not overlap it.
  HeightMap over(const HeightMap& scan);

  /// The same with a surface that was measured beside the scan, in place of the configured one.
  /// @throw SurfaceError if their grids differ: such a surface is not resampled, it belongs to another scan.
  HeightMap over(const HeightMap& scan, const HeightMap& measured) const;

 private:
  HeightMap cleaned(const HeightMap& measured) const;

  CounterSurfaceOptions options_;
  ScanOptions scan_;
  PipelineOptions cleaning_;
  HeightMap surface_;  ///< mounted, before its pose; of type file, or the generated one of the latest grid
  HeightMap placed_;   ///< in its pose, on the latest grid
};

}  // namespace mems_stiction
