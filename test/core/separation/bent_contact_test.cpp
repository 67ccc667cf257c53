/// Bodies that bend under the long waves of their relief: which share of a wave is left, what that stores, and what the curve makes
/// of it between a block and a film.

#include "separation/bent_contact.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/separation_cases.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 4e-9;
constexpr double kModulus = 40e9;
constexpr int kSide = 128;
constexpr double kLength = kSide * kPitch;

/// Waves along x, whole ones in the frame, and along y.
cv::Mat1d waves(int along_x, int along_y, double amplitude, int rows = kSide, int cols = kSide) {
  cv::Mat1d heights(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      heights(row, col) = amplitude * std::cos(2.0 * kPi * (1.0 * along_x * col / cols + 1.0 * along_y * row / rows));
    }
  }
  return heights;
}

/// Many waves, each with a height that falls with its number.
cv::Mat1d roughness(double rms, int side = kSide) {
  cv::Mat1d heights(side, side, 0.0);
  cv::RNG random(5);
  for (int x = -16; x <= 16; ++x) {
    for (int y = 0; y <= 16; ++y) {
      const double number = std::hypot(x, y);
      if (number == 0.0 || number > 16.0) continue;
      const double height = random.gaussian(1.0) * std::pow(std::max(number, 2.0), -1.7);
      const double phase = random.uniform(0.0, 2.0 * kPi);
      for (int row = 0; row < side; ++row) {
        for (int col = 0; col < side; ++col) {
          heights(row, col) += height * std::cos(2.0 * kPi * (x * col + y * row) / side + phase);
        }
      }
    }
  }
  return heights * (rms / (cv::norm(heights) / side));
}

Options thin(double thickness, double load = 0.0) {
  Options options = separation_cases::elastic(kModulus, load);
  options.lower.hardness = options.upper.hardness = 1e15;
  options.lower.thickness = thickness;
  return options;
}

double rmsOf(const GapField& gap) { return gap.rmsGap(); }

Prediction predict(const cv::Mat1d& heights, const Options& options) {
  return AdhesionModel(options).predict(HeightMap(heights, kPitch, kPitch));
}

TEST(PlateBending, aWaveKeepsItsShareAndStoresTheRest) {
  const double thickness = kLength / 12.0;
  const Options options = thin(thickness);
  const WaveStiffness stiffness(options.lower, options.upper);
  const int cases[][2] = {{1, 0}, {0, 2}, {3, 4}};
  for (const auto& [along_x, along_y] : cases) {
    GapField field;
    const cv::Mat1d heights = waves(along_x, along_y, 2e-9);
    field.compute(HeightMap(heights, kPitch, kPitch));
    PlateBending bending;
    bending.start(field, stiffness);
    const double q = 2.0 * kPi * std::hypot(along_x, along_y) / kLength;
    const double extra = 1.0 / stiffness.at(q) - 2.0 / (kModulus * q);
    // closed: both parts together cost K/2 of the square
    const double ratio = stiffness.at(q) / (0.5 * kModulus * q);
    EXPECT_NEAR(rmsOf(bending.closed()), ratio * field.rmsGap(), 0.01 * field.rmsGap());
    const double rest = (1.0 - ratio) * field.rmsGap();
    EXPECT_NEAR(bending.energy(), 0.5 * rest * rest / extra, 0.02 * rest * rest / extra);
  }
}

TEST(PlateBending, aFilmOnSomethingStiffKeepsItsWaves) {
  Options options = thin(kLength / 20.0);
  options.lower.backing = Backing::kBonded;
  GapField field;
  field.compute(HeightMap(waves(1, 1, 2e-9), kPitch, kPitch));
  PlateBending bending;
  bending.start(field, WaveStiffness(options.lower, options.upper));
  EXPECT_NEAR(rmsOf(bending.closed()), field.rmsGap(), 1e-6 * field.rmsGap());
}

TEST(PlateBending, pixelsThatAreMissingOrNotSquareMakeNoWaves) {
  const Options options = thin(kLength / 12.0);
  const WaveStiffness stiffness(options.lower, options.upper);
  GapField field;
  cv::Mat1d heights = waves(2, 1, 2e-9, kSide, kSide / 2);
  heights(cv::Rect(20, 30, 5, 7)) = std::numeric_limits<double>::quiet_NaN();
  field.compute(HeightMap(heights, 2.0 * kPitch, kPitch));
  PlateBending bending;
  bending.start(field, stiffness);
  const double q = 2.0 * kPi * std::hypot(2.0, 1.0) / kLength;
  const double ratio = stiffness.at(q) / (0.5 * kModulus * q);
  EXPECT_NEAR(rmsOf(bending.closed()), ratio * field.rmsGap(), 0.03 * field.rmsGap());
  EXPECT_EQ(bending.closed().validCount(), field.validCount());
}

TEST(PlateBending, theTiltOfAFrameIsNoWave) {
  const Options options = thin(kLength / 40.0);
  cv::Mat1d heights(kSide, kSide);
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) heights(row, col) = 1e-10 * col - 2e-10 * row;
  }
  GapField field;
  field.compute(HeightMap(heights, kPitch, kPitch));
  PlateBending bending;
  bending.start(field, WaveStiffness(options.lower, options.upper));
  EXPECT_NEAR(rmsOf(bending.closed()), field.rmsGap(), 1e-6 * field.rmsGap());
}

