#include "preprocess/recipe.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mems_stiction/preprocess/pipeline.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;

/// Roughness of 2 nm under a tilt of about a micrometre.
cv::Mat tilted() {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 200;
  options.pitch_x = options.pitch_y = kPitch;
  options.rms_height = 2e-9;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  cv::Mat heights = gaussianSurface(options).asDouble().heights().clone();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col)
      heights.at<double>(row, col) += 3e-9 * col + 2e-9 * row;
  }
  return heights;
}

CleaningRecipe recipeFor(const cv::Mat& heights) {
  return cleaningRecipe({heights, kPitch, kPitch});
}

TEST(CleaningRecipe, ATiltedScanNeedsAPlaneAlone) {
  const CleaningRecipe recipe = recipeFor(tilted());
  EXPECT_FALSE(recipe.needsMoreThanAPlane()) << recipe.sentence();
  EXPECT_EQ(recipe.steps.level.shape, LevelShape::kPlane);
  EXPECT_GT(recipe.rms_height, 100e-9);
  EXPECT_NEAR(recipe.cleaned_rms_height, 2e-9, 0.2e-9);
  EXPECT_LT(recipe.line_jumps, 0.2e-9);
}

TEST(CleaningRecipe, NamesWhatElseAScanNeedsAndWhatThatChanges) {
  cv::Mat heights = tilted();
  std::mt19937 engine(5);
  std::normal_distribution<double> jump(0.0, 3e-9);
  double drift = 0.0;
  for (int row = 0; row < heights.rows; ++row) heights.row(row) += drift += jump(engine);
  for (int spike = 0; spike < 7; ++spike)
    heights.at<double>(20 + 20 * spike, 30 + 15 * spike) += 200e-9;
  heights.at<double>(9, 9) = std::numeric_limits<double>::quiet_NaN();
  const CleaningRecipe recipe = recipeFor(heights);
  EXPECT_EQ(recipe.steps.lines.method, LineAlignment::kMedianDifference);
  EXPECT_NEAR(recipe.line_jumps, 3e-9, 0.6e-9);
  EXPECT_EQ(recipe.spikes, 7);
  EXPECT_EQ(recipe.missing, 1);
  EXPECT_TRUE(recipe.steps.fill.enabled);
  EXPECT_NEAR(recipe.cleaned_rms_height, 2e-9, 0.4e-9);
  const CleanedScan cleaned = cleanScan({heights, kPitch, kPitch}, recipe.steps);
  EXPECT_EQ(heightStatistics(cleaned.surface).rms_height, recipe.cleaned_rms_height);
  const std::string sentence = recipe.sentence();
  for (const char* words :
       {"preprocessing/level: plane", "preprocessing/lines/method: median_difference",
        "preprocessing/spikes/enabled: true", "preprocessing/fill/enabled: true", "7 pixels jump",
        "1 pixel is missing"}) {
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  }
  EXPECT_EQ(sentence.find(','), std::string::npos);
}

TEST(CleaningRecipe, LevelsRobustlyUnderTallFeatures) {
  cv::Mat heights = tilted();
  heights.colRange(0, 60) += 150e-9;
  EXPECT_TRUE(recipeFor(heights).steps.level.robust);
}

}  // namespace
}  // namespace mems_stiction
