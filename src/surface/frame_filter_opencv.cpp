#include "surface/frame_filter.hpp"

namespace mems_stiction {
namespace {

/// Number of the wave at a place of a packed line, whose first is 0 and whose last of an even count
/// is count/2.
int packedNumber(int place) { return (place + 1) / 2; }

}  // namespace

struct FrameFilter::Transforms {
  explicit Transforms(const cv::Size& frame) : values(frame, CV_32FC1) {}

  cv::Mat values;
};

FrameFilter::FrameFilter(const cv::Size& frame, int /*rows*/)
    : transforms_(std::make_unique<Transforms>(frame)) {}
FrameFilter::~FrameFilter() = default;
FrameFilter::FrameFilter(FrameFilter&& other) noexcept = default;
FrameFilter& FrameFilter::operator=(FrameFilter&& other) noexcept = default;

float* FrameFilter::row(int row) { return transforms_->values.ptr<float>(row); }

void FrameFilter::apply(const cv::Mat& gains) {
  cv::Mat& waves = transforms_->values;
  cv::dft(waves, waves);
  for (int row = 0; row < waves.rows; ++row) {
    float* line = waves.ptr<float>(row);
    for (int col = 0; col < waves.cols; ++col) {
      // the first column, and the last one of an even count, hold the waves along y, packed; all
      // others hold theirs at their rows
      const bool is_along_y = col == 0 || (col == waves.cols - 1 && waves.cols % 2 == 0);
      line[col] *= gains.at<float>(packedNumber(col), is_along_y ? packedNumber(row) : row);
    }
  }
  cv::idft(waves, waves, cv::DFT_REAL_OUTPUT);
}

}  // namespace mems_stiction
