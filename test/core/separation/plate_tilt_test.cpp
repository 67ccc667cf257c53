/// A plate that may tilt: on which three places it lies, and where it comes to rest on contacts
/// that give way. Exhaustive searches over tilts stand beside it: every triple of places, and the
/// energy of the plate at rest at every tilt of a grid.

#include "separation/plate_tilt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "separation/support_plane.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 5e-9;

cv::Mat1d roughHeights(int rows, int cols, unsigned seed, double rms, double blur = 1.5) {
  cv::Mat1d heights(rows, cols);
  cv::RNG random(seed);
  random.fill(heights, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(heights, heights, {0, 0}, blur, blur, cv::BORDER_REFLECT);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(heights, mean, deviation);
  return (heights - mean[0]) * (rms / deviation[0]);
}

cv::Mat1d tilted(const cv::Mat1d& heights, double slope_x, double slope_y, double pitch = kPitch) {
  cv::Mat1d lowered = heights.clone();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      lowered(row, col) -= slope_x * (col - 0.5 * (heights.cols - 1)) * pitch;
      lowered(row, col) -= slope_y * (row - 0.5 * (heights.rows - 1)) * pitch;
    }
  }
  return lowered;
}

double highest(const cv::Mat1d& heights) {
  double top = 0.0;
  cv::minMaxLoc(heights, nullptr, &top);
  return top;
}

GapField fieldOf(const cv::Mat1d& heights, double pitch = kPitch) {
  GapField field;
  field.compute(HeightMap(heights, pitch, pitch));
  return field;
}

Options stiffOptions(double load) {
  Options options;
  options.load.mechanical_load = load;
  options.interface.work_of_adhesion = 0.02;
  return options;
}

/// Of plate and load at rest at a tilt, over the relief's own level [J].
double energyAtRest(const cv::Mat1d& heights, double slope_x, double slope_y,
                    const Options& options) {
  const cv::Mat1d surface = tilted(heights, slope_x, slope_y);
  const GapField field = fieldOf(surface);
  ContactCurve curve;
  curve.comeToRest(field, options);
  const std::vector<SeparationState>& states = curve.loading().states;
  double energy = options.load.mechanical_load * (highest(surface) - curve.rest().approach);
  energy -= curve.frame().energy(states.front().approach);
  for (std::size_t i = 1; i < states.size(); ++i) {
    energy -= 0.5 * (states[i - 1].force() + states[i].force()) *
              (states[i].approach - states[i - 1].approach);
  }
  return energy;
}

/// The tilt of least energy, on grids that become finer about it.
PlaneSlopes leastEnergy(const cv::Mat1d& heights, const Options& options) {
  constexpr int kHalf = 10;
  double width =
      2.0 * (highest(heights) - highest(-heights) + 4.0 * 1e-9) / (heights.cols * kPitch);
  PlaneSlopes best;
  double least = std::numeric_limits<double>::infinity();
  for (int level = 0; level < 7; ++level, width *= 0.3) {
    const PlaneSlopes middle = best;
    for (int i = -kHalf; i <= kHalf; ++i) {
      for (int j = -kHalf; j <= kHalf; ++j) {
        const PlaneSlopes slopes{middle.x + i * width / kHalf, middle.y + j * width / kHalf};
        const double energy = energyAtRest(heights, slopes.x, slopes.y, options);
        if (energy < least) {
          least = energy;
          best = slopes;
        }
      }
    }
  }
  return best;
}

TEST(SupportPlane, itIsTheLowestOfAllPlanesOverThreePlacesAroundTheMiddle) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const cv::Mat1d heights = roughHeights(7, 8, seed, 3e-9, 0.6);
    // the lowest plane over the middle that no place sticks out of: over triples of places, those
    // that carry all others
    double least = std::numeric_limits<double>::infinity();
    const auto placeOf = [&](int cell) {
      return cv::Vec3d((cell % 8 - 3.5) * kPitch, (cell / 8 - 3.0) * kPitch,
                       heights(cell / 8, cell % 8));
    };
    for (int a = 0; a < 56; ++a) {
      for (int b = a + 1; b < 56; ++b) {
        for (int c = b + 1; c < 56; ++c) {
          const cv::Vec3d normal = (placeOf(b) - placeOf(a)).cross(placeOf(c) - placeOf(a));
          if (std::abs(normal[2]) < 1e-9 * kPitch * kPitch) continue;
          const auto height = [&](double x, double y) {
            return placeOf(a)[2] -
                   (normal[0] * (x - placeOf(a)[0]) + normal[1] * (y - placeOf(a)[1])) / normal[2];
          };
          bool carries_all = height(0.0, 0.0) < least;
          for (int d = 0; carries_all && d < 56; ++d) {
            carries_all = placeOf(d)[2] <= height(placeOf(d)[0], placeOf(d)[1]) + 1e-20;
          }
          if (carries_all) least = height(0.0, 0.0);
        }
      }
    }
    const std::optional<PlaneSlopes> slopes = supportPlane(fieldOf(heights));
    ASSERT_TRUE(slopes);
    EXPECT_NEAR(highest(tilted(heights, slopes->x, slopes->y)), least, 1e-20) << seed;
  }
}

