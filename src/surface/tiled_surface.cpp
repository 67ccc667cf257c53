#include "surface/tiled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/constants.hpp"
#include "surface/block_convolution.hpp"
#include "surface/numbered_noise.hpp"
#include "surface/spline_refinement.hpp"
#include "surface/whole_frame.hpp"

namespace mems_stiction {
namespace {

constexpr double kWholeCells =
    12.0;  ///< a level holds waves of up to so many cells whole, and four times longer ones in part
constexpr int kMostLevels = 24;
constexpr double kLargestCount = 1e9;
constexpr std::size_t kRememberedBytes = std::size_t{12} << 20U;  ///< of blocks, on each level
/// Of noise, on each level: wider surfaces make what blocks share anew.
constexpr std::int64_t kRememberedNoise = std::int64_t{8} << 20U;
/// Blocks that meet at a corner: with fewer, each of them would make those of the coarser level
/// anew.
constexpr std::size_t kLeastRemembered = 4;

/// From 0 to 1 while t goes from 0 to 1, without a jump up to the second derivative: the kernel
/// then falls fast.
double smoothStep(double t) {
  const double within = std::clamp(t, 0.0, 1.0);
  return within * within * within * (10.0 - 15.0 * within + 6.0 * within * within);
}

/// Waves in units of the pixels, where a spectrum that is stretched, or drawn on pixels that are no
/// squares, is not round.
class RoundWaves {
 public:
  RoundWaves(const SurfaceSpectrum& spectrum, double pitch_x, double pitch_y) {
    // |q'|^2 = s along^2 + across^2/s is a quadratic form of a wave in rad/pixel
    const double along_x = std::cos(spectrum.direction) / pitch_x;
    const double along_y = std::sin(spectrum.direction) / pitch_y;
    const double across_x = -std::sin(spectrum.direction) / pitch_x;
    const double across_y = std::cos(spectrum.direction) / pitch_y;
    const double s = spectrum.stretch;
    xx_ = s * along_x * along_x + across_x * across_x / s;
    xy_ = s * along_x * along_y + across_x * across_y / s;
    yy_ = s * along_y * along_y + across_y * across_y / s;
    const double largest = 0.5 * (xx_ + yy_) + std::hypot(0.5 * (xx_ - yy_), xy_);
    unit_ = 1.0 / (pitch_x * pitch_y * std::sqrt(largest));
  }

  /// |q'| [rad/m] of a wave [rad/pixel].
  double roundWave(double wave_x, double wave_y) const {
    return std::sqrt(xx_ * wave_x * wave_x + 2.0 * xy_ * wave_x * wave_y + yy_ * wave_y * wave_y);
  }
  /// Whether (x, y) and (x, -y) have one length.
  bool isEven() const { return xy_ == 0.0; }
  /// |q'| of a wave of 1 rad/pixel in the direction in which it is least: no wave of this |q'| is
  /// shorter in pixels [rad/m].
  double unit() const { return unit_; }
  /// How many times further a kernel reaches over rows and columns than that of such waves in all
  /// directions. Without round-off a round one has the reach 1.
  double reachOverRows() const { return std::max(1.0, std::sqrt(yy_) / unit_ * (1.0 - 1e-12)); }
  double reachOverCols() const { return std::max(1.0, std::sqrt(xx_) / unit_ * (1.0 - 1e-12)); }
  /// 0 where level 0 begins to leave out waves, 1 where it ends and level 1 begins to.
  double level(double round_wave) const {
    return 0.5 * std::log2(2.0 * kPi * unit_ / (round_wave * kWholeCells));
  }

 private:
  double xx_;
  double xy_;
  double yy_;
  double unit_;
};

/// A function of |q'|, by a table: spectra are powers of powers, and a transform asks for a million
/// of them.
class RadialTable {
 public:
  /// - @p end of the table [rad/m]; 0 beyond
  template <typename Function>
  RadialTable(double end, const Function& function)
      : steps_per_wave_(kSteps / end), values_(kSteps + 2, 0.0F) {
    for (std::size_t i = 0; i <= kSteps; ++i) {
      values_[i] =
          static_cast<float>(function(std::max(static_cast<double>(i), 1e-3) / steps_per_wave_));
    }
  }

