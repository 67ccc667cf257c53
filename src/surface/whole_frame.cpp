#include "surface/whole_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Sides of the frame over those of the surface.
constexpr double kWiderFrame = 1.5;
/// Up to this number a wave stands for a cell of waves whose density varies, sampled at so many
/// places along each axis.
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
  if (std::max(std::abs(number_x), std::abs(number_y)) > kLongWaves)
    return power(number_x * step_x, number_y * step_y);
  double sum = 0.0;
  for (int i = 0; i < kSamplesOfCell; ++i) {
    for (int j = 0; j < kSamplesOfCell; ++j) {
      sum += power((number_x + (j + 0.5) / kSamplesOfCell - 0.5) * step_x,
                   (number_y + (i + 0.5) / kSamplesOfCell - 0.5) * step_y);
    }
  }
  return sum / (kSamplesOfCell * kSamplesOfCell);
}

}  // namespace

WholeFrame::WholeFrame(const WavePower& power, int rows, int cols, bool is_even)
    : size_(cols, rows),
      frame_(sideOfFrame(cols), sideOfFrame(rows)),
      gains_(frame_.width / 2 + 1, frame_.height, CV_32FC1),
      filter_(frame_, rows) {
  const double pixels = frame_.area();
  for (int number_x = 0; number_x < gains_.rows; ++number_x) {
    float* line = gains_.ptr<float>(number_x);
    const bool is_half =
        number_x > 0 && 2 * number_x < frame_.width;  // the wave (-x, -y) is there, too
    for (int row = 0; row < frame_.height; ++row) {
      const int number_y = 2 * row <= frame_.height ? row : row - frame_.height;
      if (is_even && number_y < 0) {
        line[row] = line[-number_y];
        continue;
      }
      const double found = powerOf(power, number_x, number_y, frame_);
      line[row] = static_cast<float>(std::sqrt(found) / pixels);
      const bool is_twice = is_even && row > 0 && 2 * row < frame_.height;
      variance_ += found * (is_half ? 2.0 : 1.0) * (is_twice ? 2.0 : 1.0);
    }
  }
  variance_ /= pixels;
}

void WholeFrame::make(NumberedNoise noise) {
  for (int row = 0; row < frame_.height; ++row) noise.fill(row, 0, frame_.width, filter_.row(row));
  filter_.apply(gains_);
  heights_.create(size_, CV_32FC1);
  for (int row = 0; row < size_.height; ++row) {
    std::copy_n(filter_.row(row), size_.width, heights_.ptr<float>(row));
  }
}

}  // namespace mems_stiction
