/// From lines to maps: uneven, lost and doubled lines, either axis, either way.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "ros/source/cloud_cases.hpp"
#include "source/line_map.hpp"

namespace mems_stiction {
namespace {

/// The lines of the known surface, one for each row of the map, in the order of rising y.
std::vector<ScanLine> evenLines() {
  std::vector<ScanLine> lines;
  for (int row = clouds::kRows - 1; row >= 0; --row) {
    ScanLine line;
    for (int col = 0; col < clouds::kCols; ++col) {
      const double x = clouds::xOf(col), y = clouds::yOf(row);
      line.emplace_back(x, y, clouds::surfaceAt(x, y));
    }
    lines.push_back(line);
  }
  return lines;
}

bool isSame(double one, double other) {
  return one == other || (std::isnan(one) && std::isnan(other));
}

void expectKnownSurface(const LineMap& result) {
  const HeightMap& map = result.map.surface;
  ASSERT_EQ(map.heights().size(), clouds::expectedMap().size());
  EXPECT_NEAR(map.pitchX(), clouds::kPitchX, 1e-9 * clouds::kPitchX);
  EXPECT_NEAR(map.pitchY(), clouds::kPitchY, 1e-9 * clouds::kPitchY);
  EXPECT_EQ(cv::norm(map.heights(), clouds::expectedMap(), cv::NORM_INF), 0.0);
}

TEST(LineMap, EvenLinesInAnyOrderAreTheSurface) {
  std::vector<ScanLine> lines = evenLines();
  expectKnownSurface(mapOfLines(lines, {}));
  std::reverse(lines.begin(), lines.end());
  expectKnownSurface(mapOfLines(lines, {}));
  for (ScanLine& line : lines) std::reverse(line.begin(), line.end());
  expectKnownSurface(mapOfLines(lines, {}));
}

TEST(LineMap, LinesAlongYAreTheSameSurface) {
  std::vector<ScanLine> lines;
  for (int col = 0; col < clouds::kCols; ++col) {
    ScanLine line;
    for (int row = 0; row < clouds::kRows; ++row) {
      const double x = clouds::xOf(col), y = clouds::yOf(row);
      line.emplace_back(x, y, clouds::surfaceAt(x, y));
    }
    lines.push_back(line);
  }
  expectKnownSurface(mapOfLines(lines, {}));
}

TEST(LineMap, DoubledLinesCountOnce) {
  std::vector<ScanLine> lines = evenLines();
  lines.insert(lines.begin() + 4, lines[3]);
  lines.push_back(lines.back());
  const LineMap result = mapOfLines(lines, {});
  expectKnownSurface(result);
  EXPECT_EQ(result.doubled, 2u);
  EXPECT_EQ(result.lost, 0u);
}

TEST(LineMap, ALostLineIsNotMeasuredAndCounted) {
  std::vector<ScanLine> lines = evenLines();
  lines.erase(lines.begin() + 3, lines.begin() + 5);  // of rising y: rows 8 and 7 of the map
  const LineMap result = mapOfLines(lines, {});
  EXPECT_EQ(result.lost, 2u);
  const cv::Mat& heights = result.map.surface.heights();
  ASSERT_EQ(heights.rows, clouds::kRows);
  for (int row = 0; row < heights.rows; ++row)
    EXPECT_EQ(std::isnan(heights.at<double>(row, 2)), row == 7 || row == 8);
}

TEST(LineMap, UnevenLinesAreInterpolated) {
  // A plane is what linear interpolation gets exactly, wherever the lines lie.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  std::vector<ScanLine> lines;
  for (int row = 0; row < 40; ++row) {
    const double y = (row + shift(random)) * clouds::kPitchY;
    ScanLine line;
    for (int col = 0; col < 30; ++col)
      line.emplace_back(col * clouds::kPitchX, y, 0.02 * y - 0.01 * col * clouds::kPitchX);
    lines.push_back(line);
  }
  LineMapOptions options;
  options.line_pitch = clouds::kPitchY;
  const LineMap result = mapOfLines(lines, options);
  EXPECT_EQ(result.lost + result.doubled, 0u);
  const cv::Mat& heights = result.map.surface.heights();
  const double top = heights.at<double>(0, 0);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      EXPECT_NEAR(heights.at<double>(row, col),
                  top - 0.02 * row * clouds::kPitchY - 0.01 * col * clouds::kPitchX,
                  2e-3 * 0.02 * clouds::kPitchY);
    }
  }
}

TEST(LineMap, PointsThatAreNotMeasuredStaySo) {
  std::vector<ScanLine> lines = evenLines();
  lines[2][5][2] = std::numeric_limits<double>::quiet_NaN();
  lines[6].assign(lines[6].size(), cv::Vec3d::all(std::numeric_limits<double>::quiet_NaN()));
  const cv::Mat heights = mapOfLines(lines, {}).map.surface.heights();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const int line = clouds::kRows - 1 - row;
      EXPECT_EQ(std::isnan(heights.at<double>(row, col)), line == 6 || (line == 2 && col == 5))
          << row << " " << col;
    }
  }
}

