#include "preprocess/tip_correction.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "height_map/validity.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

TipOptions sphere(double radius, double half_angle = 0.0) {
  TipOptions tip;
  tip.radius = radius;
  tip.half_angle = half_angle;
  return tip;
}

/// A half-sphere of the given radius standing on a plane at z = 0, its middle in the middle of the
/// frame.
HeightMap ballOnPlane(int side, double pitch, double radius) {
  cv::Mat heights(side, side, CV_64FC1);
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col) {
      const double r = std::hypot(row - 0.5 * (side - 1), col - 0.5 * (side - 1)) * pitch;
      heights.at<double>(row, col) = r < radius ? std::sqrt(radius * radius - r * r) : 0.0;
    }
  }
  return {heights, pitch, pitch};
}

/// What a spherical tip draws of it: a sphere of the radius R + tip about the same middle, less the
/// tip's radius.
HeightMap imageOfBall(int side, double pitch, double radius, double tip_radius) {
  cv::Mat heights(side, side, CV_64FC1);
  const double sum = radius + tip_radius;
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col) {
      const double r = std::hypot(row - 0.5 * (side - 1), col - 0.5 * (side - 1)) * pitch;
      const double height = r < sum ? std::sqrt(sum * sum - r * r) - tip_radius : 0.0;
      heights.at<double>(row, col) = std::max(0.0, height);
    }
  }
  return {heights, pitch, pitch};
}

/// Radius of the sphere whose cap of height h has this cross-section: r^2 = 2 R h - h^2 at the
/// distance r.
double radiusAt(const HeightMap& surface, int pixels) {
  const int middle = surface.rows() / 2;
  const double r = pixels * surface.pitchX();
  const double h = surface.height(middle, middle) - surface.height(middle, middle + pixels);
  return (r * r + h * h) / (2.0 * h);
}

TEST(TipDepth, isASphereThenACone) {
  const TipOptions tip = sphere(10e-9, kPi / 6.0);
  EXPECT_EQ(tipDepth(tip, 0.0), 0.0);
  EXPECT_NEAR(tipDepth(tip, 6e-9), 10e-9 - 8e-9, 1e-22);
  const double tangent = 10e-9 * std::cos(kPi / 6.0);
  EXPECT_NEAR(tipDepth(tip, tangent), 5e-9, 1e-22);
  EXPECT_NEAR(tipDepth(tip, tangent + 1e-9), 5e-9 + 1e-9 * std::sqrt(3.0), 1e-22);
  EXPECT_TRUE(std::isinf(tipDepth(sphere(10e-9), 10.1e-9)));
}

TEST(TipCorrection, givesTheRadiusOfADilatedSphereBack) {
  const double radius = 100e-9;
  const double tip_radius = 40e-9;
  // The image is the closed form, not our own dilation.
  const HeightMap image = imageOfBall(151, 2e-9, radius, tip_radius);
  EXPECT_NEAR(radiusAt(image, 20), radius + tip_radius, 1e-12);
  const TipCorrection corrected = tipCorrected(image, sphere(tip_radius));
  for (const int pixels : {5, 10, 20, 35}) {
    EXPECT_NEAR(radiusAt(corrected.surface, pixels), radius, 0.03 * radius)
        << pixels << " pixels from the apex";
  }
  const int middle = 75;
  EXPECT_NEAR(corrected.surface.height(middle, middle), radius, 1e-12);
  // The upper half of the ball was touched; the foot of it, where tip and plane make a wedge, was
  // not.
  EXPECT_EQ(corrected.reached.at<uchar>(middle, middle + 20), 255);
  EXPECT_EQ(corrected.reached.at<uchar>(middle, middle + 55), 0);
  EXPECT_EQ(corrected.reached.at<uchar>(3, 3), 255);
  EXPECT_GT(corrected.unreached_fraction, 0.02);
  EXPECT_LT(corrected.unreached_fraction, 0.6);
}

TEST(TipCorrection, doesSoForAConicalTipAndOurOwnDilation) {
  const TipOptions tip = sphere(30e-9, 0.35);
  const HeightMap ball = ballOnPlane(141, 2e-9, 80e-9);
  const HeightMap image = tipImaged(ball, tip);
  EXPECT_GT(radiusAt(image, 20), 1.3 * 80e-9);
  const TipCorrection corrected = tipCorrected(image, tip);
  for (const int pixels : {5, 10, 20, 30})
    EXPECT_NEAR(radiusAt(corrected.surface, pixels), 80e-9, 0.03 * 80e-9);
}

