#include "surface/block_convolution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kLanes = FloatLanes::kCount;
/// Margins [cells] of a reach of 1. A round power law in a window of levels needs the last one.
constexpr int kMargins[] = {32, 48, 64, 96, 128, 160};
/// Must fit: with it, a power law loses 3e-3 of the rms height of a level.
constexpr int kLeastMargin = 96;
/// Share of the power that may be cut off where a larger margin would keep it: 3e-4 of the rms height.
constexpr double kNeglected = 1e-7;
constexpr int kSmallestLength = 64;
constexpr int kLargestLength = 8192;
constexpr double kUsualTransform = 1048576.0;
/// Of a transform that must be block.
constexpr double kLeastShare = 0.125;
constexpr double kLargestTransform = 4194304.0;  // cells: 32 MB, and 64 MB while the kernel is made

int marginOf(int round_margin, double reach) {
  const int step = static_cast<int>(kLanes);
  return step * static_cast<int>(std::ceil(round_margin * reach / step));
}

/// Least for the transform that is wanted; infinite for one that is too small.
double costOf(const BlockSize& size, const BlockSize& margin, BlockChoice choice) {
  const double cells = static_cast<double>(size.rows) * size.cols;
  const double block = static_cast<double>(size.rows - 2 * margin.rows) * (size.cols - 2 * margin.cols);
  const bool is_small = size.rows <= 2 * margin.rows || size.cols <= 2 * margin.cols || block < kLeastShare * cells;
  if (is_small || cells > kLargestTransform) return std::numeric_limits<double>::infinity();
  // large transforms leave the processor's memory
  return choice == BlockChoice::kSmall ? cells : cells / block * (1.0 + 0.5 * cells / kUsualTransform);
}

/// {0, 0} where none is large enough.
BlockSize cheapestTransform(const BlockSize& margin, BlockChoice choice) {
  BlockSize cheapest;
  double least = std::numeric_limits<double>::infinity();
  for (int rows = kSmallestLength; rows <= kLargestLength; rows *= 2) {
    for (int cols = kSmallestLength; cols <= kLargestLength; cols *= 2) {
      const double cost = costOf({rows, cols}, margin, choice);
      if (cost < least) {
        least = cost;
        cheapest = {rows, cols};
      }
    }
  }
  return cheapest;
}

/// What cubic B-splines at the cells make of a wave of their coefficients [rad/cell].
double splineGain(double wave) {
  const double half = 0.5 * wave;
  const double sinc = half == 0.0 ? 1.0 : std::sin(half) / half;
  return sinc * sinc * sinc * sinc;
}

/// 1 up to three quarters of the margin, 0 from the margin on.
double taper(int distance, int margin) {
  const double t = std::clamp(4.0 * distance / margin - 3.0, 0.0, 1.0);
  return 1.0 - t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
}

/// The taper at the places of a transform.
std::vector<double> tapers(const LineWaves<double>& waves, int margin) {
  std::vector<double> window;
  for (const std::size_t place : waves.order()) {
    window.push_back(taper(static_cast<int>(std::min(place, waves.length() - place)), margin));
  }
  return window;
}

/// transform(line) of all columns of a frame.
template <typename Transform>
void overColumns(std::vector<Complex<double>>& frame, std::size_t rows, std::size_t cols, Transform transform) {
  constexpr std::size_t kTogether = 8;  // columns: they share the lines of the processor's memory
  std::vector<Complex<double>> lines(kTogether * rows);
  for (std::size_t begin = 0; begin < cols; begin += kTogether) {
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < kTogether; ++i) lines[i * rows + row] = frame[row * cols + begin + i];
    }
    for (std::size_t i = 0; i < kTogether; ++i) transform(&lines[i * rows]);
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < kTogether; ++i) frame[row * cols + begin + i] = lines[i * rows + row];
    }
  }
}

/// Eight rows of noise, the halves of a block as real and imaginary part, transformed along the rows.
MEMS_STICTION_VECTORIZED void transformRows(const float* noise, std::size_t noise_cols, std::size_t half,
                                            const LineWaves<float>& waves, Complex<FloatLanes>* line) {
  FloatLanes re[kLanes];
  FloatLanes im[kLanes];
  for (std::size_t col = 0; col < waves.length(); col += kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      re[i] = FloatLanes::load(noise + i * noise_cols + col);
      im[i] = FloatLanes::load(noise + i * noise_cols + half + col);
    }
    transpose(re);
    transpose(im);
    for (std::size_t i = 0; i < kLanes; ++i) line[col + i] = {re[i], im[i]};
  }
  waves.forward(line);
}

