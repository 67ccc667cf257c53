#include "half_space/stiffness_operator.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "half_space/cell_influence.hpp"
#include "half_space/row_work.hpp"
#include "line_transform.hpp"
#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"
#include "row_pairs.hpp"

namespace mems_stiction {
namespace {

/// Columns that are gathered together: their complex numbers fill one or two cache lines.
constexpr std::size_t kBlock = 8;
/// Scalars of a line of the cache.
constexpr std::size_t kAligned = 16;
/// Shift of K^-1, of the smallest stiffness: none to speak of, but for the mean that K does not
/// resist.
constexpr double kNoShift = 1e-6;
/// The least compliance of a wave in a window, of the same wave's in a periodic frame.
constexpr double kLeastShare = 0.1;

/// Each complex number of a column times the real factor that its wave number has.
template <typename Scalar, typename Multiplier>
MEMS_STICTION_INLINE void multiplyColumn(std::size_t count, const Scalar* stiffness,
                                         const Multiplier& multiplier, Scalar* column) {
  for (std::size_t i = 0; i < count; ++i) {
    const Scalar factor = multiplier(stiffness[i]);
    column[2 * i] *= factor;
    column[2 * i + 1] *= factor;
  }
}

/// K, with the transforms' factor.
template <typename Scalar>
struct TimesStiffness {
  Scalar scale;
  Scalar operator()(Scalar stiffness) const { return scale * stiffness; }
};

/// 1/(K + shift), with the transforms' factor.
template <typename Scalar>
struct OverStiffness {
  Scalar scale;
  Scalar shift;
  Scalar operator()(Scalar stiffness) const { return scale / (stiffness + shift); }
};

MEMS_STICTION_VECTORIZED void scaleColumn(std::size_t count, const float* stiffness,
                                          const TimesStiffness<float>& multiplier, float* column) {
  multiplyColumn(count, stiffness, multiplier, column);
}
MEMS_STICTION_VECTORIZED void scaleColumn(std::size_t count, const double* stiffness,
                                          const TimesStiffness<double>& multiplier,
                                          double* column) {
  multiplyColumn(count, stiffness, multiplier, column);
}
MEMS_STICTION_VECTORIZED void scaleColumn(std::size_t count, const float* stiffness,
                                          const OverStiffness<float>& multiplier, float* column) {
  multiplyColumn(count, stiffness, multiplier, column);
}
MEMS_STICTION_VECTORIZED void scaleColumn(std::size_t count, const double* stiffness,
                                          const OverStiffness<double>& multiplier, double* column) {
  multiplyColumn(count, stiffness, multiplier, column);
}

/// sum of a b in eight packets.
template <typename Scalar>
MEMS_STICTION_INLINE double dotElements(std::size_t count, const Scalar* a, const Scalar* b) {
  constexpr std::size_t kDotElements = 8;
  Scalar packet[kDotElements] = {};
  std::size_t i = 0;
  for (; i + kDotElements <= count; i += kDotElements) {
    for (std::size_t element = 0; element < kDotElements; ++element)
      packet[element] += a[i + element] * b[i + element];
  }
  double sum = 0.0;
  for (const Scalar element : packet) sum += static_cast<double>(element);
  for (; i < count; ++i) sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum;
}
MEMS_STICTION_VECTORIZED double dotRow(std::size_t count, const float* a, const float* b) {
  return dotElements(count, a, b);
}
MEMS_STICTION_VECTORIZED double dotRow(std::size_t count, const double* a, const double* b) {
  return dotElements(count, a, b);
}

/// Fourier transform of even real sequences, which is real and even, too: of both only the first
/// half is given.
class EvenTransform {
 public:
  explicit EvenTransform(int length)
      : length_(static_cast<std::size_t>(length)),
        line_(4 * length_),
        transform_(length, line_.data(), spectrumIn(line_)) {}

  /// Every from_step-th value to every to_step-th; both may be one.
  void apply(const double* from, std::size_t from_step, double* to, std::size_t to_step) const {
    std::vector<double> line(4 * length_);
    for (std::size_t i = 0; i < length_; ++i)
      line[2 * i] = from[std::min(i, length_ - i) * from_step];
    double* const spectrum = spectrumIn(line);
    transform_.forward(line.data(), spectrum);
    for (std::size_t i = 0; i <= length_ / 2; ++i) to[i * to_step] = spectrum[2 * i];
  }

 private:
  /// The second half of complex numbers of a line.
  static double* spectrumIn(std::vector<double>& line) { return line.data() + line.size() / 2; }

