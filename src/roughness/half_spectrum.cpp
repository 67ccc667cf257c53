#include "roughness/half_spectrum.hpp"

#include <algorithm>
#include <complex>

namespace mems_stiction {
namespace {

using Complex = std::complex<double>;

constexpr int kBlock =
    16;  ///< lines that are turned into columns at a time: their cache lines are then full

/// The transform of a real line as OpenCV packs it: Re 0, Re 1, Im 1, Re 2, ...
class PackedLine {
 public:
  PackedLine(double* line, int size) : line_(line), size_(size) {}

  Complex get(int index) const {
    if (index == 0) return line_[0];
    return {line_[2 * index - 1], 2 * index == size_ ? 0.0 : line_[2 * index]};
  }
  void set(int index, const Complex& value) {
    line_[index == 0 ? 0 : 2 * index - 1] = value.real();
    if (index > 0 && 2 * index < size_) line_[2 * index] = value.imag();
  }

 private:
  double* line_;
  int size_;
};

/// visit(i, j) for all i < rows and j < cols, in blocks.
template <typename Visit>
void forBlocks(int rows, int cols, const Visit& visit) {
  for (int first = 0; first < rows; first += kBlock) {
    for (int second = 0; second < cols; second += kBlock) {
      for (int j = second; j < std::min(second + kBlock, cols); ++j) {
        for (int i = first; i < std::min(first + kBlock, rows); ++i) visit(i, j);
      }
    }
  }
}

}  // namespace

cv::Mat halfSpectrum(const cv::Mat& values, const cv::Size& frame) {
  cv::Mat lines(values.rows, frame.width, CV_64FC1, cv::Scalar(0.0));
  values.copyTo(lines.colRange(0, values.cols));
  cv::dft(lines, lines, cv::DFT_ROWS);
  const int half = frame.width / 2;
  cv::Mat spectrum(half + 1, frame.height, CV_64FC2, cv::Scalar(0.0, 0.0));
  forBlocks(values.rows, half + 1, [&](int row, int k_x) {
    spectrum.ptr<Complex>(k_x)[row] = PackedLine(lines.ptr<double>(row), frame.width).get(k_x);
  });
  cv::dft(spectrum, spectrum, cv::DFT_ROWS);
  return spectrum;
}

cv::Mat pairSums(const cv::Mat& values, const cv::Size& frame, int half_rows, int half_cols) {
  const cv::Mat spectrum = halfSpectrum(values, frame);
  cv::Mat powers(spectrum.size(), CV_64FC1);
  for (int k_x = 0; k_x < powers.rows; ++k_x) {
    const Complex* line = spectrum.ptr<Complex>(k_x);
    double* power = powers.ptr<double>(k_x);
    for (int k_y = 0; k_y < powers.cols; ++k_y) power[k_y] = std::norm(line[k_y]);
  }
  // Back along y: powers are real, so that forward is backward but for the sign of the imaginary
  // part, and negative lags are the mirror image of positive ones.
  cv::dft(powers, powers, cv::DFT_ROWS);
  cv::Mat lines(half_rows + 1, frame.width, CV_64FC1);
  forBlocks(powers.rows, half_rows + 1, [&](int k_x, int lag) {
    PackedLine(lines.ptr<double>(lag), frame.width)
        .set(k_x, std::conj(PackedLine(powers.ptr<double>(k_x), frame.height).get(lag)));
  });
  cv::dft(lines, lines, cv::DFT_ROWS | cv::DFT_INVERSE | cv::DFT_SCALE);

  cv::Mat sums(2 * half_rows + 1, 2 * half_cols + 1, CV_64FC1);
  for (int row = 0; row <= half_rows; ++row) {
    const double* line = lines.ptr<double>(row);
    for (int col = -half_cols; col <= half_cols; ++col) {
      const double sum = line[(col + frame.width) % frame.width] / frame.height;
      sums.at<double>(half_rows + row, half_cols + col) = sum;
      sums.at<double>(half_rows - row, half_cols - col) = sum;
    }
  }
  return sums;
}

}  // namespace mems_stiction
