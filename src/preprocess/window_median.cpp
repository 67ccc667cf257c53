#include "preprocess/window_median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/median.hpp"
#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

// Written so that the compiler finds one instruction for the smaller, and one for the larger.
MEMS_STICTION_INLINE void order(Packet& a, Packet& b) {
  const Packet low = select(a < b, a, b);
  b = select(a > b, a, b);
  a = low;
}

/// The columns or the rows of a window, one value of each. Named one by one, so that they stay in
/// registers.
struct Three {
  Packet a, b, c;
};
struct Five {
  Packet a, b, c, d, e;
};

MEMS_STICTION_INLINE void loadAll(const double* values, std::size_t apart, Three& all) {
  all.a = Packet::load(values);
  all.b = Packet::load(values + apart);
  all.c = Packet::load(values + 2 * apart);
}
MEMS_STICTION_INLINE void loadAll(const double* values, std::size_t apart, Five& all) {
  all.a = Packet::load(values);
  all.b = Packet::load(values + apart);
  all.c = Packet::load(values + 2 * apart);
  all.d = Packet::load(values + 3 * apart);
  all.e = Packet::load(values + 4 * apart);
}

MEMS_STICTION_INLINE void storeAll(const Three& all, std::size_t apart, double* values) {
  all.a.store(values);
  all.b.store(values + apart);
  all.c.store(values + 2 * apart);
}
MEMS_STICTION_INLINE void storeAll(const Five& all, std::size_t apart, double* values) {
  all.a.store(values);
  all.b.store(values + apart);
  all.c.store(values + 2 * apart);
  all.d.store(values + 3 * apart);
  all.e.store(values + 4 * apart);
}

MEMS_STICTION_INLINE void sort(Three& all) {
  order(all.a, all.b);
  order(all.b, all.c);
  order(all.a, all.b);
}
MEMS_STICTION_INLINE void sort(Five& all) {
  order(all.a, all.b);
  order(all.d, all.e);
  order(all.c, all.e);
  order(all.c, all.d);
  order(all.b, all.e);
  order(all.a, all.d);
  order(all.a, all.c);
  order(all.b, all.d);
  order(all.b, all.c);
}

MEMS_STICTION_INLINE Packet larger(const Packet& a, const Packet& b) { return select(a > b, a, b); }
MEMS_STICTION_INLINE Packet smaller(const Packet& a, const Packet& b) {
  return select(a < b, a, b);
}

/// Of a window whose first column is at `sorted`: the smallest values of its columns, then the next
/// ones, and so on.
MEMS_STICTION_INLINE Packet medianOf(const double* sorted, std::size_t stride, const Three&) {
  Three lowest, middle, highest;
  loadAll(sorted, 1, lowest);
  loadAll(sorted + stride, 1, middle);
  loadAll(sorted + 2 * stride, 1, highest);
  sort(lowest);
  sort(middle);
  sort(highest);
  Three diagonal = {lowest.c, middle.b, highest.a};
  sort(diagonal);
  return diagonal.b;
}
MEMS_STICTION_INLINE Packet medianOf(const double* sorted, std::size_t stride, const Five&) {
  Five diagonal;
  Packet above, below;
  Five row;
  loadAll(sorted, 1, row);
  sort(row);
  above = row.d;
  diagonal.a = row.e;
  loadAll(sorted + stride, 1, row);
  sort(row);
  above = larger(row.c, above);
  diagonal.b = row.d;
  below = row.e;
  loadAll(sorted + 2 * stride, 1, row);
  sort(row);
  above = larger(row.b, above);
  diagonal.c = row.c;
  below = smaller(row.d, below);
  loadAll(sorted + 3 * stride, 1, row);
  sort(row);
  above = larger(row.a, above);
  diagonal.d = row.b;
  below = smaller(row.c, below);
  loadAll(sorted + 4 * stride, 1, row);
  sort(row);
  diagonal.e = row.a;
  below = smaller(row.b, below);
  sort(diagonal);
  Three middle = {above, diagonal.c, below};
  sort(middle);
  return middle.b;
}

/// Residuals of one row. @param top the first row of the windows; @param sorted room for one row of
/// sorted columns
template <typename Column>
MEMS_STICTION_INLINE void residualsOf(const double* top, std::size_t stride, double* sorted,
                                      const double* heights, std::size_t cols, double* residuals) {
  for (std::size_t col = 0; col < stride; col += Packet::kCount) {
    Column column;
    loadAll(top + col, stride, column);
    sort(column);
    storeAll(column, stride, sorted + col);
  }
  for (std::size_t col = 0; col < cols; col += Packet::kCount) {
    const Packet residual = Packet::load(heights + col) - medianOf(sorted + col, stride, Column());
    if (col + Packet::kCount <= cols) {
      residual.store(residuals + col);
    } else {
      residual.storeFirst(cols - col, residuals + col);
    }
  }
}

