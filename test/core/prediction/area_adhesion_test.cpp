/// The adhesion of an area from its tiles is that of the whole frame; it does not depend on the
/// tiles, and says when it does not know enough of them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/area_adhesion.hpp"
#include "support/sample_frames.hpp"
#include "support/separation_cases.hpp"
#include "surface/self_affine_surface.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 512;
constexpr double kPitch = 10e-9;

HeightMap gaussian(double rms_height, int seed = 1) {
  return samples::gaussian(kSide, kSide, kPitch, kPitch, rms_height, 100e-9, seed);
}

HeightMap selfAffine(double rms_height) {
  SelfAffineSurfaceOptions options;
  options.rows = options.cols = kSide;
  options.pitch_x = options.pitch_y = kPitch;
  options.rms_height = rms_height;
  options.hurst_exponent = 0.8;
  options.rolloff_wavelength = 2e-6;
  return selfAffineSurface(options);
}

/// Polysilicon with its oxide.
Options stiff() {
  Options options;
  for (Material* const material : {&options.lower, &options.upper}) {
    material->youngs_modulus = 169e9;
    material->poisson_ratio = 0.22;
    material->hardness = 12e9;
  }
  options.interface.work_of_adhesion = 0.05;
  options.interface.hamaker_constant = 65e-21;
  options.interface.insulator_thickness = 4e-9;
  options.interface.insulator_relative_permittivity = 3.9;
  options.output.asperities = true;
  return options;
}

Options soft() {
  Options options = separation_cases::elastic(5e9);
  options.interface.work_of_adhesion = 0.05;
  return options;
}

Options changed(Options options, const std::function<void(Options&)>& change) {
  change(options);
  return options;
}

struct TileSize {
  int rows;
  int cols;
};

/// The tiles of a frame in a random order.
std::vector<cv::Rect> tilesOf(const HeightMap& surface, const TileSize& size, unsigned seed) {
  std::vector<cv::Rect> tiles;
  for (int row = 0; row < surface.rows(); row += size.rows) {
    for (int col = 0; col < surface.cols(); col += size.cols) {
      tiles.emplace_back(col, row, std::min(size.cols, surface.cols() - col),
                         std::min(size.rows, surface.rows() - row));
    }
  }
  std::shuffle(tiles.begin(), tiles.end(), std::mt19937(seed));
  return tiles;
}

AreaCells cellsOf(const HeightMap& surface, const TileSize& size, const AreaCellLimits& limits = {},
                  unsigned seed = 1) {
  AreaCells cells(surface.pitchX(), surface.pitchY(), limits);
  for (const cv::Rect& tile : tilesOf(surface, size, seed))
    cells.add(tile.y, tile.x, surface.heights()(tile));
  return cells;
}

void expectNear(double found, double expected, double relative, const char* figure) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(found)) << figure;
  } else {
    EXPECT_NEAR(found, expected, relative * std::abs(expected)) << figure;
  }
}

struct Case {
  const char* name;
  HeightMap surface;
  Options options;
  /// Far cells are summed in other classes than those of the frame; nothing else differs [-].
  double tolerance = 3e-5;

  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }
};

std::vector<Case> cases() {
  const auto pressed = [](double load) {
    return changed(stiff(), [=](Options& o) { o.load.mechanical_load = load; });
  };
  return {
      {"gaussian_3", gaussian(3e-9), stiff()},
      {"gaussian_10", gaussian(10e-9), stiff()},
      {"self_affine", selfAffine(3e-9), stiff()},
      {"pressed", gaussian(3e-9), pressed(1e-6)},
      {"plastic", gaussian(10e-9), pressed(20e-6)},
      {"eight", gaussian(3e-9),
       changed(pressed(20e-6), [](Options& o) { o.approach.connectivity = Connectivity::kEight; })},
      {"voltage", gaussian(3e-9), changed(stiff(), [](Options& o) { o.load.voltage = 10.0; })},
      {"contact_potential", gaussian(3e-9),
       changed(stiff(),
               [](Options& o) {
                 o.load.contact_potential = 1.0;
                 o.load.voltage = 2.0;
               })},
      {"water", gaussian(3e-9),
       changed(stiff(), [](Options& o) { o.capillary.relative_humidity = 0.5; }),
       5e-3},  // the frame counts cells that water fills in wider buckets, and rest is found to
               // 1/512 of the load
      {"films", gaussian(10e-9),
       changed(stiff(),
               [](Options& o) {
                 o.lower.film_thickness = o.upper.film_thickness = 2e-9;
                 o.lower.hamaker_constant = o.upper.hamaker_constant = 261e-21;
                 o.interface.retardation_length = 20e-9;
               })},
      {"water_films", gaussian(3e-9),
       changed(stiff(),
               [](Options& o) {
                 o.capillary.relative_humidity = 0.3;
                 o.capillary.water_film = 0.8e-9;
               }),
       5e-3},
      {"soft", gaussian(10e-9), soft()},
      {"soft_self_affine", selfAffine(10e-9), soft(), 2e-4},
      {"without_adhesion", gaussian(3e-9),
       changed(pressed(1e-6), [](Options& o) { o.interface.work_of_adhesion = 0.0; }), 1e-9},
      {"holes", samples::withHoles(gaussian(3e-9), 0.1, 3), pressed(1e-6)},
      {"noise", samples::whiteNoise(kSide, kSide, kPitch, kPitch, 20e-9, 4), pressed(1e-6), 3e-5}};
}

