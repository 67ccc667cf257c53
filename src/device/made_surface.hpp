#pragma once

/// @file
/// One surface of the device's size, as the scans may have been cut from it: made tile by tile, by
/// the law of the scans (surface_law.hpp) and what is drawn of what that leaves open.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <opencv2/core.hpp>

#include "device/longer_waves.hpp"
#include "device/surface_law.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "surface/tiled_surface.hpp"

namespace mems_stiction {

/// How the spectrum goes on to waves longer than those that are believed: as steeply as at its end,
/// up to a roll-off.
struct SpectrumContinuation {
  double slope = 0.0;    ///< -d ln C/d ln q [-]
  double rolloff = 0.0;  ///< wave number from which on downwards it is flat [rad/m]

  bool operator==(const SpectrumContinuation& other) const {
    return slope == other.slope && rolloff == other.rolloff;
  }
};
/// Whether a contact is so much longer than the longest waves that the scans show that it needs
/// longer ones.
/// - @p side of the device [m]
bool lacksLongWaves(const SurfaceLaw& law, double side);
/// One that the scans leave open: the slope by its standard error, the roll-off anywhere up to
/// waves as long as the device. Flat where the device needs no longer waves.
SpectrumContinuation drawnContinuation(const SurfaceLaw& law, double side, std::mt19937_64& engine);

/// The size of a surface that is made.
struct MadeSize {
  std::int64_t rows = 0;
  std::int64_t cols = 0;
  double pitch_x = 0.0;  ///< [m]
  double pitch_y = 0.0;  ///< [m]

  double sideX() const { return static_cast<double>(cols) * pitch_x; }
  double sideY() const { return static_cast<double>(rows) * pitch_y; }
  bool operator==(const MadeSize& other) const {
    return rows == other.rows && cols == other.cols && pitch_x == other.pitch_x &&
           pitch_y == other.pitch_y;
  }
};

/// How a surface of this size is made soonest: by one transform up to a million pixels, which costs
/// two to three times as much for each pixel as blocks do and needs no kernel; else by blocks.
BlockChoice blocksOf(const MadeSize& size);

/// Beside what a surface lies.
enum class Among {
  kNone,   ///< it rests by itself
  kOthers  ///< under one counter-surface with others
};

/// Heights by tile; one object serves one thread at a time.
class MadeSurface {
 public:
  /// - @p law must outlive the object
  /// - @p longest_wave longer ones are left out: they tilt it [m]
  /// - @p among whether it lies beside others, and longer waves that the scans show raise or
  /// lower it
  MadeSurface(const SurfaceLaw& law, const SpectrumContinuation& continuation, const MadeSize& size,
              double longest_wave, std::uint64_t seed, BlockChoice blocks = BlockChoice::kFast,
              Among among = Among::kNone);

  /// Goes on as the surface of another seed: the same as a new one, but sooner.
  void reseed(std::uint64_t seed);

  /// Tiles of this size are made fastest.
  cv::Size tile() const { return field_.tile(); }
  /// Heights [m] of the tile whose first pixel is (row, col), CV_32FC1; all of it lies in the
  /// surface.
  void heights(std::int64_t row, std::int64_t col, cv::Mat& tile);

 private:
  void addOwnWaves(std::int64_t row, std::int64_t col, cv::Mat& tile);
  void addLongerWaves(std::int64_t row, std::int64_t col, cv::Mat& tile);
  /// Where on the surface and in the widest scan it lies, and how it is tilted.
  void drawPlace(std::uint64_t seed);

  const SurfaceLaw* law_;
  MadeSize size_;
  TiledSurface field_;                      ///< of g, or of z where all is Gaussian
  std::optional<TiledSurface> long_waves_;  ///< Gaussian, beyond the split
  std::optional<HeightTranslation> translation_;
  std::optional<LongerWaves> longer_waves_;  ///< among others alone
  bool has_own_ = false;
  double place_x_ = 0.0;  ///< of the surface in the widest scan [m]
  double place_y_ = 0.0;
  double tilt_x_ = 0.0;
  double tilt_y_ = 0.0;
  cv::Mat spare_;
};

/// Whether a surface of this size takes the long waves of the widest scan, at a place of it.
bool takesOwnWaves(const SurfaceLaw& law, const MadeSize& size);

/// Which of the scans that are made have the long waves of the widest one.
enum class OwnWavesOf {
  kWidest,  ///< those as large as it: others are of any place of such a surface
  kAll      ///< all that fit into it, as surfaces of a device that does
};

/// Makes scans of surfaces of one law, with the pixels and sizes of other scans.
class ScanMaker {
 public:
  /// - @p law must outlive the object
  /// - @p like have these sizes and pixels
  /// - @p longest_wave that the surface has, where it is longer than a scan [m]
  ScanMaker(const SurfaceLaw& law, const std::vector<HeightMap>& like, double longest_wave,
            OwnWavesOf own_waves = OwnWavesOf::kWidest);
  ScanMaker(const ScanMaker&) = delete;
  ScanMaker& operator=(const ScanMaker&) = delete;

  /// - @p engine draws a seed for each
  std::vector<HeightMap> make(const SpectrumContinuation& continuation, std::mt19937_64& engine);

 private:
  /// What scans alike have in common.
  struct Kind {
    MadeSize size;
    bool has_own = false;
    std::optional<MadeSurface> surface;
  };

  const SurfaceLaw* law_;
  SurfaceLaw without_own_;
  double longest_wave_;
  std::optional<SpectrumContinuation> continuation_;
  std::vector<Kind> kinds_;
  std::vector<std::size_t> kind_of_;  ///< of each scan
};

}  // namespace mems_stiction