MEMS_STICTION_VECTORIZED void residualsByNetwork(int half, const double* top, std::size_t stride,
                                                 double* sorted, const double* heights,
                                                 std::size_t cols, double* residuals) {
  if (half == 1) {
    residualsOf<Three>(top, stride, sorted, heights, cols, residuals);
  } else {
    residualsOf<Five>(top, stride, sorted, heights, cols, residuals);
  }
}

}  // namespace

void WindowMedian::setFrame(int rows, int cols, int half) {
  rows_ = rows;
  cols_ = cols;
  half_ = half;
  margin_rows_ = std::min(half, rows - 1);
  margin_cols_ = std::min(half, cols - 1);
  stride_ =
      (static_cast<std::size_t>(cols + 2 * margin_cols_) / Packet::kCount + 2) * Packet::kCount;
  const std::size_t wide_rows =
      static_cast<std::size_t>(rows) + 2 * static_cast<std::size_t>(margin_rows_);
  wide_.resize(wide_rows * stride_);
  has_hole_.resize(wide_rows);
  sorted_.resize((2 * static_cast<std::size_t>(half) + 1) * stride_);
}

double* WindowMedian::wideRow(int row) {
  return wide_.data() + static_cast<std::size_t>(row + margin_rows_) * stride_;
}

double* WindowMedian::row(int row) { return wideRow(row) + margin_cols_; }

void WindowMedian::fillMargins() {
  const auto reflect = [](double border, double mirrored) { return 2.0 * border - mirrored; };
  for (int row = 0; row < rows_; ++row) {
    double* line = this->row(row);
    for (int k = 1; k <= margin_cols_; ++k) {
      line[-k] = reflect(line[0], line[k]);
      line[cols_ - 1 + k] = reflect(line[cols_ - 1], line[cols_ - 1 - k]);
    }
  }
  const int width = cols_ + 2 * margin_cols_;
  for (int k = 1; k <= margin_rows_; ++k) {
    for (int col = 0; col < width; ++col) {
      wideRow(-k)[col] = reflect(wideRow(0)[col], wideRow(k)[col]);
      wideRow(rows_ - 1 + k)[col] = reflect(wideRow(rows_ - 1)[col], wideRow(rows_ - 1 - k)[col]);
    }
  }
  for (std::size_t row = 0; row < has_hole_.size(); ++row) {
    const double* line = wide_.data() + row * stride_;
    has_hole_[row] =
        std::any_of(line, line + width, [](double height) { return std::isnan(height); });
  }
}

void WindowMedian::findResiduals(double* residuals) {
  fillMargins();
  const bool has_network = half_ <= 2 && margin_rows_ == half_ && margin_cols_ == half_;
  if (has_network) {
    for (int row = 0; row < rows_; ++row)
      findByNetwork(row, residuals + static_cast<std::size_t>(row) * cols_);
    return;
  }
  cv::parallel_for_(cv::Range(0, rows_), [&](const cv::Range& part) {
    std::vector<double> window;
    for (int row = part.start; row < part.end; ++row) {
      for (int col = 0; col < cols_; ++col) {
        residuals[static_cast<std::size_t>(row) * cols_ + col] = plainResidual(row, col, window);
      }
    }
  });
}

void WindowMedian::findByNetwork(int row, double* residuals) {
  const double* top = wideRow(row - half_);
  residualsByNetwork(half_, top, stride_, sorted_.data(), this->row(row),
                     static_cast<std::size_t>(cols_), residuals);
  const int side = 2 * half_ + 1;
  const char* holes = &has_hole_[static_cast<std::size_t>(row)];
  if (std::none_of(holes, holes + side, [](char has_hole) { return has_hole; })) return;

  // What the network makes of NaN is not a median: windows with a hole, where the sum is NaN, are
  // done again.
  double* sums = sorted_.data();
  std::fill(sums, sums + stride_, 0.0);
  for (int i = 0; i < side; ++i) {
    for (std::size_t col = 0; col < stride_; ++col) sums[col] += top[i * stride_ + col];
  }
  for (int col = 0; col < cols_; ++col) {
    double sum = 0.0;
    for (int i = 0; i < side; ++i) sum += sums[col + i];
    if (std::isnan(sum)) residuals[col] = plainResidual(row, col, window_);
  }
}

double WindowMedian::plainResidual(int row, int col, std::vector<double>& window) {
  const double height = this->row(row)[col];
  if (std::isnan(height)) return std::numeric_limits<double>::quiet_NaN();
  window.clear();
  for (int near_row = row - margin_rows_; near_row <= row + margin_rows_; ++near_row) {
    const double* line = this->row(near_row) + col;
    for (int shift = -margin_cols_; shift <= margin_cols_; ++shift) {
      if (!std::isnan(line[shift])) window.push_back(line[shift]);
    }
  }
  return height - medianOf(window);
}

}  // namespace mems_stiction