  std::size_t length_;
  std::vector<double> line_;  ///< only shows the alignment
  LineTransform<double> transform_;
};

}  // namespace

template <typename Scalar>
struct StiffnessOperator<Scalar>::Transforms {
  Transforms(const HalfSpaceGrid& grid, Scalar* from, Scalar* to)
      : rows(grid.cols, from, to), columns(grid.rows, from, to) {}

  LineTransform<Scalar> rows;
  LineTransform<Scalar> columns;
};

template <typename Scalar>
StiffnessOperator<Scalar>::StiffnessOperator(const HalfSpaceGrid& grid, double contact_modulus,
                                             int threads, SpectrumMemory& memory,
                                             const std::atomic<bool>* cancel)
    : StiffnessOperator(grid, ElasticResponse{contact_modulus, nullptr}, threads, memory, cancel) {}

template <typename Scalar>
StiffnessOperator<Scalar>::StiffnessOperator(const HalfSpaceGrid& grid,
                                             const ElasticResponse& response, int threads,
                                             SpectrumMemory& memory,
                                             const std::atomic<bool>* cancel)
    : grid_(grid),
      threads_(threads),
      cancel_(cancel),
      blocks_((grid.cols / 2 + static_cast<int>(kBlock)) / static_cast<int>(kBlock)),
      smallest_(std::numeric_limits<double>::infinity()),
      memory_(&memory) {
  if (isCancelled()) return;
  const auto rows = static_cast<std::size_t>(grid_.rows);
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const std::size_t block_size = rows * kBlock;
  stiffness_.assign(static_cast<std::size_t>(blocks_) * block_size, Scalar(1));
  const std::size_t bytes = 2 * sizeof(Scalar) * static_cast<std::size_t>(blocks_) * block_size;
  if (memory.bytes.size() < bytes) memory.bytes.resize(bytes);
  // two joined rows and their spectrum, or a block of columns and the spectrum of one; both halves
  // begin as aligned as the whole, so that plans of one fit the other
  const std::size_t half = std::max(2 * (cols + kBlock), (kBlock + 1) * (rows + kBlock));
  pad_size_ = 2 * ((half + kAligned - 1) / kAligned * kAligned);
  pads_.resize(static_cast<std::size_t>(threads_));
  for (auto& pad : pads_) pad.resize(pad_size_);
  transforms_ = std::make_unique<Transforms>(grid_, pads_.front().data(),
                                             pads_.front().data() + pad_size_ / 2);
  if (grid_.boundary == HalfSpaceBoundary::kPeriodic) {
    fillPeriodic(response);
  } else {
    fillFree(response);
  }
}

template <typename Scalar>
StiffnessOperator<Scalar>::~StiffnessOperator() = default;

template <typename Scalar>
Scalar* StiffnessOperator<Scalar>::spectrumOf(std::size_t row) {
  return reinterpret_cast<Scalar*>(memory_->bytes.data()) +
         row * 2 * static_cast<std::size_t>(blocks_) * kBlock;
}

template <typename Scalar>
Scalar& StiffnessOperator<Scalar>::entry(int row, int col) {
  return stiffness_[static_cast<std::size_t>(col) * static_cast<std::size_t>(grid_.rows) +
                    static_cast<std::size_t>(row)];
}

template <typename Scalar>
double StiffnessOperator<Scalar>::waveNumber(int row, int col) const {
  const double q_y = 2.0 * kPi * std::min(row, grid_.rows - row) / (grid_.rows * grid_.pitch_y);
  const double q_x = 2.0 * kPi * col / (grid_.cols * grid_.pitch_x);
  return std::sqrt(q_x * q_x + q_y * q_y);
}

template <typename Scalar>
void StiffnessOperator<Scalar>::fillPeriodic(const ElasticResponse& response) {
  struct Extremes {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    Extremes& operator+=(const Extremes& other) {
      smallest = std::min(smallest, other.smallest);
      largest = std::max(largest, other.largest);
      return *this;
    }
  };
  std::vector<Extremes> of_columns;
  const Extremes all = sumOverRows(of_columns, grid_.cols / 2 + 1, threads_, [&](int col) {
    Extremes extremes;
    for (int row = 0; row < grid_.rows && !isCancelled(); ++row) {
      if (row == 0 && col == 0) {
        entry(row, col) = Scalar(0);  // the mean
        continue;
      }
      const double q = waveNumber(row, col);
      const double stiffness =
          response.layers != nullptr ? response.layers->at(q) : 0.5 * response.contact_modulus * q;
      entry(row, col) = static_cast<Scalar>(stiffness);
      extremes += {stiffness, stiffness};
    }
    return extremes;
  });
  smallest_ = all.smallest;
  largest_ = all.largest;
}

template <typename Scalar>
void StiffnessOperator<Scalar>::fillFree(const ElasticResponse& response) {
  // In double whatever the Scalar: the small compliances of short waves are differences of large
  // numbers. The influence is even in both directions, so that its transforms are real and half of
  // the lines say all.
  const int half_rows = grid_.rows / 2 + 1;
  const int half_cols = grid_.cols / 2 + 1;
  const auto width = static_cast<std::size_t>(half_cols);
  std::optional<CellInfluence> influence;
  if (response.influence == nullptr) {
    influence.emplace(response.contact_modulus, response.layers, grid_.pitch_x, grid_.pitch_y);
  }
  const auto influenceAt = [&](int row, int col) {
    // the padding may be longer than twice the frame: there nothing is asked for
    return influence ? influence->at(row, col)
                     : (*response.influence)(std::min(row, grid_.frame_rows),
                                             std::min(col, grid_.frame_cols));
  };
  LargePageVector<double> of_rows(static_cast<std::size_t>(half_rows) * width);
  {
    const EvenTransform transform(grid_.cols);
    forEachRow(half_rows, threads_, [&](int row) {
      if (isCancelled()) return;
      std::vector<double> line(width);
      for (int col = 0; col < half_cols; ++col) {
        line[static_cast<std::size_t>(col)] = influenceAt(row, col);
      }
      transform.apply(line.data(), 1, of_rows.data() + static_cast<std::size_t>(row) * width, 1);
    });
  }
  const EvenTransform transform(grid_.rows);
  forEachRow(half_cols, threads_, [&](int col) {
    if (isCancelled()) return;
    double* const column = of_rows.data() + col;
    transform.apply(column, width, column, width);
  });
  const double lowest_wave =
      2.0 * kPi / std::max(grid_.rows * grid_.pitch_y, grid_.cols * grid_.pitch_x);
  for (int row = 0; row < grid_.rows && !isCancelled(); ++row) {
    const double* const line =
        of_rows.data() + static_cast<std::size_t>(std::min(row, grid_.rows - row)) * width;
    for (int col = 0; col < half_cols; ++col) {
      double stiffness = 1.0 / line[col];
      if (response.influence != nullptr && response.layers != nullptr) {
        // a plate bends far beyond a window, whose edge cuts that off: what is left may resist some
        // waves with less than 0
        const bool is_mean = row + col == 0;
        const double of_wave = response.layers->at(is_mean ? lowest_wave : waveNumber(row, col));
        if (!(line[col] * of_wave > (is_mean ? 0.0 : kLeastShare))) stiffness = of_wave;
      }
      entry(row, col) = static_cast<Scalar>(stiffness);
      smallest_ = std::min(smallest_, stiffness);
      largest_ = std::max(largest_, stiffness);
    }
  }
}

template <typename Scalar>
template <typename Multiplier, typename Finish>
void StiffnessOperator<Scalar>::apply(const Scalar* from, const Multiplier& multiplier,
                                      const Finish& finish) {
  const auto rows = static_cast<std::size_t>(grid_.rows);
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const std::size_t row_size = 2 * static_cast<std::size_t>(blocks_) * kBlock;
  const std::size_t second_pad = 2 * (cols + kBlock - cols % kBlock);
  const int pairs = (grid_.rows + 1) / 2;
  const auto forEachPair = [&](const auto& work) {
    forParts(threads_, [&](int part) {
      Scalar* const pad = pads_[static_cast<std::size_t>(part)].data();
      const int end = pairs * (part + 1) / threads_;
      for (int pair = pairs * part / threads_; pair < end && !isCancelled(); ++pair) {
        // the last row of an odd number is joined with itself
        const int second = std::min(2 * pair + 1, grid_.rows - 1);
        work(2 * static_cast<std::size_t>(pair), static_cast<std::size_t>(second), pad,
             pad + second_pad);
      }
    });
  };
  const auto stride = static_cast<std::size_t>(grid_.stride);
  forEachPair([&](std::size_t first, std::size_t second, Scalar* joined, Scalar* spectrum) {
    row_pairs::join(cols, from + first * stride, from + second * stride, joined);
    transforms_->rows.forward(joined, spectrum);
    row_pairs::splitSpectrum(cols, spectrum, spectrumOf(first), spectrumOf(second));
  });
  forParts(threads_, [&](int part) {
    Scalar* const block = pads_[static_cast<std::size_t>(part)].data();
    const std::size_t column_size = 2 * (rows + kBlock - rows % kBlock);
    Scalar* const spectrum = block + kBlock * column_size;
    const int end = blocks_ * (part + 1) / threads_;
    for (int i = blocks_ * part / threads_; i < end && !isCancelled(); ++i) {
      const auto first_column = static_cast<std::size_t>(i) * kBlock;
      Scalar* const first = spectrumOf(0) + 2 * first_column;
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < kBlock; ++k) {
          std::memcpy(block + k * column_size + 2 * row, first + row * row_size + 2 * k,
                      2 * sizeof(Scalar));
        }
      }
      const std::size_t used = std::min(kBlock, cols / 2 + 1 - first_column);
      for (std::size_t k = 0; k < used; ++k) {
        Scalar* const column = block + k * column_size;
        transforms_->columns.forward(column, spectrum);
        scaleColumn(rows, stiffness_.data() + (first_column + k) * rows, multiplier, spectrum);
        if (first_column + k == 0 && !resistsMean()) spectrum[0] = spectrum[1] = Scalar(0);
        transforms_->columns.backward(spectrum, column);
      }
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < kBlock; ++k) {
          std::memcpy(first + row * row_size + 2 * k, block + k * column_size + 2 * row,
                      2 * sizeof(Scalar));
        }
      }
    }
  });
  forEachPair([&](std::size_t first, std::size_t second, Scalar* joined, Scalar* spectrum) {
    row_pairs::joinSpectra(cols, spectrumOf(first), spectrumOf(second), spectrum);
    transforms_->rows.backward(spectrum, joined);
    finish(first, second, joined, spectrum);
  });
}

