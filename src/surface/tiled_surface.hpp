#pragma once

/// @file
/// A random rough surface of any size, made tile by tile.
///
/// White noise that is numbered by place (numbered_noise.hpp) is convolved with the root of the
/// spectrum. Waves of all lengths at once would need a kernel as long as the longest, so the
/// spectrum is split into levels by smooth windows of the logarithm of the wave's length, whose
/// squares add up to 1:
///
///     level 0   the pixels                             waves up to 12 to 48 cells
///     level l   cells of 4^l pixels along both axes    waves from 3 to 12 up to 12 to 48 of its
///                                                      cells
///     the last  cells of which the longest wave with a density of its own has at most 12: all
///               longer ones, too
///
/// Each level has noise of its own, convolved in blocks of fixed places (block_convolution.hpp).
/// What levels above 0 make are coefficients of cubic splines, which are refined from level to
/// level (spline_refinement.hpp). So a height depends on the spectrum, the pitch, the seed and its
/// place alone: not on the tile with which it was asked for, nor on what was asked before, nor on
/// rows and cols. Surfaces of one seed are corners of the same endless one.
///
/// Against the spectrum: kernels are cut off where they have lost 3e-4 of the rms height of their
/// level, or at 160 cells; a density that ends sharply is smeared over a wave number of about 2
/// pi/160 cells. Waves of the spline that are shorter than its cells are 1e-3 of the height and
/// less. Waves that the pixels cannot hold are left out. Stretched kernels reach further, and are
/// cut off earlier, down to 96 cells of the shorter axis, where the transform would be too large; a
/// stretch of up to 30 along rows or columns has room in it, 8 in between.
///
/// Sources: convolution of noise by filters, Hu and Tonder, Int. J. Mach. Tools Manufact. 32 (1992)
/// 83; noise in bands that are refined, Perlin, Computer Graphics (SIGGRAPH) 19 (1985) 287;
/// refinement of splines, Unser, IEEE Signal Process. Mag. 16 (1999) 22.
///
///     TiledSurface surface(spectrum, 100000, 100000, 10e-9, 10e-9, 7);
///     cv::Mat tile(surface.tile(), CV_32FC1);
///     surface.heights(row, col, tile);

#include <cstdint>
#include <memory>
#include <optional>

#include <opencv2/core.hpp>

#include "roughness/surface_spectrum.hpp"
#include "surface/block_convolution.hpp"
#include "surface/height_translation.hpp"

namespace mems_stiction {

/// The surface of a seed. An object serves one thread at a time. It takes some 60 MB whatever the
/// size, up to 300 MB where the spectrum is stretched.
class TiledSurface {
 public:
  /// - @p spectrum of the heights, or of the normal numbers that `translation` turns into heights:
  /// then its scale has no effect
  /// - @p rows, @p cols from 1 to 10^9
  /// - @p blocks kSmall is made sooner where few pixels are wanted; heights then differ by
  /// rounding. kWhole is made soonest
  ///   where a surface is small: another surface of the same statistics, which is no corner of the
  ///   endless one
  /// @throw OptionsError naming each value that is not allowed.
  TiledSurface(const SurfaceSpectrum& spectrum, std::int64_t rows, std::int64_t cols,
               double pitch_x, double pitch_y, std::uint64_t seed,
               std::optional<HeightTranslation> translation = std::nullopt,
               BlockChoice blocks = BlockChoice::kFast);
  ~TiledSurface();
  TiledSurface(TiledSurface&&) noexcept;
  TiledSurface& operator=(TiledSurface&&) noexcept;

  std::int64_t rows() const;
  std::int64_t cols() const;
  /// Mean square of the heights before translation, over all surfaces: the spectrum's, as far as
  /// the pixels can hold it [m^2].
  double variance() const;
  /// Tiles of this size that begin at its multiples take least time, row of tiles after row of
  /// tiles.
  cv::Size tile() const;

  /// Goes on as the surface of another seed: the same as a new one, but sooner.
  void reseed(std::uint64_t seed);

  /// Heights [m] of the tile whose first pixel is (row, col), of single precision whatever its
  /// type. The mean over all surfaces is 0 before translation; that of one surface is what its long
  /// waves make it.
  /// - @p tile CV_32FC1 or CV_64FC1, inside the surface; is filled
  /// @throw OptionsError if it is not.
  void heights(std::int64_t row, std::int64_t col, cv::Mat& tile);

 private:
  class Levels;
  std::unique_ptr<Levels> levels_;
};

}  // namespace mems_stiction