  double operator()(double q) const {
    const double place = q * steps_per_wave_;
    if (!(place < kSteps)) return 0.0;
    const auto below = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(below);
    return values_[below] + share * (static_cast<double>(values_[below + 1]) - values_[below]);
  }

 private:
  /// A power law of exponent 2 that begins at 1/100 of the end is 3e-4 off at its begin, and 1e-7
  /// at the end.
  static constexpr std::size_t kSteps = 16384;

  double steps_per_wave_;
  std::vector<float> values_;
};

/// Share of the amplitude of a wave that the level `index` of 0 to `last` takes; their squares add
/// up to 1.
double levelWindow(double wave_level, int index, int last) {
  const double place = wave_level - index;
  if ((place <= -1.0 && index > 0) || (place >= 1.0 && index < last)) return 0.0;
  if (place < 0.0 && index > 0) return std::sin(0.5 * kPi * smoothStep(place + 1.0));
  if (place > 0.0 && index < last) return std::cos(0.5 * kPi * smoothStep(place));
  return 1.0;
}

std::int64_t floorDivide(std::int64_t value, std::int64_t divisor) {
  const std::int64_t quotient = value / divisor;
  return quotient * divisor > value ? quotient - 1 : quotient;
}

/// A part of one level, by its cells.
struct CellRange {
  std::int64_t row;
  std::int64_t col;
  std::int64_t rows;
  std::int64_t cols;
};

/// Cells of the coarser level of which those of a block are made.
CellRange cellsAround(std::int64_t row, std::int64_t col, const BlockSize& block) {
  return {row / kRefinedCells - kSplineBefore, col / kRefinedCells - kSplineBefore,
          block.rows / kRefinedCells + kSplineAround, block.cols / kRefinedCells + kSplineAround};
}

/// One level: its own waves and those of all coarser levels.
class Level {
 public:
  /// - @p coarser nullptr on the last level; outlives this one
  Level(const WaveGain& gain, const BlockLayout& layout, const NumberedNoise& noise,
        SplineRefinement refinement, Level* coarser)
      : convolution_(gain, layout), noise_(noise), refinement_(refinement), coarser_(coarser) {
    const auto bytes = static_cast<std::size_t>(block().rows) *
                       static_cast<std::size_t>(block().cols) * sizeof(float);
    most_blocks_ = std::max(kLeastRemembered, kRememberedBytes / bytes);
  }

  /// Forgets what was made, and goes on with other noise.
  void reseed(std::uint64_t seed) {
    noise_.reseed(seed);
    blocks_.clear();
  }

  /// Blocks overlap in the noise that they are made of, which is made once where blocks come row by
  /// row.
  /// - @p first, @p end columns that will be asked for
  void rememberNoise(std::int64_t first, std::int64_t end) {
    const BlockSize margin = convolution_.margin();
    const std::int64_t rows = block().rows + 2 * margin.rows;
    const std::int64_t cols = block().cols;
    const std::int64_t begin = floorDivide(first, cols) * cols;
    const std::int64_t count = (floorDivide(end - 1, cols) + 1) * cols - begin;
    if (rows * (count + 2 * margin.cols) <= kRememberedNoise)
      noise_.remember(rows, begin - margin.cols, count + 2 * margin.cols);
    if (coarser_ == nullptr) return;
    const CellRange around = cellsAround(0, begin, {0, static_cast<int>(count)});
    coarser_->rememberNoise(around.col, around.col + around.cols);
  }

  BlockSize block() const { return convolution_.block(); }
  double variance() const { return convolution_.variance(); }

