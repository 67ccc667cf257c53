#include "surface/translated_gaussian_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mems_stiction/errors/errors.hpp"
#include "surface/gaussian_surface.hpp"
#include "surface/johnson_translation.hpp"

namespace mems_stiction {

void TranslatedGaussianOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  gaussian.describe(visitor, prefix);
  visitor.number(prefix + "/skewness", skewness, "", Range::within(-4.0, 4.0),
                 "skewness of the heights; Gaussian: 0");
  visitor.number(prefix + "/kurtosis", kurtosis, "",
                 Range::within(skewness * skewness + 1.2, 100.0),
                 "kurtosis of the heights, at least skewness^2 + 1.2; Gaussian: 3");
}

std::vector<std::string> TranslatedGaussianOptions::validate(const std::string& prefix) const {
  return rangeViolations(*this, prefix);
}

HeightMap translatedGaussianSurface(const TranslatedGaussianOptions& options) {
  std::vector<std::string> violations = options.validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));
  if (options.skewness == 0.0 && options.kurtosis == 3.0) return gaussianSurface(options.gaussian);

  const JohnsonTranslation translation(options.skewness, options.kurtosis);
  // exp(-(l/l_g)^2) is the correlation that the translation turns into 1/e.
  const double stretch =
      1.0 / std::sqrt(-std::log(translation.gaussianCorrelation(std::exp(-1.0))));
  GaussianSurfaceOptions gaussian = options.gaussian;
  gaussian.rms_height = 1.0;
  const auto stretched = [stretch](double length, double frame) {
    return std::min(stretch * length, 0.5 * frame);
  };
  gaussian.correlation_length_x =
      stretched(gaussian.correlation_length_x, gaussian.cols * gaussian.pitch_x);
  gaussian.correlation_length_y =
      stretched(gaussian.correlation_length_y, gaussian.rows * gaussian.pitch_y);
  cv::Mat heights = gaussianSurface(gaussian).heights();
  for (int row = 0; row < heights.rows; ++row) {
    double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) line[col] = translation(line[col]);
  }
  heights -= cv::mean(heights)[0];
  const HeightMap unscaled(heights, gaussian.pitch_x, gaussian.pitch_y);
  heights *= options.gaussian.rms_height / heightStatistics(unscaled).rms_height;
  return {heights, gaussian.pitch_x, gaussian.pitch_y};
}

}  // namespace mems_stiction
