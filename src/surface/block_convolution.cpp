#include "surface/block_convolution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kElements = FloatPacket::kCount;
/// Margins [cells] of a reach of 1. A round power law in a window of levels needs the last one.
constexpr int kMargins[] = {32, 48, 64, 96, 128, 160};
/// Must fit: with it, a power law loses 3e-3 of the rms height of a level.
constexpr int kLeastMargin = 96;
/// Share of the power that may be cut off where a larger margin would keep it: 3e-4 of the rms
/// height.
constexpr double kNeglected = 1e-7;
constexpr int kSmallestLength = 64;
constexpr int kLargestLength = 8192;
constexpr double kUsualTransform = 1048576.0;
/// Of a transform that must be block.
constexpr double kLeastShare = 0.125;
constexpr double kLargestTransform = 4194304.0;  // cells: 32 MB, and 64 MB while the kernel is made

int marginOf(int round_margin, double reach) {
  const int step = static_cast<int>(kElements);
  return step * static_cast<int>(std::ceil(round_margin * reach / step));
}

/// Least for the transform that is wanted; infinite for one that is too small.
double costOf(const BlockSize& size, const BlockSize& margin, BlockChoice choice) {
  const double cells = static_cast<double>(size.rows) * size.cols;
  const double block =
      static_cast<double>(size.rows - 2 * margin.rows) * (size.cols - 2 * margin.cols);
  const bool is_small =
      size.rows <= 2 * margin.rows || size.cols <= 2 * margin.cols || block < kLeastShare * cells;
  if (is_small || cells > kLargestTransform) return std::numeric_limits<double>::infinity();
  // large transforms leave the processor's memory
  return choice == BlockChoice::kSmall ? cells
                                       : cells / block * (1.0 + 0.5 * cells / kUsualTransform);
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

/// transform(line) of all columns of a frame whose transforms are real: two by two, as one complex
/// line.
template <typename Transform>
void overRealColumns(std::vector<Complex<double>>& frame, std::size_t rows, std::size_t cols,
                     Transform transform) {
  constexpr std::size_t kTogether =
      4;  // pairs of columns: they share the lines of the processor's memory
  std::vector<Complex<double>> lines(kTogether * rows);
  for (std::size_t begin = 0; begin < cols; begin += 2 * kTogether) {
    for (std::size_t row = 0; row < rows; ++row) {
      const Complex<double>* const pairs = &frame[row * cols + begin];
      for (std::size_t i = 0; i < kTogether; ++i) {
        const Complex<double>& one = pairs[2 * i];
        const Complex<double>& other = pairs[2 * i + 1];
        lines[i * rows + row] = {one.re - other.im, one.im + other.re};
      }
    }
    for (std::size_t i = 0; i < kTogether; ++i) transform(&lines[i * rows]);
    for (std::size_t row = 0; row < rows; ++row) {
      Complex<double>* const pairs = &frame[row * cols + begin];
      for (std::size_t i = 0; i < kTogether; ++i) {
        pairs[2 * i] = {lines[i * rows + row].re, 0.0};
        pairs[2 * i + 1] = {lines[i * rows + row].im, 0.0};
      }
    }
  }
}

/// transform(line) of all rows of a real frame in which the row -r holds the reverse of row r: its
/// waves are their conjugates.
/// - @p numbers of the rows, in their order
template <typename Transform>
void overMirroredRows(std::vector<Complex<double>>& frame, const std::vector<std::size_t>& numbers,
                      Transform transform) {
  const std::size_t rows = numbers.size();
  const std::size_t cols = frame.size() / rows;
  std::vector<std::size_t> places(rows);
  for (std::size_t row = 0; row < rows; ++row) places[numbers[row]] = row;
  for (std::size_t number = 0; number <= rows / 2; ++number) {
    Complex<double>* const line = &frame[places[number] * cols];
    Complex<double>* const mirrored = &frame[places[(rows - number) % rows] * cols];
    transform(line);
    if (mirrored == line) continue;
    for (std::size_t col = 0; col < cols; ++col) mirrored[col] = {line[col].re, -line[col].im};
  }
}

std::vector<std::size_t> numbersUpTo(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// Eight rows of noise, the halves of a block as real and imaginary part, transformed along the
/// rows.
MEMS_STICTION_VECTORIZED void transformRows(const float* noise, std::size_t noise_cols,
                                            std::size_t half, const LineWaves<float>& waves,
                                            Complex<FloatPacket>* line) {
  FloatPacket re[kElements];
  FloatPacket im[kElements];
  for (std::size_t col = 0; col < waves.length(); col += kElements) {
    for (std::size_t i = 0; i < kElements; ++i) {
      re[i] = FloatPacket::load(noise + i * noise_cols + col);
      im[i] = FloatPacket::load(noise + i * noise_cols + half + col);
    }
    transpose(re);
    transpose(im);
    for (std::size_t i = 0; i < kElements; ++i) line[col + i] = {re[i], im[i]};
  }
  waves.forward(line);
}

/// Eight times eight complex numbers, eight columns of eight rows or the reverse.
MEMS_STICTION_INLINE void transpose(const Complex<FloatPacket>* from, Complex<FloatPacket>* to) {
  FloatPacket re[kElements];
  FloatPacket im[kElements];
  for (std::size_t i = 0; i < kElements; ++i) {
    re[i] = from[i].re;
    im[i] = from[i].im;
  }
  transpose(re);
  transpose(im);
  for (std::size_t i = 0; i < kElements; ++i) to[i] = {re[i], im[i]};
}

/// Eight columns, of which `block` holds eight rows and the next ones follow `stride` later:
/// transformed, multiplied with the gains and transformed back.
MEMS_STICTION_VECTORIZED void filterColumns(const LineWaves<float>& waves, std::size_t stride,
                                            const float* gains, Complex<FloatPacket>* column,
                                            Complex<FloatPacket>* block) {
  const std::size_t groups = waves.length() / kElements;
  for (std::size_t group = 0; group < groups; ++group)
    transpose(block + group * stride, column + group * kElements);
  waves.forward(column);
  for (std::size_t row = 0; row < waves.length(); ++row) {
    const FloatPacket gain = FloatPacket::load(gains + row * kElements);
    column[row] = {column[row].re * gain, column[row].im * gain};
  }
  waves.backward(column);
  for (std::size_t group = 0; group < groups; ++group)
    transpose(column + group * kElements, block + group * stride);
}

/// Eight rows back from their waves; what lies between the margins into the two halves of the
/// block's rows.
MEMS_STICTION_VECTORIZED void transformBack(const LineWaves<float>& waves, std::size_t margin,
                                            Complex<FloatPacket>* line, float* values) {
  waves.backward(line);
  FloatPacket re[kElements];
  FloatPacket im[kElements];
  const std::size_t half = waves.length() - 2 * margin;
  for (std::size_t col = 0; col < half; col += kElements) {
    for (std::size_t i = 0; i < kElements; ++i) {
      re[i] = line[margin + col + i].re;
      im[i] = line[margin + col + i].im;
    }
    transpose(re);
    transpose(im);
    for (std::size_t i = 0; i < kElements; ++i) {
      re[i].store(values + 2 * half * i + col);
      im[i].store(values + 2 * half * i + half + col);
    }
  }
}

}  // namespace

/// A kernel that has been cut off.
struct BlockConvolution::Kernel {
  Kernel(const WaveGain& gain, const BlockLayout& layout) {
    std::vector<BlockSize> margins;
    for (const int round_margin : kMargins) {
      const BlockSize next = {marginOf(round_margin, layout.reach_rows),
                              marginOf(round_margin, layout.reach_cols)};
      if (cheapestTransform(next, layout.choice).rows == 0) break;  // the one before it must do
      margins.push_back(next);
    }
    // one small sample tells how far the kernel reaches
    sample(gain, layout.for_spline, cheapestTransform(margins.back(), BlockChoice::kSmall));
    for (const BlockSize& next : margins) {
      if (takeMargin(next) < kNeglected) break;
    }
    const BlockSize wanted = cheapestTransform(margin, layout.choice);
    if (wanted.rows != size.rows || wanted.cols != size.cols) {
      sample(gain, layout.for_spline, wanted);
      takeMargin(margin);
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
  std::vector<Complex<double>>
      values;  ///< row by row: the kernel by place in the transforms, then its waves by number
  std::vector<double> row_taper;
  std::vector<double> col_taper;

 private:
  /// @return share of the power beyond it
  double takeMargin(const BlockSize& next) {
    margin = next;
    row_taper = tapers(rows, margin.rows);
    col_taper = tapers(cols, margin.cols);
    return neglected = power > 0.0 ? beyondTaper() / power : 0.0;
  }

  void sample(const WaveGain& gain, bool for_spline, const BlockSize& transform) {
    size = transform;
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
    const auto splineGains = [&](std::size_t count) {
      std::vector<double> gains(count, 1.0);
      for (std::size_t i = 0; for_spline && i < count; ++i) gains[i] = splineGain(wave(i, count));
      return gains;
    };
    const std::vector<double> row_gains = splineGains(row_count);
    const std::vector<double> col_gains = splineGains(col_count);
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
        const double made = wanted / (row_gains[row] * col_gains[col]);
        values[row * col_count + col].re = made;
        values[opposite_row * col_count + opposite_col].re = made;
        const double times = opposite_row == row && opposite_col == col ? cells : 2.0 * cells;
        variance += times * wanted * wanted;
        power += times * made * made;
      }
    }
    overMirroredRows(values, numbersUpTo(row_count),
                     [this](Complex<double>* line) { cols.forward(line); });
    overRealColumns(values, row_count, col_count,
                    [this](Complex<double>* line) { rows.forward(line); });
  }

  double beyondTaper() const {
    double sum = 0.0;
    for (std::size_t row = 0; row < row_taper.size(); ++row) {
      for (std::size_t col = 0; col < col_taper.size(); ++col) {
        const double rest =
            values[row * col_taper.size() + col].re * (1.0 - row_taper[row] * col_taper[col]);
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
    overMirroredRows(values, rows.order(), [this](Complex<double>* line) { cols.backward(line); });
    overRealColumns(values, row_taper.size(), col_taper.size(),
                    [this](Complex<double>* line) { rows.backward(line); });
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
  const double cells =
      static_cast<double>(row_count * col_count);  // the transforms there and back multiply by it
  for (std::size_t row = 0; row < row_count; ++row) {
    const Complex<double>* const line = &kernel.values[rows_.order()[row] * col_count];
    for (std::size_t col = 0; col < col_count; ++col) {
      gains_[(col / kElements * row_count + row) * kElements + col % kElements] =
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
  memory.waves.resize(std::max(memory.waves.size(), row_count / kElements * col_count));
  memory.columns.resize(std::max(memory.columns.size(), row_count));
  memory.noise.resize(std::max(memory.noise.size(), kElements * noise_cols));

  const std::int64_t first_row = block_row * block().rows - margin_.rows;
  const std::int64_t first_col = block_col * block().cols - margin_.cols;
  for (std::size_t row = 0; row < row_count; row += kElements) {
    for (std::size_t i = 0; i < kElements; ++i) {
      noise.fill(first_row + static_cast<std::int64_t>(row + i), first_col,
                 static_cast<int>(noise_cols), &memory.noise[i * noise_cols]);
    }
    transformRows(memory.noise.data(), noise_cols, half, cols_,
                  &memory.waves[row / kElements * col_count]);
  }
  for (std::size_t col = 0; col < col_count; col += kElements) {
    filterColumns(rows_, col_count, &gains_[col * row_count], memory.columns.data(),
                  &memory.waves[col]);
  }
  for (std::size_t row = row_margin; row < row_count - row_margin; row += kElements) {
    transformBack(cols_, col_margin, &memory.waves[row / kElements * col_count],
                  values + (row - row_margin) * 2 * half);
  }
}

}  // namespace mems_stiction