class AreaAdhesionOf : public testing::TestWithParam<Case> {};

TEST_P(AreaAdhesionOf, tilesIsThatOfTheFrame) {
  const Case& one = GetParam();
  const Prediction expected = AdhesionModel(one.options).predict(one.surface);
  ASSERT_FALSE(expected.is_conforming);
  for (const TileSize& size : {TileSize{kSide, kSide}, {100, 128}, {37, 511}}) {
    SCOPED_TRACE(testing::Message() << size.rows << " x " << size.cols);
    const AreaAdhesion found = areaAdhesion(cellsOf(one.surface, size), one.options);
    ASSERT_TRUE(found.is_enough);
    EXPECT_EQ(found.status, expected.status);
    EXPECT_EQ(found.contact_count, expected.asperity_count);
    EXPECT_EQ(found.pull_off_contact_count, expected.pull_off_contact_count);
    EXPECT_EQ(found.curve.size(), expected.curve.size());
    expectNear(found.area, expected.nominal_area, 1e-12, "area");
    expectNear(found.pull_off_force, expected.pull_off_force, one.tolerance, "pull-off force");
    expectNear(found.apparent_work_of_adhesion, expected.apparent_work_of_adhesion, one.tolerance,
               "work");
    expectNear(found.approach, expected.approach, one.tolerance, "approach");
    expectNear(found.separation_at_rest, expected.mean_gap, 3e-5, "separation");
    expectNear(found.contact_area, expected.contact_area, one.tolerance, "contact area");
    expectNear(found.contact_stiffness, expected.contact_stiffness, 100.0 * one.tolerance,
               "stiffness");
    expectNear(found.median_composite_radius, expected.median_composite_radius, one.tolerance,
               "radius");
    for (double Exponents::*exponent : {&Exponents::adhesion, &Exponents::modulus,
                                        &Exponents::hamaker, &Exponents::contact_potential}) {
      expectNear(found.pull_off_exponents.*exponent, expected.pull_off_exponents.*exponent, 5e-3,
                 "force's exponent");
      expectNear(found.work_exponents.*exponent, expected.work_exponents.*exponent, 5e-3,
                 "work's exponent");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, AreaAdhesionOf, testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });

/// Every figure, to the bit.
std::vector<double> figuresOf(const AreaAdhesion& found) {
  std::vector<double> figures = {found.area,
                                 found.pull_off_force,
                                 found.apparent_work_of_adhesion,
                                 found.approach,
                                 found.separation_at_rest,
                                 found.contact_area,
                                 found.contact_stiffness,
                                 found.median_composite_radius,
                                 found.pull_off_exponents.hamaker,
                                 found.work_exponents.modulus,
                                 static_cast<double>(found.contact_count),
                                 static_cast<double>(found.pull_off_contact_count)};
  for (const SeparationCurvePoint& point : found.curve) figures.push_back(point.force);
  return figures;
}

class AreaOfTiles : public testing::Test {
 protected:
  const HeightMap surface_ = gaussian(5e-9);
  const AreaAdhesion whole_ = areaAdhesion(cellsOf(surface_, {kSide, kSide}), stiff());
};

TEST_F(AreaOfTiles, hasTheSameBitsWhateverTheTiles) {
  for (const TileSize& size : {TileSize{1, kSide}, {kSide, 1}, {64, 64}, {100, 7}}) {
    for (const unsigned seed : {1U, 2U}) {
      EXPECT_EQ(figuresOf(areaAdhesion(cellsOf(surface_, size, {}, seed), stiff())),
                figuresOf(whole_));
    }
  }
}

TEST_F(AreaOfTiles, hasTheSameBitsWhenPartsAreAdded) {
  const std::vector<cv::Rect> tiles = tilesOf(surface_, {64, 100}, 3);
  for (const std::int64_t most_cells : {std::int64_t{1} << 22U, std::int64_t{20000}}) {
    AreaCellLimits limits;
    limits.most_cells = most_cells;
    const std::string expected = cellsOf(surface_, {kSide, kSide}, limits).toBytes();
    AreaCells sum(kPitch, kPitch, limits);
    AreaCells backwards(kPitch, kPitch, limits);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const auto partOf = [&](const cv::Rect& tile) {
        AreaCells part(kPitch, kPitch, limits);
        part.add(tile.y, tile.x, surface_.heights()(tile));
        return AreaCells::fromBytes(part.toBytes());
      };
      sum.add(partOf(tiles[i]));
      backwards.add(partOf(tiles[tiles.size() - 1 - i]));
    }
    EXPECT_EQ(sum.toBytes(), expected);
    EXPECT_EQ(backwards.toBytes(), expected);
    EXPECT_EQ(figuresOf(areaAdhesion(AreaCells::fromBytes(expected), stiff())), figuresOf(whole_));
  }
}