/// A low wave far from contact: attraction that falls with the gap by k = -dt/dg draws its summits nearer, to 1/(1 - k C) of its height.
TEST(PressedPlate, attractionDrawsOutAWave) {
  const Options options = thin(kLength / 12.0);
  const ContactTraction law(options.interface);
  const WaveStiffness stiffness(options.lower, options.upper);
  const double q = 2.0 * kPi / kLength;
  const double extra = 1.0 / stiffness.at(q) - 2.0 / (kModulus * q);
  GapField field;
  field.compute(HeightMap(waves(1, 0, 0.6 * law.range()), kPitch, kPitch));
  PlateBending bending;
  bending.start(field, stiffness);
  PressedPlate plate;
  for (const double share : {0.1, 0.25}) {
    plate.start(bending, field, options);
    // the height over the mean at which k C is the share: outside of the law's largest pull
    double near = law.range();
    double far = 100.0 * law.range();
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (near + far);
      (-law.slope(middle) * extra > share ? near : far) = middle;
    }
    plate.settle(near, {near, 0.0});
    const double found = bending.bentBy(field, plate.blocks()).rmsGap() / field.rmsGap();
    EXPECT_NEAR(found, 1.0 / (1.0 - share), 0.05) << share;  // bodies that move less than 0.02 z0 have settled
    const double drawn = (found - 1.0) * field.rmsGap();
    EXPECT_NEAR(plate.energy(), 0.5 * drawn * drawn / extra, 0.02 * drawn * drawn / extra);
  }
}

TEST(BentContact, thickBodiesHaveTheBitsOfBodiesWithoutAThickness) {
  const cv::Mat1d heights = roughness(2e-9);
  const Prediction stated = predict(heights, thin(0.0));
  Options other = thin(0.0);
  other.lower.backing = Backing::kBonded;
  EXPECT_TRUE(separation_cases::sameFigures(stated, predict(heights, other)));
}

TEST(BentContact, aBlockIsAsGoodAsThick) {
  const cv::Mat1d heights = roughness(2e-9);
  const Prediction thick = predict(heights, thin(0.0));
  const Prediction block = predict(heights, thin(5.0 * kLength));
  EXPECT_NEAR(block.pull_off_force, thick.pull_off_force, 1e-6 * thick.pull_off_force);
  EXPECT_NEAR(block.apparent_work_of_adhesion, thick.apparent_work_of_adhesion, 1e-6 * thick.apparent_work_of_adhesion);
  EXPECT_NEAR(block.flattening_energy, thick.flattening_energy, 1e-6 * thick.flattening_energy);
}

TEST(BentContact, thinnerBodiesLieCloserAndNeedLessToLieFlat) {
  const cv::Mat1d heights = roughness(2e-9);
  double last_energy = predict(heights, thin(0.0)).flattening_energy;
  double last_gap = predict(heights, thin(0.0)).mean_gap;
  for (const double thickness : {kLength / 8.0, kLength / 24.0}) {
    const Prediction prediction = predict(heights, thin(thickness));
    EXPECT_LT(prediction.flattening_energy, last_energy * (1.0 + 1e-9)) << thickness;
    EXPECT_LT(prediction.mean_gap, last_gap * 1.02) << thickness;
    EXPECT_LE(prediction.apparent_work_of_adhesion, separation_cases::kWork);
    EXPECT_GT(prediction.pull_off_force, 0.0);
    last_energy = prediction.flattening_energy;
    last_gap = prediction.mean_gap;
  }
}

/// Nothing holds them on the way out, which has no strongest place then.
TEST(BentContact, bodiesWithoutAdhesionPart) {
  Options options = thin(kLength / 12.0, 1e-7);
  options.interface.work_of_adhesion = 0.0;
  const Prediction found = predict(roughness(2e-9), options);
  EXPECT_EQ(found.pull_off_force, 0.0);
  EXPECT_EQ(found.apparent_work_of_adhesion, 0.0);
  EXPECT_GT(found.contact_area, 0.0);
}

TEST(BentContact, whatABlockHoldsOffAFilmLiesFlatOn) {
  const cv::Mat1d heights = roughness(1.1e-9);
  const Prediction block = predict(heights, thin(0.0));
  const Prediction film = predict(heights, thin(kLength / 50.0));
  EXPECT_FALSE(block.is_conforming);
  EXPECT_TRUE(film.is_conforming);
  EXPECT_GT(film.pull_off_force, 3.0 * block.pull_off_force);
}

/// Plates of the half-space solver, which hold up to six times what a thick body does on the same surface.
TEST(BentContact, holdsWhatAPlateOfTheHalfSpaceHolds) {
  const cv::Mat1d heights = roughness(1.2e-9, 64);
  const HeightMap surface(heights, kPitch, kPitch);
  for (const double parts : {4.0, 10.0, 20.0}) {
    const Options options = thin(64 * kPitch / parts);
    const double plate = separation_cases::halfSpaceOf(surface, options).pull_off_force;
    const double found = AdhesionModel(options).predict(surface).pull_off_force;
    EXPECT_NEAR(std::log(found / plate), 0.0, std::log(1.3)) << parts;
  }
}

}  // namespace
}  // namespace mems_stiction