  /// visit(line, place, count) for each run of cells of a row that lie side by side; `place` counts
  /// from the range's first.
  template <typename Visit>
  void visit(const CellRange& range, ConvolutionMemory& memory, Visit visitor) {
    const std::int64_t rows = block().rows;
    const std::int64_t cols = block().cols;
    for (std::int64_t i = floorDivide(range.row, rows); i * rows < range.row + range.rows; ++i) {
      for (std::int64_t j = floorDivide(range.col, cols); j * cols < range.col + range.cols; ++j) {
        const std::vector<float>& values = blockAt(i, j, memory);
        const std::int64_t first_row = std::max(range.row, i * rows);
        const std::int64_t end_row = std::min(range.row + range.rows, (i + 1) * rows);
        const std::int64_t first_col = std::max(range.col, j * cols);
        const std::int64_t end_col = std::min(range.col + range.cols, (j + 1) * cols);
        for (std::int64_t row = first_row; row < end_row; ++row) {
          visitor(&values[static_cast<std::size_t>((row - i * rows) * cols + first_col - j * cols)],
                  row - range.row, first_col - range.col,
                  static_cast<std::size_t>(end_col - first_col));
        }
      }
    }
  }

 private:
  struct Block {
    std::int64_t row;
    std::int64_t col;
    std::vector<float> values;
  };

  /// Blocks stand in the order in which they were used.
  const std::vector<float>& blockAt(std::int64_t row, std::int64_t col, ConvolutionMemory& memory) {
    const auto known = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& block) {
      return block.row == row && block.col == col;
    });
    if (known != blocks_.end()) {
      std::rotate(known, known + 1, blocks_.end());
      return blocks_.back().values;
    }
    if (blocks_.size() < most_blocks_) {
      const auto cells =
          static_cast<std::size_t>(block().rows) * static_cast<std::size_t>(block().cols);
      blocks_.push_back({row, col, std::vector<float>(cells)});
    } else {
      std::rotate(blocks_.begin(), blocks_.begin() + 1, blocks_.end());
      blocks_.back().row = row;
      blocks_.back().col = col;
    }
    make(blocks_.back(), memory);
    return blocks_.back().values;
  }

  void make(Block& made, ConvolutionMemory& memory) {
    convolution_.make(noise_, made.row, made.col, memory, made.values.data());
    if (coarser_ == nullptr) return;
    const CellRange around = cellsAround(made.row * block().rows, made.col * block().cols, block());
    coarse_.resize(static_cast<std::size_t>(around.rows * around.cols));
    line_.resize(static_cast<std::size_t>(around.cols));
    coarser_->visit(around, memory,
                    [&](const float* cells, std::int64_t row, std::int64_t col, std::size_t count) {
                      std::copy_n(cells, count,
                                  &coarse_[static_cast<std::size_t>(row * around.cols + col)]);
                    });
    addRefined(refinement_, coarse_.data(), static_cast<std::size_t>(block().rows),
               static_cast<std::size_t>(block().cols), line_.data(), made.values.data());
  }

  BlockConvolution convolution_;
  NumberedNoise noise_;
  SplineRefinement refinement_;
  Level* coarser_;
  std::size_t most_blocks_;
  std::vector<Block> blocks_;
  std::vector<float> coarse_;
  std::vector<float> line_;
};

void checkCount(const char* name, std::int64_t count, std::vector<std::string>& violations) {
  const Range counts = Range::within(1.0, kLargestCount);
  if (counts.contains(static_cast<double>(count))) return;
  violations.push_back(std::string(name) + ": " + std::to_string(count) +
                       " is not allowed; must be " + counts.text());
}

void checkPitch(const char* name, double pitch, std::vector<std::string>& violations) {
  if (Range::positive().contains(pitch)) return;
  violations.push_back(std::string(name) + ": " + numberText(pitch) + " is not allowed; must be " +
                       Range::positive().text());
}

}  // namespace

