#include <algorithm>
#include <mutex>

#include <fftw3.h>

#include "numeric/fftw_planner.hpp"
#include "surface/frame_filter.hpp"

namespace mems_stiction {
namespace {

/// Columns that are gathered at a time: whole lines of the processor's memory.
constexpr int kColumns = 8;

/// Columns of so many waves all begin where the library's instructions take several at once.
int alignedLength(int waves) { return (waves + kColumns - 1) / kColumns * kColumns; }

}  // namespace

/// A column is transformed, multiplied and transformed back while it is at hand. Plans are
/// estimated, never timed, so that they are the same in every run.
struct FrameFilter::Transforms {
  Transforms(const cv::Size& frame, int rows)
      : size(frame),
        waves(frame.width / 2 + 1),
        values(frame.height, 2 * waves, CV_32FC1),
        gathered(kColumns, alignedLength(frame.height), CV_32FC2),
        column(1, frame.height, CV_32FC2) {
    const std::lock_guard<std::mutex> lock(plannerMutex());
    const int width = size.width;
    auto* const real = values.ptr<float>();
    auto* const from = complex(gathered);
    auto* const to = complex(column);
    forward_rows = fftwf_plan_many_dft_r2c(1, &width, size.height, real, nullptr, 1, 2 * waves,
                                           complex(values), nullptr, 1, waves, FFTW_ESTIMATE);
    backward_rows = fftwf_plan_many_dft_c2r(1, &width, rows, complex(values), nullptr, 1, waves,
                                            real, nullptr, 1, 2 * waves, FFTW_ESTIMATE);
    forward_column = fftwf_plan_dft_1d(size.height, from, to, FFTW_FORWARD, FFTW_ESTIMATE);
    backward_column = fftwf_plan_dft_1d(size.height, to, from, FFTW_BACKWARD, FFTW_ESTIMATE);
  }
  ~Transforms() {
    const std::lock_guard<std::mutex> lock(plannerMutex());
    for (fftwf_plan plan : {forward_rows, backward_rows, forward_column, backward_column})
      fftwf_destroy_plan(plan);
  }
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;

  static fftwf_complex* complex(cv::Mat& values) {
    return reinterpret_cast<fftwf_complex*>(values.ptr<float>());
  }

  void filterColumns(const cv::Mat& gains, int first, int count) {
    for (int row = 0; row < size.height; ++row) {
      const cv::Vec2f* const line = values.ptr<cv::Vec2f>(row) + first;
      for (int i = 0; i < count; ++i) gathered.ptr<cv::Vec2f>(i)[row] = line[i];
    }
    for (int i = 0; i < count; ++i) {
      auto* const line = reinterpret_cast<fftwf_complex*>(gathered.ptr<float>(i));
      fftwf_execute_dft(forward_column, line, complex(column));
      const float* const gain = gains.ptr<float>(first + i);
      float* const wave = column.ptr<float>();
      for (int row = 0; row < size.height; ++row) {
        wave[2 * row] *= gain[row];
        wave[2 * row + 1] *= gain[row];
      }
      fftwf_execute_dft(backward_column, complex(column), line);
    }
    for (int row = 0; row < size.height; ++row) {
      cv::Vec2f* const line = values.ptr<cv::Vec2f>(row) + first;
      for (int i = 0; i < count; ++i) line[i] = gathered.ptr<cv::Vec2f>(i)[row];
    }
  }

  cv::Size size;
  int waves;         ///< along a row, from 0 to half its width
  cv::Mat values;    ///< rows, then their waves in their place
  cv::Mat gathered;  ///< columns of waves, side by side
  cv::Mat column;
  fftwf_plan forward_rows;
  fftwf_plan backward_rows;
  fftwf_plan forward_column;
  fftwf_plan backward_column;
};

FrameFilter::FrameFilter(const cv::Size& frame, int rows)
    : transforms_(std::make_unique<Transforms>(frame, rows)) {}
FrameFilter::~FrameFilter() = default;
FrameFilter::FrameFilter(FrameFilter&& other) noexcept = default;
FrameFilter& FrameFilter::operator=(FrameFilter&& other) noexcept = default;

float* FrameFilter::row(int row) { return transforms_->values.ptr<float>(row); }

void FrameFilter::apply(const cv::Mat& gains) {
  fftwf_execute(transforms_->forward_rows);
  for (int first = 0; first < transforms_->waves; first += kColumns) {
    transforms_->filterColumns(gains, first, std::min(kColumns, transforms_->waves - first));
  }
  fftwf_execute(transforms_->backward_rows);
}

}  // namespace mems_stiction