/// Eight times eight complex numbers, eight columns of eight rows or the reverse.
MEMS_STICTION_INLINE void transpose(const Complex<FloatLanes>* from, Complex<FloatLanes>* to) {
  FloatLanes re[kLanes];
  FloatLanes im[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    re[i] = from[i].re;
    im[i] = from[i].im;
  }
  transpose(re);
  transpose(im);
  for (std::size_t i = 0; i < kLanes; ++i) to[i] = {re[i], im[i]};
}

/// Eight columns, of which `block` holds eight rows and the next ones follow `stride` later: transformed, multiplied with the
/// gains and transformed back.
MEMS_STICTION_VECTORIZED void filterColumns(const LineWaves<float>& waves, std::size_t stride, const float* gains,
                                            Complex<FloatLanes>* column, Complex<FloatLanes>* block) {
  const std::size_t groups = waves.length() / kLanes;
  for (std::size_t group = 0; group < groups; ++group) transpose(block + group * stride, column + group * kLanes);
  waves.forward(column);
  for (std::size_t row = 0; row < waves.length(); ++row) {
    const FloatLanes gain = FloatLanes::load(gains + row * kLanes);
    column[row] = {column[row].re * gain, column[row].im * gain};
  }
  waves.backward(column);
  for (std::size_t group = 0; group < groups; ++group) transpose(column + group * kLanes, block + group * stride);
}

/// Eight rows back from their waves; what lies between the margins into the two halves of the block's rows.
MEMS_STICTION_VECTORIZED void transformBack(const LineWaves<float>& waves, std::size_t margin,
                                            Complex<FloatLanes>* line, float* values) {
  waves.backward(line);
  FloatLanes re[kLanes];
  FloatLanes im[kLanes];
  const std::size_t half = waves.length() - 2 * margin;
  for (std::size_t col = 0; col < half; col += kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      re[i] = line[margin + col + i].re;
      im[i] = line[margin + col + i].im;
    }
    transpose(re);
    transpose(im);
    for (std::size_t i = 0; i < kLanes; ++i) {
      re[i].store(values + 2 * half * i + col);
      im[i].store(values + 2 * half * i + half + col);
    }
  }
}

}  // namespace

/// A kernel that has been cut off.
struct BlockConvolution::Kernel {
  Kernel(const WaveGain& gain, const BlockLayout& layout) {
    for (const int round_margin : kMargins) {
      const BlockSize next = {marginOf(round_margin, layout.reach_rows), marginOf(round_margin, layout.reach_cols)};
      const BlockSize wanted = cheapestTransform(next, layout.choice);
      if (wanted.rows == 0) break;  // the one before it must do
      margin = next;
      if (wanted.rows != size.rows || wanted.cols != size.cols) {
        size = wanted;
        sample(gain, layout.for_spline);
      }
      row_taper = tapers(rows, margin.rows);
      col_taper = tapers(cols, margin.cols);
      neglected = power > 0.0 ? beyondTaper() / power : 0.0;
      if (neglected < kNeglected) break;
    }
    cutOff();
  }

  BlockSize size;
  BlockSize margin;
  LineWaves<double> rows{2};
  LineWaves<double> cols{2};
  double variance = 0.0;
  double power = 0.0;  ///< of the kernel: the variance, if it is not that of a spline
  double neglected = 0.0;
  std::vector<Complex<double>> values;  ///< row by row: the kernel by place in the transforms, then its waves by number
  std::vector<double> row_taper;
  std::vector<double> col_taper;

 private:
  void sample(const WaveGain& gain, bool for_spline) {
    const auto row_count = static_cast<std::size_t>(size.rows);
    const auto col_count = static_cast<std::size_t>(size.cols);
    rows = LineWaves<double>(row_count);
    cols = LineWaves<double>(col_count);
    values.assign(row_count * col_count, {0.0, 0.0});
    const auto wave = [](std::size_t index, std::size_t count) {
      const auto number = static_cast<double>(index);
      const auto length = static_cast<double>(count);
      return 2.0 * kPi * (2 * index > count ? number - length : number) / length;
    };
    const double cells = static_cast<double>(row_count * col_count);
    variance = 0.0;
    power = 0.0;
    for (std::size_t row = 0; row <= row_count / 2; ++row) {
      const double wave_y = wave(row, row_count);
      for (std::size_t col = 0; col < col_count; ++col) {
        // the wave -k has the gain of k
        const std::size_t opposite_row = (row_count - row) % row_count;
        const std::size_t opposite_col = (col_count - col) % col_count;
        if (opposite_row == row && opposite_col < col) continue;
        const double wave_x = wave(col, col_count);
        const double wanted = gain(wave_x, wave_y) / cells;
        const double made = for_spline ? wanted / (splineGain(wave_x) * splineGain(wave_y)) : wanted;
        values[row * col_count + col].re = made;
        values[opposite_row * col_count + opposite_col].re = made;
        const double times = opposite_row == row && opposite_col == col ? cells : 2.0 * cells;
        variance += times * wanted * wanted;
        power += times * made * made;
      }
    }
    for (std::size_t row = 0; row < row_count; ++row) cols.forward(&values[row * col_count]);
    overColumns(values, row_count, col_count, [this](Complex<double>* line) { rows.forward(line); });
  }

