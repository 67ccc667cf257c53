#include "surface/gaussian_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mems_stiction/errors/errors.hpp"
#include "surface/random_field.hpp"

namespace mems_stiction {
namespace {

/// Root of the spectrum of exp(-x^2/l^2), sampled at `count` points of a period and wrapped around
/// it.
std::vector<double> spectralFilter(int count, double pitch, double correlation_length) {
  cv::Mat correlation(1, count, CV_64FC1, cv::Scalar(0.0));
  const double period = count * pitch;
  // exp(-x^2/l^2) is below 1e-16 beyond 6.1 l
  const int images = 1 + static_cast<int>(std::ceil(6.1 * correlation_length / period));
  for (int index = 0; index < count; ++index) {
    for (int image = -images; image <= images; ++image) {
      const double distance = (index * pitch + image * period) / correlation_length;
      correlation.at<double>(0, index) += std::exp(-distance * distance);
    }
  }
  cv::Mat spectrum;
  cv::dft(correlation, spectrum, cv::DFT_COMPLEX_OUTPUT);
  std::vector<double> filter(static_cast<std::size_t>(count));
  for (int index = 0; index < count; ++index) {
    // real and positive but for round-off
    filter[static_cast<std::size_t>(index)] =
        std::sqrt(std::max(0.0, spectrum.at<cv::Vec2d>(0, index)[0]));
  }
  return filter;
}

}  // namespace

void GaussianSurfaceOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.integer(prefix + "/rows", rows, Range::within(2, 32768), "rows of the surface");
  visitor.integer(prefix + "/cols", cols, Range::within(2, 32768), "columns of the surface");
  visitor.number(prefix + "/pitch_x", pitch_x, "m", Range::positive(),
                 "distance of neighbouring columns");
  visitor.number(prefix + "/pitch_y", pitch_y, "m", Range::positive(),
                 "distance of neighbouring rows");
  visitor.number(prefix + "/rms_height", rms_height, "m", Range::nonNegative(),
                 "root mean square height, exact");
  visitor.number(prefix + "/correlation_length_x", correlation_length_x, "m",
                 Range{0.0, 0.5 * std::max(cols, 2) * pitch_x, true, false},
                 "distance along x at which the autocorrelation has fallen to 1/e");
  visitor.number(prefix + "/correlation_length_y", correlation_length_y, "m",
                 Range{0.0, 0.5 * std::max(rows, 2) * pitch_y, true, false},
                 "distance along y at which the autocorrelation has fallen to 1/e");
  visitor.integer(prefix + "/seed", seed, Range::within(0, std::numeric_limits<int>::max()),
                  "the same seed gives the same surface");
}

std::vector<std::string> GaussianSurfaceOptions::validate(const std::string& prefix) const {
  return rangeViolations(*this, prefix);
}

HeightMap gaussianSurface(const GaussianSurfaceOptions& options) {
  std::vector<std::string> violations = options.validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));

  const std::vector<double> filter_x =
      spectralFilter(options.cols, options.pitch_x, options.correlation_length_x);
  const std::vector<double> filter_y =
      spectralFilter(options.rows, options.pitch_y, options.correlation_length_y);
  cv::Mat heights =
      filteredNoise(whiteNoise(options.rows, options.cols, options.seed), [&](int row, int col) {
        return filter_y[static_cast<std::size_t>(row)] * filter_x[static_cast<std::size_t>(col)];
      });
  const double sample_rms =
      heightStatistics(HeightMap(heights, options.pitch_x, options.pitch_y)).rms_height;
  heights *= options.rms_height / sample_rms;
  return {heights, options.pitch_x, options.pitch_y};
}

}  // namespace mems_stiction