TEST(TipCorrection, isNeverBelowTheSurfaceAndDrawsTheSameImage) {
  GaussianSurfaceOptions options;
  options.rows = 90;
  options.cols = 140;
  options.pitch_x = 2e-9;
  options.pitch_y = 3e-9;
  options.rms_height = 10e-9;
  options.correlation_length_x = options.correlation_length_y = 35e-9;
  const HeightMap surface = gaussianSurface(options);
  const TipOptions tip = sphere(30e-9, 0.4);
  const HeightMap image = tipImaged(surface, tip);
  const TipCorrection corrected = tipCorrected(image, tip);
  double lowest = 0.0;
  cv::minMaxLoc(corrected.surface.heights() - surface.heights(), &lowest, nullptr);
  EXPECT_GT(lowest, -1e-20);
  double largest = 0.0;
  cv::minMaxLoc(cv::abs(tipImaged(corrected.surface, tip).heights() - image.heights()), nullptr,
                &largest);
  EXPECT_LT(largest, 1e-20);

  // What counts as reached is the surface; what does not is far above it. Pixels that share a touch
  // with a neighbour on a steep flank are the few exceptions.
  const cv::Mat error = corrected.surface.heights() - surface.heights();
  const double wrong = cv::countNonZero((error > 0.2 * options.rms_height) & corrected.reached);
  EXPECT_LT(wrong / cv::countNonZero(corrected.reached), 0.03);
  EXPECT_GT(cv::mean(error, ~corrected.reached)[0], 10.0 * cv::mean(error, corrected.reached)[0]);
  EXPECT_GT(corrected.unreached_fraction, 0.1);
}

TEST(TipCorrection, reachesEverythingOnASurfaceBlunterThanTheTip) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 128;
  options.rms_height = 2e-9;
  options.correlation_length_x = options.correlation_length_y = 150e-9;  // valleys of 1 um and more
  const TipOptions tip = sphere(50e-9, 0.3);
  EXPECT_LT(tipCorrected(tipImaged(gaussianSurface(options), tip), tip).unreached_fraction, 0.01);
  const HeightMap flat = analytic::flat(40, 50, 10e-9, 15e-9, 1e-6);
  EXPECT_EQ(tipCorrected(flat, tip).unreached_fraction, 0.0);
  EXPECT_NEAR(tipCorrected(flat, tip).surface.height(0, 0), 1e-6, 1e-20);
}

TEST(TipCorrection, saysThatTheTipBridgedATrench) {
  cv::Mat heights = analytic::flat(60, 100, 2e-9, 2e-9).heights();
  heights(cv::Rect(45, 0, 10, 60)).setTo(-80e-9);  // 20 nm wide
  const HeightMap trench(heights, 2e-9, 2e-9);
  const TipCorrection blunt = tipCorrected(tipImaged(trench, sphere(50e-9)), sphere(50e-9));
  EXPECT_EQ(blunt.reached.at<uchar>(30, 50), 0);
  EXPECT_EQ(blunt.reached.at<uchar>(30, 20), 255);
  EXPECT_NEAR(blunt.unreached_fraction, 0.1, 0.04);
  EXPECT_GT(blunt.surface.height(30, 50), -2e-9);
  const TipCorrection sharp = tipCorrected(tipImaged(trench, sphere(4e-9)), sphere(4e-9));
  EXPECT_EQ(sharp.reached.at<uchar>(30, 50), 255);
  EXPECT_NEAR(sharp.surface.height(30, 50), -80e-9, 1e-20);
}

TEST(TipCorrection, invalidPixelsStayInvalidAndConstrainNothing) {
  const HeightMap image =
      analytic::withInvalidPixel(analytic::flat(20, 20, 2e-9, 2e-9, 1e-9), 10, 10);
  const TipCorrection corrected = tipCorrected(image, sphere(10e-9));
  EXPECT_TRUE(std::isnan(corrected.surface.height(10, 10)));
  EXPECT_EQ(heightStatistics(corrected.surface).valid_count, 399);
  EXPECT_NEAR(corrected.surface.height(10, 11), 1e-9, 1e-22);
  EXPECT_EQ(corrected.unreached_fraction, 0.0);
}

TEST(TipCorrection, aTipWithinOnePixelAndNoTipChangeNothing) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 40;
  const HeightMap surface = gaussianSurface(options);
  for (const double radius : {0.0, 1e-9}) {
    const TipCorrection corrected = tipCorrected(surface, sphere(radius));
    double largest = 0.0;
    cv::minMaxLoc(cv::abs(corrected.surface.heights() - surface.heights()), nullptr, &largest);
    EXPECT_LT(largest, 1e-22);
    EXPECT_EQ(corrected.unreached_fraction, 0.0);
  }
}

TEST(TipCorrection, takesSecondsForAMillionPixelsAndATipOfThirtyByThirty) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 1024;
  options.pitch_x = options.pitch_y = 2e-9;
  options.rms_height = 5e-9;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  const HeightMap image = tipImaged(gaussianSurface(options), sphere(30e-9));
  const auto start = std::chrono::steady_clock::now();
  const TipCorrection corrected = tipCorrected(image, sphere(30e-9));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(corrected.unreached_fraction, 0.0);
  // about two on an idle machine; a sanitizer takes ten times as long
  EXPECT_LT(seconds, std::getenv("MEMS_STICTION_SANITIZER") == nullptr ? 60.0 : 600.0);
  RecordProperty("seconds", std::to_string(seconds));
}

}  // namespace
}  // namespace mems_stiction
