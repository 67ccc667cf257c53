#include "preprocess/spike_removal.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

HeightMap withoutSpikes(const HeightMap& surface, const SpikeOptions& options) {
  WorkingSurface work(surface);
  removeSpikes(work, options);
  return work.surface();
}

SpikeOptions enabled() {
  SpikeOptions options;
  options.enabled = true;
  return options;
}

GaussianSurfaceOptions rough() {
  GaussianSurfaceOptions options;
  options.rows = 200;
  options.cols = 260;
  options.rms_height = 3e-9;
  return options;
}

int removedCount(const HeightMap& before, const HeightMap& after) {
  return heightStatistics(before).valid_count - heightStatistics(after).valid_count;
}

TEST(SpikeRemoval, takesEverySpikeAndNothingElse) {
  const HeightMap tilt = analytic::tiltedPlane(200, 260, 10e-9, 10e-9, 0.3, -0.2);
  const HeightMap clean = analytic::sum(gaussianSurface(rough()), tilt);
  cv::Mat heights = clean.heights().clone();
  // up and down, alone and two by two, in the corner and on the border
  const std::vector<cv::Rect> spikes = {
      {50, 60, 1, 1}, {100, 20, 2, 2}, {0, 0, 1, 1}, {259, 100, 1, 1}, {7, 199, 2, 1}};
  int count = 0;
  for (const cv::Rect& spike : spikes) {
    heights(spike) += count % 2 == 0 ? 30e-9 : -30e-9;
    count += spike.area();
  }
  const HeightMap surface(heights, 10e-9, 10e-9);
  const HeightMap found = withoutSpikes(surface, enabled());
  for (const cv::Rect& spike : spikes)
    EXPECT_TRUE(std::isnan(found.height(spike.y, spike.x))) << spike;
  EXPECT_EQ(removedCount(surface, found), count);
}

TEST(SpikeRemoval, leavesACleanGaussianSurfaceAlone) {
  const HeightMap clean = gaussianSurface(rough());
  EXPECT_EQ(removedCount(clean, withoutSpikes(clean, enabled())), 0);
}

TEST(SpikeRemoval, doesNotTakeTheApexOfASphere) {
  const HeightMap sphere = analytic::paraboloid(101, 101, 10e-9, 10e-9, 2e-6);
  EXPECT_EQ(removedCount(sphere, withoutSpikes(sphere, enabled())), 0);
}

TEST(SpikeRemoval, findsOneSpikeOnAPerfectPlane) {
  cv::Mat heights = analytic::tiltedPlane(50, 40, 5e-9, 5e-9, 0.1, 0.2).heights();
  heights.at<double>(20, 10) += 8e-9;
  const HeightMap surface(heights, 5e-9, 5e-9);
  const HeightMap found = withoutSpikes(surface, enabled());
  EXPECT_TRUE(std::isnan(found.height(20, 10)));
  EXPECT_EQ(removedCount(surface, found), 1);
}

TEST(SpikeRemoval, doesNotTakeTheSingleCountsOfACoarseInstrument) {
  cv::Mat heights = gaussianSurface(rough()).heights();
  const double count = 7e-9;  // more than two rms heights: most neighbours read the same
  for (auto pixel = heights.begin<double>(); pixel != heights.end<double>(); ++pixel) {
    *pixel = std::round(*pixel / count) * count;
  }
  const HeightMap surface(heights, 10e-9, 10e-9);
  EXPECT_EQ(removedCount(surface, withoutSpikes(surface, enabled())), 0);
}

TEST(SpikeRemoval, keepsValidPixelsToTheBitAndInvalidOnesInvalid) {
  const HeightMap clean = analytic::withInvalidPixel(gaussianSurface(rough()), 5, 6);
  const HeightMap found = withoutSpikes(clean, enabled());
  EXPECT_TRUE(std::isnan(found.height(5, 6)));
  EXPECT_EQ(found.height(50, 60), clean.height(50, 60));
  const cv::Mat nothing(3, 3, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THROW(withoutSpikes(HeightMap(nothing, 1e-9, 1e-9), enabled()), SurfaceError);
}

}  // namespace
}  // namespace mems_stiction
