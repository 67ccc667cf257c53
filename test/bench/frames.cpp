#include "bench/frames.hpp"

#include <map>
#include <random>
#include <utility>

#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace bench {
namespace {

constexpr double kPitch = 10e-9;
constexpr double kRmsHeight = 5e-9;

HeightMap gaussian(int size, double correlation_pixels) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = size;
  options.pitch_x = options.pitch_y = kPitch;
  options.rms_height = kRmsHeight;
  options.correlation_length_x = options.correlation_length_y = correlation_pixels * kPitch;
  return gaussianSurface(options);
}

HeightMap whiteNoise(int size) {
  cv::Mat heights(size, size, CV_64FC1);
  cv::RNG random(1);
  random.fill(heights, cv::RNG::NORMAL, 0.0, kRmsHeight);
  return {heights, kPitch, kPitch};
}

HeightMap make(Frame frame, int size) {
  switch (frame) {
    case Frame::kGaussian:
      return gaussian(size, 8.0);
    case Frame::kSmooth:
      return gaussian(size, 32.0);
    case Frame::kRough:
      return gaussian(size, 3.0);
    case Frame::kSpheres:
      return analytic::sphereArray(size, size, kPitch, kPitch, {2e-6, 5e-6}, 16, 16);
    case Frame::kWhiteNoise:
      return whiteNoise(size);
    case Frame::kPlane:
      break;
  }
  return analytic::flat(size, size, kPitch, kPitch);
}

}  // namespace

std::string frameName(Frame frame) {
  switch (frame) {
    case Frame::kGaussian:
      return "gaussian";
    case Frame::kSmooth:
      return "smooth";
    case Frame::kRough:
      return "rough";
    case Frame::kSpheres:
      return "spheres";
    case Frame::kWhiteNoise:
      return "white_noise";
    case Frame::kPlane:
      break;
  }
  return "plane";
}

const HeightMap& frameOf(Frame frame, int size) {
  static std::map<std::pair<Frame, int>, HeightMap> frames;
  auto& entry = frames[{frame, size}];
  if (entry.empty()) entry = analytic::asSingle(make(frame, size));
  return entry;
}

}  // namespace bench
}  // namespace mems_stiction
