#include "separation/flattening.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "numeric/packet.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
void StructureFunction::start(int length) {
  length_ = length;
  lags_.clear();
  const int longest = std::min(std::max(1, length / chosen::kLagsPerLine), length - 1);
  for (int lag = 1; lag <= longest;
       lag = std::max(lag + 1, static_cast<int>(lag * chosen::kNextLength))) {
    lags_.push_back({lag, 0.0, 0.0});
  }
}

MEMS_STICTION_VECTORIZED void StructureFunction::add(const double* line) {
  const auto length = static_cast<std::size_t>(length_);
  for (Lag& lag : lags_) {
    const auto distance = static_cast<std::size_t>(lag.cells);
    const double* const near = line;
    const double* const far = line + distance;
    const std::size_t pairs = length - distance;
    Packet sum = 0.0;
    Packet count = 0.0;
    const auto take = [&](const Packet& difference) {
      const PacketMask is_known = difference - difference == 0.0;
      const Packet known = select(is_known, difference, Packet(0.0));
      sum += known * known;
      count += oneWhere(is_known);
    };
    const std::size_t in_packets = pairs / Packet::kCount * Packet::kCount;
    for (std::size_t i = 0; i < in_packets; i += Packet::kCount)
      take(Packet::load(far + i) - Packet::load(near + i));
    if (in_packets < pairs) {
      constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
      take(Packet::loadFirst(far + in_packets, pairs - in_packets, kUnknown) -
           Packet::loadFirst(near + in_packets, pairs - in_packets, kUnknown));
    }
    lag.sum += sum.sum();
    lag.count += count.sum();
  }
}

double StructureFunction::integral(double pitch) const {
  double sum = 0.0;
  double last_distance = 0.0;
  double last = 0.0;
  for (const Lag& lag : lags_) {
    if (lag.count == 0.0) continue;
    const double distance = lag.cells * pitch;
    const double value = lag.sum / lag.count;
    // S is a line over 1/r between two distances
    sum += last_distance == 0.0 ? 0.5 * value / distance
                                : 0.25 * (last + value) * (1.0 / last_distance - 1.0 / distance);
    last_distance = distance;
    last = value;
  }
  return last_distance > 0.0 ? sum + 0.5 * last / last_distance : 0.0;
}

void StructureFunctions::start(int rows, int cols) {
  along_rows.start(cols);
  along_columns.start(rows);
  directions_ = (cols > 1 ? 1 : 0) + (rows > 1 ? 1 : 0);
}

double StructureFunctions::energy(double contact_modulus, double pitch_x, double pitch_y) const {
  const double both = along_rows.integral(pitch_x) + along_columns.integral(pitch_y);
  return directions_ > 0 ? 0.25 * contact_modulus * both / directions_ : 0.0;
}

double FlatteningEnergy::of(const GapField& field, double contact_modulus) {
  return field.readGaps([&](const auto& gaps) {
    return measure(field, contact_modulus, [&](std::ptrdiff_t cell) { return gaps[cell]; });
  });
}

double FlatteningEnergy::of(const GapField& field, const cv::Mat1d& raised,
                            double contact_modulus) {
  const double* heights = raised.ptr<double>();
  return field.readGaps([&](const auto& gaps) {
    return measure(field, contact_modulus,
                   [&](std::ptrdiff_t cell) { return gaps[cell] + heights[cell]; });
  });
}

template <typename ReadCell>
double FlatteningEnergy::measure(const GapField& field, double contact_modulus,
                                 const ReadCell& read) {
  const int rows = field.rows();
  const int cols = field.cols();
  const int row_step = std::max(1, rows / chosen::kLines);
  const int col_step = std::max(1, cols / chosen::kLines);
  structure_.start(rows, cols);
  row_.resize(static_cast<std::size_t>(cols));
  // the columns are read row by row: a look at each row, which is a pass over memory, but in its
  // order
  const int first_col = col_step / 2;
  const int columns = (cols - first_col + col_step - 1) / col_step;
  columns_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * cols + first_col;
    for (int i = 0; i < columns; ++i) {
      columns_[static_cast<std::size_t>(i) * static_cast<std::size_t>(rows) +
               static_cast<std::size_t>(row)] =
          read(first + static_cast<std::ptrdiff_t>(i) * col_step);
    }
  }
  for (int i = 0; i < columns; ++i)
    structure_.along_columns.add(columns_.data() + static_cast<std::ptrdiff_t>(i) * rows);
  for (int row = row_step / 2; row < rows; row += row_step) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * cols;
    for (int col = 0; col < cols; ++col) row_[static_cast<std::size_t>(col)] = read(first + col);
    structure_.along_rows.add(row_.data());
  }
  return structure_.energy(contact_modulus, field.pitchX(), field.pitchY());
}

}  // namespace mems_stiction