template <typename Scalar>
template <typename AfterRows>
auto StiffnessOperator<Scalar>::writeTo(Scalar* to, const AfterRows& after_rows) const {
  return [this, to, &after_rows](std::size_t first, std::size_t second, const Scalar* joined,
                                 Scalar* /*spare*/) {
    const auto stride = static_cast<std::size_t>(grid_.stride);
    row_pairs::split(static_cast<std::size_t>(grid_.cols), joined, to + first * stride,
                     to + second * stride);
    after_rows(first, second);
  };
}

/// Nothing is left to do with rows that are done.
static const auto kNoMore = [](std::size_t, std::size_t) {};

template <typename Scalar>
void StiffnessOperator<Scalar>::multiply(const Scalar* displacement, Scalar* traction) {
  const double scale = 0.5 / (static_cast<double>(grid_.rows) * grid_.cols);  // spectra come twice
  apply(displacement, TimesStiffness<Scalar>{static_cast<Scalar>(scale)},
        writeTo(traction, kNoMore));
}

/// 1/(K + shift) for transforms over the grid.
template <typename Scalar>
static OverStiffness<Scalar> overStiffness(const HalfSpaceGrid& grid, double shift) {
  const double scale = 0.5 / (static_cast<double>(grid.rows) * grid.cols);
  return {static_cast<Scalar>(scale), static_cast<Scalar>(shift)};
}

