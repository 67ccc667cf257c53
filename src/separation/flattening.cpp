#include "mems_stiction/separation/flattening.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mems_stiction {
namespace {

/// Lines of each direction that are read: enough that another choice changes U by a few percent.
constexpr int kLines = 48;
constexpr double kLagGrowth = 1.25;
constexpr int kLagsPerLine = 4;  ///< the longest distance is this part of the line

/// Mean squared differences of lines at some distances.
class StructureFunction {
 public:
  explicit StructureFunction(int length) {
    for (int lag = 1; lag <= std::max(1, length / kLagsPerLine);
         lag = std::max(lag + 1, static_cast<int>(lag * kLagGrowth))) {
      if (lag < length) lags_.push_back(lag);
    }
    sums_.assign(lags_.size(), 0.0);
    counts_.assign(lags_.size(), 0);
  }

  void add(const std::vector<double>& line) {
    for (std::size_t k = 0; k < lags_.size(); ++k) {
      const auto lag = static_cast<std::size_t>(lags_[k]);
      for (std::size_t i = lag; i < line.size(); ++i) {
        const double difference = line[i] - line[i - lag];
        if (!std::isfinite(difference)) continue;
        sums_[k] += difference * difference;
        ++counts_[k];
      }
    }
  }

  /// Integral of S(r)/(2 r^2) dr [m]; S grows as r^2 up to the first distance.
  double integral(double pitch) const {
    double sum = 0.0;
    double last_distance = 0.0;
    double last = 0.0;
    for (std::size_t k = 0; k < lags_.size(); ++k) {
      if (counts_[k] == 0) continue;
      const double distance = lags_[k] * pitch;
      const double value = sums_[k] / static_cast<double>(counts_[k]);
      if (last_distance == 0.0) {
        sum += 0.5 * value / distance;
      } else {  // S as a line over 1/r
        sum += 0.25 * (last + value) * (1.0 / last_distance - 1.0 / distance);
      }
      last_distance = distance;
      last = value;
    }
    return last_distance > 0.0 ? sum + 0.5 * last / last_distance : 0.0;
  }

 private:
  std::vector<int> lags_;
  std::vector<double> sums_;
  std::vector<long long> counts_;
};

}  // namespace

double flatteningEnergy(const GapField& field, double contact_modulus) {
  StructureFunction along_rows(field.cols());
  std::vector<double> line(static_cast<std::size_t>(field.cols()));
  const int row_step = std::max(1, field.rows() / kLines);
  for (int row = row_step / 2; row < field.rows(); row += row_step) {
    field.gapsOfRow(row, line.data());
    along_rows.add(line);
  }
  StructureFunction along_columns(field.rows());
  line.resize(static_cast<std::size_t>(field.rows()));
  const int col_step = std::max(1, field.cols() / kLines);
  for (int col = col_step / 2; col < field.cols(); col += col_step) {
    for (int row = 0; row < field.rows(); ++row) {
      line[static_cast<std::size_t>(row)] = field.gap(field.cellAt(row, col).index);
    }
    along_columns.add(line);
  }
  const double both = along_rows.integral(field.pitchX()) + along_columns.integral(field.pitchY());
  const int directions = (field.cols() > 1 ? 1 : 0) + (field.rows() > 1 ? 1 : 0);
  return directions > 0 ? 0.25 * contact_modulus * both / directions : 0.0;
}

}  // namespace mems_stiction
