#include "evaluation/cleaning_spread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 5e-9;

HeightMap rough() {
  GaussianSurfaceOptions options;
  options.rows = 96;
  options.cols = 128;
  options.pitch_x = options.pitch_y = kPitch;
  options.rms_height = 2e-9;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  options.seed = 5;
  return gaussianSurface(options);
}

HeightMap tilted(double slope) {
  cv::Mat heights = rough().heights().clone();
  for (int row = 0; row < heights.rows; ++row) heights.row(row) += slope * row * kPitch;
  return {heights, kPitch, kPitch};
}

Configuration withDevice() {
  Configuration configuration;
  configuration.device.spring_stiffness = 1.0;
  configuration.device.travel = 1e-6;
  configuration.device.contact_area = 1e-12;
  return configuration;
}

const CleaningRow& rowNamed(const std::vector<CleaningRow>& rows, const std::string& cleaning) {
  return *std::find_if(rows.begin(), rows.end(),
                       [&](const CleaningRow& row) { return row.cleaning == cleaning; });
}

TEST(CleaningSpread, EachRowIsThePredictionUnderItsCleaning) {
  const HeightMap scan = tilted(0.05);
  const std::vector<CleaningRow> rows = cleaningSpread(scan, withDevice());
  ASSERT_EQ(rows.size(), 9u);
  Configuration configuration = withDevice();
  EXPECT_EQ(rows[0].pull_off_force, ScanPredictor(configuration).predict(scan).pull_off_force);
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  const Prediction levelled = ScanPredictor(configuration).predict(scan);
  EXPECT_EQ(rowNamed(rows, "plane").pull_off_force, levelled.pull_off_force);
  EXPECT_EQ(rowNamed(rows, "plane").contact_area, levelled.contact_area);
  configuration.preprocessing.lines.method = LineAlignment::kMedian;
  configuration.preprocessing.spikes.enabled = configuration.preprocessing.fill.enabled = true;
  EXPECT_EQ(rowNamed(rows, "row medians and plane, spikes filled").pull_off_force,
            ScanPredictor(configuration).predict(scan).pull_off_force);
}

TEST(CleaningSpread, ATiltedScanThatIsNotLevelledDoesNotCount) {
  const std::vector<CleaningRow> steep = cleaningSpread(tilted(0.1), Configuration());
  EXPECT_FALSE(rowNamed(steep, "not levelled").is_reasonable);
  EXPECT_TRUE(rowNamed(steep, "plane").is_reasonable);
  EXPECT_TRUE(rowNamed(cleaningSpread(rough(), Configuration()), "not levelled").is_reasonable);
}

TEST(CleaningSpread, SpreadIsOfTheRowsThatCount) {
  std::vector<CleaningRow> rows(3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].is_reasonable = i != 2;
    rows[i].pull_off_force = i == 0 ? 2e-7 : i == 1 ? 3e-7 : 9e-7;
    rows[i].margin = 6e-7 / rows[i].pull_off_force;
    rows[i].margin_lower = 0.5 * rows[i].margin;
    rows[i].margin_upper = 2.0 * rows[i].margin;
  }
  const CleaningSpread spread = spreadOf(rows);
  EXPECT_EQ(spread.count, 2);
  EXPECT_DOUBLE_EQ(spread.pull_off_factor, 1.5);
  EXPECT_DOUBLE_EQ(spread.margin_factor, 1.5);
  EXPECT_DOUBLE_EQ(spread.margin_lower, 1.0) << "of the margin 2";
  EXPECT_DOUBLE_EQ(spread.margin_upper, 6.0) << "of the margin 3";
  EXPECT_TRUE(std::isnan(spreadOf({}).pull_off_factor));
}

TEST(CleaningReach, IsOverTheScanAsConfiguredOfTheRowsThatCount) {
  std::vector<CleaningRow> rows(5);
  const double forces[] = {2e-7, 1e-7, 6e-7, 9e-7, 0.0};
  const double works[] = {0.01, 0.02, CleaningRow::kUnknown, 0.5, 0.0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].is_reasonable = i != 3;
    rows[i].pull_off_force = forces[i];
    rows[i].apparent_work_of_adhesion = works[i];
  }
  const CleaningReach reach = reachOf(rows);
  EXPECT_DOUBLE_EQ(reach.pull_off.lowest, 0.5);
  EXPECT_DOUBLE_EQ(reach.pull_off.highest, 3.0);
  EXPECT_DOUBLE_EQ(reach.apparent_work.lowest, 1.0);
  EXPECT_DOUBLE_EQ(reach.apparent_work.highest, 2.0);
}

TEST(CleaningSpread, WithoutADeviceThereIsNoMargin) {
  const std::vector<CleaningRow> rows = cleaningSpread(rough(), Configuration());
  EXPECT_TRUE(std::isnan(spreadOf(rows).margin_factor));
  EXPECT_GE(spreadOf(rows).pull_off_factor, 1.0);
  EXPECT_EQ(cleaningTable(rows).find("The margin changes"), std::string::npos);
  EXPECT_NE(cleaningTable(rows, "# ").find("# Over 9 cleanings"), std::string::npos);
}

TEST(CleaningSpread, ACleaningThatTheScanCannotTakeSaysWhyAndDoesNotCount) {
  Configuration configuration;
  cv::Mat heights = rough().heights().clone();
  heights.rowRange(0, 40).setTo(
      std::nan(""));  // more is missing than preprocessing/fill/max_fraction
  const std::vector<CleaningRow> rows = cleaningSpread({heights, kPitch, kPitch}, configuration);
  const CleaningRow& filled = rowNamed(rows, "plane, spikes filled");
  EXPECT_FALSE(filled.message.empty());
  EXPECT_FALSE(filled.is_reasonable);
  EXPECT_TRUE(std::isnan(filled.pull_off_force));
  EXPECT_TRUE(rowNamed(rows, "plane").message.empty());
  EXPECT_EQ(spreadOf(rows).count, 5);
}

}  // namespace
}  // namespace mems_stiction