TEST(SupportPlane, aPlateHasNoHoldWhereItsMiddleIsNotSurrounded) {
  cv::Mat1d heights = roughHeights(12, 12, 3, 1e-9);
  heights.colRange(5, 12) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(supportPlane(fieldOf(heights)));
  Options options = stiffOptions(1e-8);
  options.guidance = Guidance::kFree;
  AdhesionModel model(options);
  EXPECT_THROW(model.predict(HeightMap(heights, kPitch, kPitch)), SurfaceError);
}

TEST(PlateTilt, itComesToRestWhereAnExhaustiveSearchOverTiltsFindsTheLeastEnergy) {
  constexpr double kWidth = 20 * kPitch;
  int same = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const cv::Mat1d heights = roughHeights(44, 40, seed, 2e-9, 3.5);
    Options options = stiffOptions(seed % 2 == 0 ? 2e-7 : 5e-8);
    const PlaneSlopes least = leastEnergy(heights, options);
    PlateTilt tilt;
    tilt.settle(fieldOf(heights), options);
    const double energy = energyAtRest(heights, least.x, least.y, options);
    EXPECT_LT(energyAtRest(heights, tilt.slopes().x, tilt.slopes().y, options), 1.01 * energy)
        << seed;
    const double apart = std::hypot(tilt.slopes().x - least.x, tilt.slopes().y - least.y) * kWidth;
    if (apart > 1e-9)
      continue;  // it rests on other three, as well: adhesion leaves a plate more than one place
    ++same;
    EXPECT_LT(apart, 0.05e-9) << seed;

    AdhesionModel guided(options);
    const Prediction at_least =
        guided.predict(HeightMap(tilted(heights, least.x, least.y), kPitch, kPitch));
    options.guidance = Guidance::kFree;
    AdhesionModel model(options);
    const Prediction settled = model.predict(HeightMap(heights, kPitch, kPitch));
    EXPECT_NEAR(settled.pull_off_force, at_least.pull_off_force, 0.03 * at_least.pull_off_force)
        << seed;
    EXPECT_NEAR(settled.approach, at_least.approach, 0.03 * at_least.approach + 0.02e-9) << seed;
  }
  EXPECT_GE(same, 4);
}

/// Three equal spheres: each carries the share of the load that the lever rule gives it.
TEST(PlateTilt, threeSpheresShareTheLoadByTheLever) {
  constexpr int kSide = 121;
  constexpr double kRadius = 2e-6;
  const cv::Point centres[] = {{20, 22}, {101, 35}, {48, 104}};
  cv::Mat1d heights(kSide, kSide, -60e-9);
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      for (const cv::Point& centre : centres) {
        const double distance = std::hypot(row - centre.y, col - centre.x) * kPitch;
        heights(row, col) =
            std::max(heights(row, col), centre.x * 0.05e-9 - distance * distance / (2.0 * kRadius));
      }
    }
  }
  Options options = stiffOptions(3e-6);
  options.interface.work_of_adhesion = 0.0;
  options.guidance = Guidance::kFree;
  AdhesionModel model(options);
  const Prediction settled = model.predict(HeightMap(heights, kPitch, kPitch));
  ASSERT_EQ(settled.asperities.size(), 3U);
  double load = 0.0;
  double moment_x = 0.0;
  double moment_y = 0.0;
  for (const Asperity& asperity : settled.asperities) {
    load += asperity.load;
    moment_x += asperity.load * (asperity.x - 60 * kPitch);
    moment_y += asperity.load * (asperity.y - 60 * kPitch);
  }
  EXPECT_NEAR(load, 3e-6, 0.01 * 3e-6);
  EXPECT_NEAR(moment_x, 0.0, 0.01 * load * 60 * kPitch);
  EXPECT_NEAR(moment_y, 0.0, 0.01 * load * 60 * kPitch);
}

TEST(PlateTilt, loadsTipItNoFurtherThanTheReliefIsHigh) {
  const HeightMap surface = samples::gaussian(64, 64, 5e-9, 5e-9, 1e-9, 40e-9, 1);
  Options options;
  options.lower.youngs_modulus = options.upper.youngs_modulus = 5e9;
  options.lower.hardness = options.upper.hardness = 3e8;
  options.interface.insulator_thickness = 2e-9;
  options.load.voltage = 6.0;  // 3 GV/m, whose moments grow with each tilt
  const Prediction guided = AdhesionModel(options).predict(surface);
  options.guidance = Guidance::kFree;
  const Prediction free = AdhesionModel(options).predict(surface);
  EXPECT_LT(free.approach, 10.0 * guided.approach);
  EXPECT_GT(free.pull_off_force, 0.5 * guided.pull_off_force);
  EXPECT_NE(free.model.doubt, nullptr);
}

TEST(PlateTilt, aTiltOfTheScanChangesNothing) {
  const cv::Mat1d heights = roughHeights(64, 64, 9, 3e-9, 2.0);
  Options options = stiffOptions(2e-7);
  options.guidance = Guidance::kFree;
  AdhesionModel model(options);
  const Prediction as_scanned = model.predict(HeightMap(heights, kPitch, kPitch));
  const Prediction tipped = model.predict(HeightMap(tilted(heights, 0.01, -0.02), kPitch, kPitch));
  EXPECT_NEAR(tipped.pull_off_force, as_scanned.pull_off_force, 1e-3 * as_scanned.pull_off_force);
  EXPECT_NEAR(tipped.approach, as_scanned.approach, 1e-3 * as_scanned.approach);
}

}  // namespace
}  // namespace mems_stiction