TEST_F(AreaOfTiles, needsAFewCellsAlone) {
  AreaCellLimits few;
  few.most_cells = 10000;
  const AreaCells cells = cellsOf(surface_, {64, 64}, few);
  EXPECT_LE(cells.cellCount(), 10000);
  EXPECT_GT(cells.cellCount(), 9000);
  // 16 bytes a cell, half as many more and a row while they come in, and the histogram
  EXPECT_LT(cells.memory(), 16 * (10000 * 3 / 2 + (1 << 14) + kSide) + 8 * (1 << 17));
  EXPECT_EQ(figuresOf(areaAdhesion(cells, stiff())), figuresOf(whole_));
}

TEST_F(AreaOfTiles, saysThatItNeedsDeeperCells) {
  AreaCellLimits limits;
  limits.depth = 0.05e-9;
  AreaAdhesion found = areaAdhesion(cellsOf(surface_, {64, 64}, limits), stiff());
  EXPECT_FALSE(found.is_enough);
  EXPECT_TRUE(std::isnan(found.pull_off_force));
  for (int attempts = 0; !found.is_enough && attempts < 10; ++attempts) {
    limits.depth *= 2.0;
    found = areaAdhesion(cellsOf(surface_, {64, 64}, limits), stiff());
  }
  ASSERT_TRUE(found.is_enough);
  EXPECT_NEAR(found.pull_off_force, whole_.pull_off_force, 1e-4 * whole_.pull_off_force);
  EXPECT_EQ(found.contact_count, whole_.contact_count);
}

TEST_F(AreaOfTiles, saysWhenTooMuchIsInReach) {
  AreaCellLimits limits;
  limits.most_cells = 100;
  EXPECT_FALSE(areaAdhesion(cellsOf(gaussian(2e-9), {64, 64}, limits), soft()).is_enough);
  // a plane: no level has few cells above it
  const HeightMap plane(cv::Mat1d(kSide, kSide, 3e-9), kPitch, kPitch);
  const AreaAdhesion flat = areaAdhesion(cellsOf(plane, {64, 64}, limits), stiff());
  EXPECT_FALSE(flat.is_enough);
  EXPECT_TRUE(std::isnan(flat.pull_off_force));
}

TEST_F(AreaOfTiles, mayBeBonded) {
  // pressed until half of it touches, as far as the cells are held
  const Options options = changed(soft(), [](Options& o) { o.load.mechanical_load = 1.0; });
  const HeightMap surface = gaussian(2e-9);
  const Prediction expected = AdhesionModel(options).predict(surface);
  ASSERT_EQ(expected.status, Status::kBonded);
  const AreaAdhesion found = areaAdhesion(cellsOf(surface, {64, 64}), options);
  EXPECT_EQ(found.status, Status::kBonded);
  EXPECT_EQ(found.is_bonded_by_load, expected.is_bonded_by_load);
  EXPECT_NEAR(found.pull_off_force, expected.pull_off_force, 1e-4 * expected.pull_off_force);
}

TEST_F(AreaOfTiles, ofSeparatePiecesAtOneHeightIsThatOfPiecesSideBySide) {
  // the same two pieces, apart by invalid columns in a frame
  const HeightMap other = gaussian(5e-9, 2);
  cv::Mat1d frame(kSide, 2 * kSide + 1, std::numeric_limits<double>::quiet_NaN());
  surface_.asDouble().heights().copyTo(frame.colRange(0, kSide));
  other.asDouble().heights().copyTo(frame.colRange(kSide + 1, 2 * kSide + 1));
  const Prediction expected = AdhesionModel(stiff()).predict(HeightMap(frame, kPitch, kPitch));
  AreaCells cells(kPitch, kPitch);
  cells.add(1000, 0, other.heights());
  cells.add(0, 0, surface_.heights());
  const AreaAdhesion found = areaAdhesion(cells, stiff());
  expectNear(found.pull_off_force, expected.pull_off_force, 1e-5, "pull-off force");
  expectNear(found.apparent_work_of_adhesion, expected.apparent_work_of_adhesion, 1e-5, "work");
  EXPECT_EQ(found.contact_count, expected.asperity_count);
  EXPECT_EQ(found.pull_off_contact_count, expected.pull_off_contact_count);
}

TEST_F(AreaOfTiles, refusesWhatItCannotAnswer) {
  const AreaCells cells = cellsOf(surface_, {64, 64});
  EXPECT_THROW(areaAdhesion(cells, changed(stiff(), [](Options& o) { o.formulation = "paper"; })),
               OptionsError);
  EXPECT_THROW(areaAdhesion(cells, changed(stiff(), [](Options& o) { o.load.pressure = 1e5; })),
               OptionsError);
  EXPECT_THROW(areaAdhesion(AreaCells(kPitch, kPitch), stiff()), SurfaceError);
}

}  // namespace
}  // namespace mems_stiction
