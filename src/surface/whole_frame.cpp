#include "surface/whole_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Sides of the frame over those of the surface.
constexpr double kWiderFrame = 1.5;
/// Up to this number a wave stands for a cell of waves whose density varies, sampled at so many places along each axis.
constexpr int kLongWaves = 6;
constexpr int kSamplesOfCell = 8;

/// A side that transforms fast, in whole groups of numbered noise.
int sideOfFrame(int pixels) {
  constexpr int kGroup = 8;
  int side = static_cast<int>(std::ceil(kWiderFrame * pixels));
  do {
    side = cv::getOptimalDFTSize((side + kGroup) / kGroup * kGroup);
  } while (side % kGroup != 0);
  return side;
}

/// Mean power over the cell of wave numbers around a wave of the frame; the wave 0 has none.
double powerOf(const WavePower& power, int number_x, int number_y, const cv::Size& frame) {
  const double step_x = 2.0 * kPi / frame.width;
  const double step_y = 2.0 * kPi / frame.height;
  if (number_x == 0 && number_y == 0) return 0.0;
  if (std::max(std::abs(number_x), std::abs(number_y)) > kLongWaves) return power(number_x * step_x, number_y * step_y);
  double sum = 0.0;
  for (int i = 0; i < kSamplesOfCell; ++i) {
    for (int j = 0; j < kSamplesOfCell; ++j) {
      sum += power((number_x + (j + 0.5) / kSamplesOfCell - 0.5) * step_x,
                   (number_y + (i + 0.5) / kSamplesOfCell - 0.5) * step_y);
    }
  }
  return sum / (kSamplesOfCell * kSamplesOfCell);
}

/// Number of the wave at a place of a packed line, whose first is 0 and whose last of an even count is count/2.
int packedNumber(int place) { return (place + 1) / 2; }

}  // namespace

WholeFrame::WholeFrame(const WavePower& power, int rows, int cols, bool is_even) : size_(cols, rows) {
  const cv::Size frame(sideOfFrame(cols), sideOfFrame(rows));
  gains_.create(frame, CV_32FC1);
  waves_.create(frame, CV_32FC1);
  for (int row = 0; row < frame.height; ++row) {
    float* line = gains_.ptr<float>(row);
    for (int col = 0; col < frame.width; ++col) {
      // The first and the last column hold the waves along y, packed; all others hold theirs at their rows.
      const bool is_along_y = col == 0 || col == frame.width - 1;
      if (is_even && !is_along_y && row > frame.height / 2) {
        line[col] = gains_.ptr<float>(frame.height - row)[col];
        continue;
      }
      const int number_x = packedNumber(col);
      const int number_y = is_along_y ? packedNumber(row) : row <= frame.height / 2 ? row : row - frame.height;
      const double found = powerOf(power, number_x, number_y, frame);
      line[col] = static_cast<float>(std::sqrt(found));
      const bool is_twice = is_even && !is_along_y && row > 0 && 2 * row < frame.height;
      variance_ += is_twice ? 2.0 * found : found;
    }
  }
  variance_ /= static_cast<double>(frame.area());
}

void WholeFrame::make(NumberedNoise noise) {
  for (int row = 0; row < waves_.rows; ++row) noise.fill(row, 0, waves_.cols, waves_.ptr<float>(row));
  cv::dft(waves_, waves_);
  cv::multiply(waves_, gains_, waves_);
  cv::idft(waves_, waves_, cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  waves_(cv::Rect(cv::Point(), size_)).copyTo(heights_);
}

}  // namespace mems_stiction
