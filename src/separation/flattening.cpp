#include "mems_stiction/separation/flattening.hpp"

#include <algorithm>
#include <cmath>

namespace mems_stiction {
namespace {

/// Lines of each direction that are read: enough that another choice changes U by a few percent.
constexpr int kLines = 48;
constexpr double kLagGrowth = 1.25;
constexpr int kLagsPerLine = 4;  ///< the longest distance is this part of the line

}  // namespace

void StructureFunction::start(int length) {
  lags_.clear();
  const int longest = std::min(std::max(1, length / kLagsPerLine), length - 1);
  for (int lag = 1; lag <= longest; lag = std::max(lag + 1, static_cast<int>(lag * kLagGrowth))) {
    lags_.push_back({lag, 0.0, 0});
  }
}

void StructureFunction::add(const std::vector<double>& line) {
  for (Lag& lag : lags_) {
    const auto distance = static_cast<std::size_t>(lag.cells);
    for (std::size_t i = distance; i < line.size(); ++i) {
      const double difference = line[i] - line[i - distance];
      if (!std::isfinite(difference)) continue;
      lag.sum += difference * difference;
      ++lag.count;
    }
  }
}

double StructureFunction::integral(double pitch) const {
  double sum = 0.0;
  double last_distance = 0.0;
  double last = 0.0;
  for (const Lag& lag : lags_) {
    if (lag.count == 0) continue;
    const double distance = lag.cells * pitch;
    const double value = lag.sum / static_cast<double>(lag.count);
    // S is a line over 1/r between two distances
    sum +=
        last_distance == 0.0 ? 0.5 * value / distance : 0.25 * (last + value) * (1.0 / last_distance - 1.0 / distance);
    last_distance = distance;
    last = value;
  }
  return last_distance > 0.0 ? sum + 0.5 * last / last_distance : 0.0;
}

double FlatteningEnergy::of(const GapField& field, double contact_modulus) {
  along_rows_.start(field.cols());
  line_.resize(static_cast<std::size_t>(field.cols()));
  const int row_step = std::max(1, field.rows() / kLines);
  for (int row = row_step / 2; row < field.rows(); row += row_step) {
    field.gapsOfRow(row, line_.data());
    along_rows_.add(line_);
  }
  along_columns_.start(field.rows());
  line_.resize(static_cast<std::size_t>(field.rows()));
  const int col_step = std::max(1, field.cols() / kLines);
  for (int col = col_step / 2; col < field.cols(); col += col_step) {
    for (int row = 0; row < field.rows(); ++row) {
      line_[static_cast<std::size_t>(row)] = field.gap(field.cellAt(row, col).index);
    }
    along_columns_.add(line_);
  }
  const double both = along_rows_.integral(field.pitchX()) + along_columns_.integral(field.pitchY());
  const int directions = (field.cols() > 1 ? 1 : 0) + (field.rows() > 1 ? 1 : 0);
  return directions > 0 ? 0.25 * contact_modulus * both / directions : 0.0;
}

}  // namespace mems_stiction
