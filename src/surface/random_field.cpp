#include "surface/random_field.hpp"

#include <cstdint>
#include <random>

namespace mems_stiction {

cv::Mat whiteNoise(int rows, int cols, int seed) {
  cv::Mat noise(rows, cols, CV_64FC1);
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  for (int row = 0; row < rows; ++row) {
    double* line = noise.ptr<double>(row);
    for (int col = 0; col < cols; ++col) line[col] = normal(engine);
  }
  return noise;
}

cv::Mat filteredNoise(const cv::Mat& noise, const std::function<double(int, int)>& gain) {
  cv::Mat spectrum;
  cv::dft(noise, spectrum, cv::DFT_COMPLEX_OUTPUT);
  for (int row = 0; row < spectrum.rows; ++row) {
    cv::Vec2d* line = spectrum.ptr<cv::Vec2d>(row);
    for (int col = 0; col < spectrum.cols; ++col) line[col] *= gain(row, col);
  }
  spectrum.at<cv::Vec2d>(0, 0) = cv::Vec2d(0.0, 0.0);
  cv::Mat filtered;
  cv::dft(spectrum, filtered, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return filtered;
}

}  // namespace mems_stiction