TEST(LineMap, OneLineWithTwoPointsSetsNoPitch) {
  std::vector<ScanLine> lines = evenLines();
  lines[5] = {lines[5].front(), lines[5].back()};
  const cv::Mat heights = mapOfLines(lines, {}).map.surface.heights();
  ASSERT_EQ(heights.size(), clouds::expectedMap().size());
  EXPECT_EQ(std::count_if(heights.begin<double>(), heights.end<double>(),
                          [](double height) { return std::isnan(height); }),
            clouds::kCols - 2);
}

/// As lines of a stage that stands before and after its way, with an encoder's noise [m].
std::vector<ScanLine> withStandingLines(int before, int behind, double noise) {
  std::mt19937 random(5);
  std::normal_distribution<double> shift(0.0, noise);
  const std::vector<ScanLine> moving = evenLines();
  std::vector<ScanLine> lines = moving;
  const auto still = [&](const ScanLine& at) {
    ScanLine line = at;
    const double by = shift(random);
    for (cv::Vec3d& point : line) point[1] += by;
    return line;
  };
  for (int i = 0; i < before; ++i) lines.insert(lines.begin(), still(moving.front()));
  for (int i = 0; i < behind; ++i) lines.push_back(still(moving.back()));
  return lines;
}

TEST(LineMap, NoiseOfAStageThatStandsIsNoStep) {
  for (const double noise : {1e-9, 1e-8, 4e-7}) {
    const LineMap result = mapOfLines(withStandingLines(20, 80, noise), {});
    const HeightMap& map = result.map.surface;
    EXPECT_NEAR(map.pitchY(), clouds::kPitchY, 0.1 * clouds::kPitchY) << noise;
    EXPECT_NEAR(map.heights().rows, clouds::kRows, 1) << noise;
    EXPECT_EQ(result.lost, 0u) << noise;
  }
}

TEST(LineMap, RefusesFarMoreLostLinesThanCame) {
  const std::vector<ScanLine> lines = evenLines();
  LineMapOptions options;
  options.line_pitch = clouds::kPitchY / 100.0;
  try {
    mapOfLines(lines, options);
    FAIL() << "is a map";
  } catch (const SurfaceError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("line_pitch: 3e-07 m"), std::string::npos) << text;
    EXPECT_NE(text.find("at most 10 for each of 12 lines"), std::string::npos) << text;
  }
  options.line_pitch = clouds::kPitchY / 4.0;
  EXPECT_EQ(mapOfLines(lines, options).lost, 33u);
}

TEST(LineMap, TurnsItsAxesAsACloudDoes) {
  // Of an even grid, and of lines that lie askew and are put on one.
  for (const double yaw : {0.0, 0.2}) {
    std::vector<ScanLine> lines = evenLines();
    cv::Mat cloud(clouds::kRows, clouds::kCols, CV_64FC3);
    for (int row = 0; row < cloud.rows; ++row) {
      for (int col = 0; col < cloud.cols; ++col) {
        cv::Vec3d& point = lines[static_cast<std::size_t>(row)][static_cast<std::size_t>(col)];
        point[1] += yaw * point[0];
        cloud.at<cv::Vec3d>(row, col) = point;
      }
    }
    LineMapOptions options;
    for (const bool is_up_negative : {false, true}) {
      for (const Mirror mirror : {Mirror::kAuto, Mirror::kX, Mirror::kY, Mirror::kNone}) {
        options.map.is_up_negative = is_up_negative;
        options.map.mirror = mirror;
        const cv::Mat map = mapOfLines(lines, options).map.surface.heights();
        const cv::Mat expected = mapOfPoints(cloud, options.map).surface.heights();
        ASSERT_EQ(map.size(), expected.size());
        EXPECT_TRUE(
            std::equal(map.begin<double>(), map.end<double>(), expected.begin<double>(), isSame));
      }
    }
  }
}

TEST(LineMap, RefusesWhatMakesNoMap) {
  std::vector<ScanLine> lines = evenLines();
  EXPECT_THROW(mapOfLines({}, {}), SurfaceError);
  EXPECT_THROW(mapOfLines({lines[0]}, {}), SurfaceError);
  EXPECT_THROW(mapOfLines({lines[0], lines[0]}, {}), SurfaceError);  // nothing moved
  LineMapOptions fine;
  fine.map.pitch_x = 1e-15;
  EXPECT_THROW(mapOfLines(lines, fine), std::exception);
}

}  // namespace
}  // namespace mems_stiction