class TiledSurface::Levels {
 public:
  Levels(const SurfaceSpectrum& spectrum, std::int64_t rows, std::int64_t cols, double pitch_x,
         double pitch_y, std::uint64_t seed, std::optional<HeightTranslation> translation,
         BlockChoice finest)
      : rows_(rows), cols_(cols), translation_(std::move(translation)) {
    check(spectrum, pitch_x, pitch_y);
    const RoundWaves waves(spectrum, pitch_x, pitch_y);
    const double shortest = std::max(waves.roundWave(kPi, kPi), waves.roundWave(kPi, -kPi)) * 1.001;
    if (finest == BlockChoice::kWhole) {
      const double pixel_area = pitch_x * pitch_y;
      const RadialTable power(shortest,
                              [&](double q) { return spectrum.densityAt(q) / pixel_area; });
      whole_.emplace(
          [&](double wave_x, double wave_y) { return power(waves.roundWave(wave_x, wave_y)); },
          static_cast<int>(rows), static_cast<int>(cols), waves.isEven());
      variance_ = whole_->variance();
      checkVariance(pitch_x, pitch_y);
      reseed(seed);
      return;
    }
    const int last =
        std::max(0, static_cast<int>(std::ceil(waves.level(spectrum.wave_number.front()))));
    levels_.resize(static_cast<std::size_t>(last) + 1);
    for (int level = last; level >= 0; --level) {
      const double cell = std::ldexp(1.0, 2 * level);  // pixels
      const double cell_area = cell * pitch_x * cell * pitch_y;
      // white noise of variance 1 has the density of the cell's area
      const RadialTable gains(shortest / cell, [&](double q) {
        const double window = levelWindow(waves.level(q), level, last);
        return window == 0.0 ? 0.0 : window * std::sqrt(spectrum.densityAt(q) / cell_area);
      });
      const WaveGain gain = [&](double wave_x, double wave_y) {
        const double q = waves.roundWave(wave_x, wave_y) / cell;
        return q == 0.0 ? 0.0 : gains(q);
      };
      BlockLayout layout;
      layout.choice = level == 0 ? finest : BlockChoice::kSmall;
      layout.reach_rows = waves.reachOverRows();
      layout.reach_cols = waves.reachOverCols();
      layout.for_spline = level > 0;
      const auto index = static_cast<std::size_t>(level);
      levels_[index] = std::make_unique<Level>(
          gain, layout, noiseOf(seed, index),
          level == 0 ? SplineRefinement::kValues : SplineRefinement::kCoefficients,
          level == last ? nullptr : levels_[index + 1].get());
      variance_ += levels_[index]->variance();
    }
    levels_.front()->rememberNoise(0, cols);
    checkVariance(pitch_x, pitch_y);
  }

  std::int64_t rows() const { return rows_; }
  std::int64_t cols() const { return cols_; }
  double variance() const { return variance_; }
  cv::Size tile() const {
    if (whole_) return {static_cast<int>(cols_), static_cast<int>(rows_)};
    return {levels_.front()->block().cols, levels_.front()->block().rows};
  }

  void reseed(std::uint64_t seed) {
    if (whole_) whole_->make(noiseOf(seed, 0));
    for (const std::unique_ptr<Level>& level : levels_) level->reseed(seed);
  }

  void heights(std::int64_t row, std::int64_t col, cv::Mat& tile) {
    checkTile(row, col, tile);
    if (tile.type() == CV_32FC1) {
      fill<float>(row, col, tile);
    } else {
      fill<double>(row, col, tile);
    }
  }

 private:
  static NumberedNoise noiseOf(std::uint64_t seed, std::size_t level) {
    return {seed, static_cast<std::uint32_t>(level)};
  }

  void checkVariance(double pitch_x, double pitch_y) const {
    if (variance_ > 0.0) return;
    throw OptionsError({"spectrum/wave_number: no wave of the spectrum is so long that pixels of " +
                        numberText(pitch_x) + " m by " + numberText(pitch_y) +
                        " m can hold it; must have one of two pixels or more"});
  }

  void check(const SurfaceSpectrum& spectrum, double pitch_x, double pitch_y) const {
    std::vector<std::string> violations = spectrum.validate();
    checkCount("rows", rows_, violations);
    checkCount("cols", cols_, violations);
    checkPitch("pitch_x", pitch_x, violations);
    checkPitch("pitch_y", pitch_y, violations);
    if (!violations.empty()) throw OptionsError(std::move(violations));
    const RoundWaves waves(spectrum, pitch_x, pitch_y);
    if (!BlockConvolution::fits(waves.reachOverRows(), waves.reachOverCols())) {
      violations.push_back("spectrum/stretch: " + numberText(spectrum.stretch) +
                           " with pixels of " + numberText(pitch_x) + " m by " +
                           numberText(pitch_y) +
                           " m is not allowed; must be smaller, or its direction nearer to that of "
                           "the rows or columns, or the "
                           "pixels longer along it");
    }
    const double first = spectrum.wave_number.front();
    const double least =
        2.0 * kPi * waves.unit() / (kWholeCells * std::ldexp(1.0, 2 * (kMostLevels - 1)));
    if (first < least) {
      violations.push_back("spectrum/wave_number[0]: " + numberText(first) +
                           " is not allowed; must be at least " + numberText(least) +
                           " for these pixels");
    }
    if (!violations.empty()) throw OptionsError(std::move(violations));
  }

