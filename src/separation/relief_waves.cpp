#include "separation/relief_waves.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace mems_stiction {
namespace {

/// A block, or the one that it is the mirror image of.
int unmirrored(int block, int count) { return block < count ? block : 2 * count - 1 - block; }

}  // namespace

template <typename LongPart>
void ReliefWaves::takeLong(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, const LongPart& long_part) {
  energy_ = relief.meanSquare([&](double q) {
    const double left = 1.0 - long_part(q);
    return 0.25 * contact_modulus * q * (1.0 - left * left);
  });
  cv::resize(relief.weighed(long_part)(cv::Rect({0, 0}, relief.blocks())), long_heights_, cells, 0.0, 0.0,
             cv::INTER_LINEAR);
}

void ReliefWaves::splitHeights(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, double length) {
  takeLong(relief, cells, contact_modulus, [=](double q) { return 1.0 / (1.0 + length * q * length * q); });
}

void ReliefWaves::split(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, double cohesive_length) {
  const auto long_part = [=](double q) { return 1.0 / (1.0 + cohesive_length * q * cohesive_length * q); };
  const cv::Mat1d& tension = relief.weighed([=](double q) { return -0.5 * contact_modulus * q * long_part(q); });
  cv::Point weakest;
  cv::minMaxLoc(tension, nullptr, &largest_tension_, nullptr, &weakest);
  largest_tension_ = std::max(0.0, largest_tension_);
  const cv::Size blocks = relief.blocks();
  weakest_place_ = {(unmirrored(weakest.x, blocks.width) + 0.5) * cells.width / blocks.width,
                    (unmirrored(weakest.y, blocks.height) + 0.5) * cells.height / blocks.height};
  takeLong(relief, cells, contact_modulus, long_part);
}

}  // namespace mems_stiction
