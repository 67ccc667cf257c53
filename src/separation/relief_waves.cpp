#include "mems_stiction/separation/relief_waves.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace mems_stiction {
namespace {

/// f(q) = 1/(1 + (kLengths l q)^4)
constexpr double kLengths = 2.0;

}  // namespace

void ReliefWaves::split(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, double cohesive_length) {
  const auto long_part = [=](double q) {
    const double square = kLengths * cohesive_length * q * kLengths * cohesive_length * q;
    return 1.0 / (1.0 + square * square);
  };
  const cv::Mat1d& tension = relief.weighed([=](double q) { return -0.5 * contact_modulus * q * long_part(q); });
  cv::minMaxLoc(tension, nullptr, &largest_tension_);
  largest_tension_ = std::max(0.0, largest_tension_);
  cv::resize(relief.weighed(long_part)(cv::Rect({0, 0}, relief.blocks())), long_heights_, cells, 0.0, 0.0,
             cv::INTER_LINEAR);
}

}  // namespace mems_stiction