  void checkTile(std::int64_t row, std::int64_t col, const cv::Mat& tile) const {
    std::vector<std::string> violations;
    if (tile.type() != CV_32FC1 && tile.type() != CV_64FC1) {
      violations.push_back("tile: its type is " + cv::typeToString(tile.type()) +
                           "; must be CV_32FC1 or CV_64FC1");
    }
    const auto checkRange = [&](const char* name, std::int64_t first, std::int64_t count,
                                std::int64_t all) {
      if (first >= 0 && count >= 1 && count <= all - first) return;
      violations.push_back("tile: " + std::string(name) + " " + std::to_string(first) + " to " +
                           std::to_string(first + count - 1) +
                           " are not all of the surface; must be in [0, " +
                           std::to_string(all - 1) + "]");
    };
    checkRange("rows", row, tile.rows, rows_);
    checkRange("columns", col, tile.cols, cols_);
    if (!violations.empty()) throw OptionsError(std::move(violations));
  }

  template <typename Scalar>
  void fill(std::int64_t row, std::int64_t col, cv::Mat& tile) {
    const double per_deviation = 1.0 / std::sqrt(variance_);
    const auto take = [&](const float* cells, std::int64_t tile_row, std::int64_t tile_col,
                          std::size_t count) {
      Scalar* const line = tile.ptr<Scalar>(static_cast<int>(tile_row)) + tile_col;
      if (!translation_) {
        std::copy_n(cells, count, line);
        return;
      }
      for (std::size_t i = 0; i < count; ++i)
        line[i] = static_cast<Scalar>((*translation_)(cells[i] * per_deviation));
    };
    if (whole_) {
      for (int i = 0; i < tile.rows; ++i) {
        take(whole_->heights().ptr<float>(static_cast<int>(row) + i) + col, i, 0,
             static_cast<std::size_t>(tile.cols));
      }
      return;
    }
    levels_.front()->visit({row, col, tile.rows, tile.cols}, memory_, take);
  }

  std::int64_t rows_;
  std::int64_t cols_;
  std::optional<HeightTranslation> translation_;
  double variance_ = 0.0;
  std::optional<WholeFrame> whole_;
  std::vector<std::unique_ptr<Level>>
      levels_;  ///< from the pixels to the longest waves; none where whole_ is there
  ConvolutionMemory memory_;
};

TiledSurface::TiledSurface(const SurfaceSpectrum& spectrum, std::int64_t rows, std::int64_t cols,
                           double pitch_x, double pitch_y, std::uint64_t seed,
                           std::optional<HeightTranslation> translation, BlockChoice blocks)
    : levels_(std::make_unique<Levels>(spectrum, rows, cols, pitch_x, pitch_y, seed,
                                       std::move(translation), blocks)) {}

TiledSurface::~TiledSurface() = default;
TiledSurface::TiledSurface(TiledSurface&&) noexcept = default;
TiledSurface& TiledSurface::operator=(TiledSurface&&) noexcept = default;

std::int64_t TiledSurface::rows() const { return levels_->rows(); }
std::int64_t TiledSurface::cols() const { return levels_->cols(); }
double TiledSurface::variance() const { return levels_->variance(); }
cv::Size TiledSurface::tile() const { return levels_->tile(); }

void TiledSurface::reseed(std::uint64_t seed) { levels_->reseed(seed); }
void TiledSurface::heights(std::int64_t row, std::int64_t col, cv::Mat& tile) {
  levels_->heights(row, col, tile);
}

}  // namespace mems_stiction