  double beyondTaper() const {
    double sum = 0.0;
    for (std::size_t row = 0; row < row_taper.size(); ++row) {
      for (std::size_t col = 0; col < col_taper.size(); ++col) {
        const double rest = values[row * col_taper.size() + col].re * (1.0 - row_taper[row] * col_taper[col]);
        sum += rest * rest;
      }
    }
    return sum;
  }

  void cutOff() {
    double within = 0.0;
    for (std::size_t row = 0; row < row_taper.size(); ++row) {
      for (std::size_t col = 0; col < col_taper.size(); ++col) {
        Complex<double>& value = values[row * col_taper.size() + col];
        value = {value.re * row_taper[row] * col_taper[col], 0.0};
        within += value.re * value.re;
      }
    }
    const double scale = within > 0.0 ? std::sqrt(power / within) : 0.0;
    for (Complex<double>& value : values) value.re *= scale;
    for (std::size_t row = 0; row < row_taper.size(); ++row) cols.backward(&values[row * col_taper.size()]);
    overColumns(values, row_taper.size(), col_taper.size(), [this](Complex<double>* line) { rows.backward(line); });
  }
};

bool BlockConvolution::fits(double reach_rows, double reach_cols) {
  const BlockSize margin = {marginOf(kLeastMargin, reach_rows), marginOf(kLeastMargin, reach_cols)};
  return cheapestTransform(margin, BlockChoice::kSmall).rows > 0;
}

BlockConvolution::BlockConvolution(const WaveGain& gain, const BlockLayout& layout)
    : BlockConvolution(Kernel(gain, layout)) {}

BlockConvolution::BlockConvolution(const Kernel& kernel)
    : margin_(kernel.margin),
      rows_(kernel.rows.length()),
      cols_(kernel.cols.length()),
      variance_(kernel.variance),
      neglected_(kernel.neglected),
      gains_(kernel.values.size()) {
  const std::size_t row_count = rows_.length();
  const std::size_t col_count = cols_.length();
  const double cells = static_cast<double>(row_count * col_count);  // the transforms there and back multiply by it
  for (std::size_t row = 0; row < row_count; ++row) {
    const Complex<double>* const line = &kernel.values[rows_.order()[row] * col_count];
    for (std::size_t col = 0; col < col_count; ++col) {
      gains_[(col / kLanes * row_count + row) * kLanes + col % kLanes] =
          static_cast<float>(line[cols_.order()[col]].re / cells);
    }
  }
}

void BlockConvolution::make(NumberedNoise& noise, std::int64_t block_row, std::int64_t block_col,
                            ConvolutionMemory& memory, float* values) const {
  const std::size_t row_count = rows_.length();
  const std::size_t col_count = cols_.length();
  const auto row_margin = static_cast<std::size_t>(margin_.rows);
  const auto col_margin = static_cast<std::size_t>(margin_.cols);
  const std::size_t half = col_count - 2 * col_margin;
  const std::size_t noise_cols = half + col_count;
  memory.waves.resize(std::max(memory.waves.size(), row_count / kLanes * col_count));
  memory.columns.resize(std::max(memory.columns.size(), row_count));
  memory.noise.resize(std::max(memory.noise.size(), kLanes * noise_cols));

  const std::int64_t first_row = block_row * block().rows - margin_.rows;
  const std::int64_t first_col = block_col * block().cols - margin_.cols;
  for (std::size_t row = 0; row < row_count; row += kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      noise.fill(first_row + static_cast<std::int64_t>(row + i), first_col, static_cast<int>(noise_cols),
                 &memory.noise[i * noise_cols]);
    }
    transformRows(memory.noise.data(), noise_cols, half, cols_, &memory.waves[row / kLanes * col_count]);
  }
  for (std::size_t col = 0; col < col_count; col += kLanes) {
    filterColumns(rows_, col_count, &gains_[col * row_count], memory.columns.data(), &memory.waves[col]);
  }
  for (std::size_t row = row_margin; row < row_count - row_margin; row += kLanes) {
    transformBack(cols_, col_margin, &memory.waves[row / kLanes * col_count], values + (row - row_margin) * 2 * half);
  }
}

}  // namespace mems_stiction
