#include "evaluation/block_maxima.hpp"

#include <algorithm>
#include <cstdint>

namespace mems_stiction {

cv::Mat blockMaxima(const cv::Mat& cells, int factor) {
  cv::Mat maxima(cells.size() / factor, CV_8UC1, cv::Scalar(0));
  for (int row = 0; row < cells.rows; ++row) {
    const std::uint8_t* source = cells.ptr<std::uint8_t>(row);
    std::uint8_t* target = maxima.ptr<std::uint8_t>(row / factor);
    for (int col = 0; col < cells.cols; ++col)
      target[col / factor] = std::max(target[col / factor], source[col]);
  }
  return maxima;
}

}  // namespace mems_stiction