template <typename Scalar>
double StiffnessOperator<Scalar>::precondition(double shift, const Scalar* traction,
                                               Scalar* displacement) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const auto stride = static_cast<std::size_t>(grid_.stride);
  row_products_.resize(static_cast<std::size_t>(grid_.rows));
  const auto addProducts = [&](std::size_t first, std::size_t second) {
    for (const std::size_t row : {first, second}) {
      row_products_[row] = dotRow(cols, traction + row * stride, displacement + row * stride);
    }
  };
  apply(traction, overStiffness<Scalar>(grid_, shift), writeTo(displacement, addProducts));
  double product = 0.0;
  for (const double of_row : row_products_) product += of_row;
  return product;
}

template <typename Scalar>
void StiffnessOperator<Scalar>::displace(const Scalar* traction, Scalar* displacement) {
  apply(traction, overStiffness<Scalar>(grid_, kNoShift * smallest_),
        writeTo(displacement, kNoMore));
}

template <typename Scalar>
void StiffnessOperator<Scalar>::displace(const Scalar* traction, const TakeRow& take) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  apply(traction, overStiffness<Scalar>(grid_, kNoShift * smallest_),
        [&](std::size_t first, std::size_t second, const Scalar* joined, Scalar* spare) {
          Scalar* const next = spare + (cols + kBlock - cols % kBlock);
          row_pairs::split(cols, joined, spare, next);
          take(static_cast<int>(first), spare);
          if (second != first) take(static_cast<int>(second), next);
        });
}

template class StiffnessOperator<float>;
template class StiffnessOperator<double>;

}  // namespace mems_stiction
