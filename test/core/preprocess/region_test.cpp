/// A region of interest: what lies outside is as if it had not been measured, in steps and figures,
/// and contacts at its border are flagged.

#include "preprocess/region.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 1e-8;

class RegionTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "region_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string written(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }

  std::filesystem::path folder_;
};

/// rows x cols with a dome of 3 nm over each centre.
HeightMap domes(int rows, int cols, const std::vector<cv::Point>& centres) {
  cv::Mat heights = cv::Mat::zeros(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      double& height = heights.at<double>(row, col);
      for (const cv::Point& centre : centres) {
        const double square = std::pow(row - centre.y, 2) + std::pow(col - centre.x, 2);
        height = std::max(height, 3e-9 - square * kPitch * kPitch / 2e-6);
      }
    }
  }
  return {heights, kPitch, kPitch};
}

cv::Mat outsideOf(const RegionOptions& options, const cv::Size& size) {
  return Region(options).outside(size, kPitch, kPitch).clone();
}

TEST_F(RegionTest, ARectangleHoldsThePixelsWhoseMiddleLiesInside) {
  RegionOptions options;
  options.left = 2 * kPitch;
  options.top = 1 * kPitch;
  options.width = 3 * kPitch;
  const cv::Mat outside = outsideOf(options, {8, 4});
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 8; ++col) {
      EXPECT_EQ(outside.at<uchar>(row, col) == 0, row >= 1 && col >= 2 && col < 5)
          << row << " " << col;
    }
  }
}

TEST_F(RegionTest, APolygonAndAMaskCutWhatIsLeft) {
  RegionOptions options;
  options.polygon_file =
      written("corners.txt", "# the left half, in metres\n0 0\n4e-8, 0\n4e-8 4e-8\n0 4e-8\n");
  EXPECT_EQ(cv::countNonZero(outsideOf(options, {8, 4})), 16);
  options.mask_file =
      written("mask.txt", "0 1 1 1 1 1 1 1\n0 1 1 1 1 1 1 1\n0 1 1 1 1 1 1 1\n0 0 0 0 0 0 0 0\n");
  EXPECT_EQ(cv::countNonZero(outsideOf(options, {8, 4})), 32 - 9);
}

TEST_F(RegionTest, FilesThatCannotBeUsedAreNamedByTheirKey) {
  RegionOptions options;
  options.polygon_file = (folder_ / "missing.txt").string();
  EXPECT_THROW(Region region(options), OptionsError);
  options.polygon_file = written("two.txt", "0 0\n1e-8 0\n");
  EXPECT_THROW(Region region(options), OptionsError);
  options.polygon_file = written("words.txt", "0 0\n1e-8 0\nhere there\n");
  try {
    Region region(options);
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    EXPECT_NE(std::string(error.what()).find("preprocessing/region/polygon_file"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("line 3"), std::string::npos) << error.what();
  }
  options = RegionOptions();
  options.mask_file = written("mask.txt", "1 1\n1 0\n");
  EXPECT_THROW(outsideOf(options, {8, 4}), SurfaceError);  // of another size
  options = RegionOptions();
  options.left = 1.0;
  EXPECT_THROW(outsideOf(options, {8, 4}), SurfaceError);  // nothing lies inside
}

TEST_F(RegionTest, NoLaterStepSeesOrFillsWhatLiesOutside) {
  cv::Mat heights = cv::Mat::zeros(16, 16, CV_64FC1);
  heights.colRange(8, 16).setTo(5e-6);  // a step that would tilt the plane
  heights.at<double>(4, 4) = std::numeric_limits<double>::quiet_NaN();
  PipelineOptions options;
  options.region.width = 8 * kPitch;
  options.fill.enabled = true;
  options.level.shape = LevelShape::kPlane;
  const CleanedScan cleaned = cleanScan({heights, kPitch, kPitch}, options);
  EXPECT_EQ(cv::countNonZero(cleaned.outside), 128);
  for (int row = 0; row < 16; ++row) {
    for (int col = 0; col < 16; ++col) {
      const double height = cleaned.surface.heights().at<double>(row, col);
      if (col < 8) {
        EXPECT_NEAR(height, 0.0, 1e-20)
            << row << " " << col;  // round-off of levelling a plane of zeros
      } else {
        EXPECT_TRUE(std::isnan(height)) << row << " " << col;
      }
    }
  }
  ASSERT_EQ(cleaned.record.steps.front().name, "region");
  EXPECT_EQ(cleaned.record.steps.front().changed_pixels, 128);
  EXPECT_EQ(cleaned.record.steps[1].changed_pixels, 1);  // the hole, not the outside
}

TEST_F(RegionTest, FiguresAreThoseOfTheRegionAlone) {
  const HeightMap frame = domes(64, 128, {{32, 32}, {96, 32}});
  const HeightMap half(frame.heights().colRange(0, 64).clone(), kPitch, kPitch);
  Configuration configuration;
  configuration.preprocessing.region.width = 64 * kPitch;
  const Prediction of_region = ScanPredictor(configuration).predict(frame);
  const Prediction of_half = ScanPredictor(Configuration()).predict(half);
  EXPECT_DOUBLE_EQ(of_region.nominal_area, of_half.nominal_area);
  EXPECT_DOUBLE_EQ(of_region.rms_height, of_half.rms_height);
  EXPECT_EQ(of_region.asperity_count, of_half.asperity_count);
  EXPECT_NEAR(of_region.pull_off_force, of_half.pull_off_force,
              1e-9 * of_half.pull_off_force);  // order of sums
  EXPECT_EQ(of_region.invalid_fraction, 0.0);
}

TEST_F(RegionTest, AContactAtTheBorderOfTheRegionIsFlagged) {
  const HeightMap frame = domes(64, 128, {{32, 32}});
  const auto flagged = [&](double width) {
    Configuration configuration;
    configuration.preprocessing.region.width = width;
    const Prediction prediction = ScanPredictor(configuration).predict(frame);
    EXPECT_FALSE(prediction.asperities.empty());
    return !prediction.asperities.empty() && prediction.asperities.front().is_at_border;
  };
  EXPECT_FALSE(flagged(64 * kPitch));
  EXPECT_TRUE(flagged(32.6 * kPitch));  // ends at the summit
}

}  // namespace
}  // namespace mems_stiction
