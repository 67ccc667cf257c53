/// What the model promises beside its physics: inputs it takes, errors, statuses, optional outputs.

#include "mems_stiction/prediction/adhesion_model.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

HeightMap rough(int seed = 1) {
  return samples::gaussian(80, 75, 10 * kNm, 10 * kNm, 2 * kNm, 60 * kNm, seed);
}

void expectAllFinite(const Prediction& prediction) {
  for (const double value :
       {prediction.van_der_waals_force, prediction.electrostatic_force, prediction.normal_load,
        prediction.pull_off_force, prediction.pull_off_force_transition, prediction.contact_area,
        prediction.contact_area_jkr, prediction.contact_fraction, prediction.approach,
        prediction.mean_gap, prediction.total_energy, prediction.plastic_work,
        prediction.bonding_energy, prediction.adhesion_parameter, prediction.max_tilt,
        prediction.median_tabor_parameter}) {
    EXPECT_TRUE(std::isfinite(value));
  }
  EXPECT_EQ(prediction.asperities.size(), static_cast<std::size_t>(prediction.asperity_count));
}

TEST(AdhesionModel, bondsAPlane) {
  for (const double load : {0.0, 1e-6}) {
    Options options = paperOptions();
    options.load.mechanical_load = load;
    const Prediction prediction =
        AdhesionModel(options).predict(analytic::flat(30, 40, 10 * kNm, 8 * kNm, 3e-6));
    EXPECT_EQ(prediction.status, Status::kBonded);
    EXPECT_EQ(prediction.contact_fraction, 1.0);
    EXPECT_EQ(prediction.asperity_count, 1);
    EXPECT_EQ(prediction.mean_gap, 0.0);
    EXPECT_EQ(prediction.van_der_waals_force, 0.0);  // no cell is apart
    EXPECT_EQ(prediction.bonding_regime, BondingRegime::kBonding);
    expectAllFinite(prediction);
  }
}

TEST(AdhesionModel, takesFramesOfAnyShape) {
  for (const samples::Frame& frame : samples::allFrames()) {
    SCOPED_TRACE(frame.name);
    AdhesionModel model{paperOptions()};
    const Prediction prediction = model.predict(frame.lower);
    expectAllFinite(prediction);
    EXPECT_GT(prediction.asperity_count, 0);
    EXPECT_GT(prediction.pull_off_force, 0.0);
    EXPECT_EQ(prediction.deformed_lower.size(), frame.lower.heights().size());
    EXPECT_EQ(prediction.contact_map.size(), frame.lower.heights().size());
  }
}

TEST(AdhesionModel, predictsTheSameFromSinglePrecision) {
  const HeightMap surface = rough();
  Options options = paperOptions();
  options.load.mechanical_load = 1e-6;
  AdhesionModel model(options);
  const Prediction wide = model.predict(surface);
  const Prediction narrow = model.predict(analytic::asSingle(surface));
  EXPECT_EQ(narrow.status, wide.status);
  // float32 keeps 2 nm to 1e-16 m: hardly a cell changes its place in the order
  EXPECT_NEAR(narrow.contact_area, wide.contact_area, 0.02 * wide.contact_area);
  EXPECT_NEAR(narrow.pull_off_force, wide.pull_off_force, 0.02 * wide.pull_off_force);
  EXPECT_EQ(narrow.deformed_lower.type(), CV_64FC1);
  const Prediction on_rough =
      model.predict({analytic::asSingle(surface), analytic::asSingle(rough(2))});
  EXPECT_NEAR(on_rough.contact_area, model.predict({surface, rough(2)}).contact_area,
              0.02 * on_rough.contact_area);
}

TEST(AdhesionModel, takesAFlatCounterSurfaceAsNone) {
  AdhesionModel model{paperOptions()};
  const Prediction none = model.predict(rough());
  const Prediction flat =
      model.predict({rough(), analytic::flat(80, 75, 10 * kNm, 10 * kNm, 1 * kNm)});
  EXPECT_EQ(flat.contact_area, none.contact_area);
  EXPECT_EQ(flat.asperity_count, none.asperity_count);
  EXPECT_NEAR(flat.pull_off_force, none.pull_off_force, 1e-9 * none.pull_off_force);
}

TEST(AdhesionModel, mirrorsAndTurnsWithItsSurface) {
  for (const int seed : {1, 2, 3}) {
    for (const double load : {0.0, 1e-6, 1e-5}) {
      const HeightMap surface =
          samples::gaussian(150, 161, 10 * kNm, 8 * kNm, 2 * kNm, 60 * kNm, seed);
      Options options = paperOptions();
      options.load.mechanical_load = load;
      AdhesionModel model(options);
      const Prediction upright = model.predict(surface);
      const auto expectSame = [&](const Prediction& prediction) {
        EXPECT_EQ(prediction.contact_area, upright.contact_area);
        EXPECT_EQ(prediction.asperity_count, upright.asperity_count);
        EXPECT_NEAR(prediction.pull_off_force, upright.pull_off_force,
                    1e-9 * upright.pull_off_force);  // round-off
      };
      for (const int axis : {0, 1, -1}) {
        cv::Mat flipped;
        cv::flip(surface.heights(), flipped, axis);
        SCOPED_TRACE("flip " + std::to_string(axis));
        expectSame(model.predict(HeightMap(flipped, surface.pitchX(), surface.pitchY())));
      }
      cv::Mat turned;
      cv::transpose(surface.heights(), turned);
      expectSame(model.predict(HeightMap(turned, surface.pitchY(), surface.pitchX())));
    }
  }
}

TEST(AdhesionModel, scalesPatchesWithThePitchOfEachAxis) {
  // the same sphere, sampled twice as densely along one axis
  Options options = paperOptions();
  options.interface.hamaker_constant = 0.0;
  const Prediction square =
      AdhesionModel(options).predict(analytic::paraboloid(101, 101, kNm, kNm, 2e-6));
  const Prediction dense =
      AdhesionModel(options).predict(analytic::paraboloid(202, 101, kNm, 0.5 * kNm, 2e-6));
  EXPECT_NEAR(dense.contact_area, square.contact_area, 0.03 * square.contact_area);
  EXPECT_NEAR(dense.pull_off_force, square.pull_off_force, 0.03 * square.pull_off_force);
}

TEST(AdhesionModel, placesAsperitiesOnTheSurface) {
  cv::Mat1d heights(20, 30, 0.0);
  heights(4, 23) = 6 * kNm;
  heights(0, 0) = kNan;
  Options options = paperOptions();
  options.load.mechanical_load = 1e-9;
  options.deformation =
      Deformation::kElastic;  // so steep a one would flow, and the surface never come to rest
  const Prediction prediction =
      AdhesionModel(options).predict(HeightMap(heights, 10 * kNm, 7 * kNm));
  ASSERT_EQ(prediction.asperity_count, 1);
  EXPECT_DOUBLE_EQ(prediction.asperities[0].x, 23 * 10 * kNm);
  EXPECT_DOUBLE_EQ(prediction.asperities[0].y, 4 * 7 * kNm);
  EXPECT_DOUBLE_EQ(prediction.asperities[0].z, 6 * kNm);
  EXPECT_NEAR(prediction.asperities[0].area, 70 * kNm * kNm, 1e-28);
  EXPECT_NE(prediction.contact_map.at<std::uint8_t>(4, 23), 0);
  EXPECT_EQ(cv::countNonZero(prediction.contact_map), 1);
  EXPECT_NEAR(prediction.invalid_fraction, 1.0 / 600, 1e-12);
  EXPECT_NEAR(prediction.nominal_area, 599 * 70 * kNm * kNm, 1e-24);
  EXPECT_NEAR(prediction.mean_gap, 6 * kNm - prediction.approach, 1e-18);
}

TEST(AdhesionModel, pullsWithTheSquareOfTheVoltage) {
  const HeightMap surface = analytic::flatWithBump(40, 40, 10 * kNm, 10 * kNm, 20 * kNm, 5);
  Options options = paperOptions();
  options.interface.insulator_thickness = 200 * kNm;
  options.load.voltage = 1.0;
  const Prediction one = AdhesionModel(options).predict(surface);
  options.load.voltage = -2.0;
  const Prediction two = AdhesionModel(options).predict(surface);
  EXPECT_GT(one.electrostatic_force, 0.0);
  EXPECT_NEAR(two.electrostatic_force, 4 * one.electrostatic_force, 1e-6 * two.electrostatic_force);
  EXPECT_DOUBLE_EQ(two.normal_load, two.electrostatic_force + two.van_der_waals_force);
}

TEST(AdhesionModel, keepsTheEnergyCurveOnRequest) {
  Options options = paperOptions();
  options.output.energy_curve = true;
  options.load.mechanical_load = 1e-6;
  const Prediction prediction = AdhesionModel(options).predict(rough());
  ASSERT_EQ(prediction.energy_curve.size(), static_cast<std::size_t>(prediction.steps));
  for (std::size_t k = 1; k < prediction.energy_curve.size(); ++k) {
    EXPECT_GT(prediction.energy_curve[k].approach, prediction.energy_curve[k - 1].approach);
    EXPECT_GE(prediction.energy_curve[k].contact_fraction,
              prediction.energy_curve[k - 1].contact_fraction);
  }
  const EnergyPoint& last = prediction.energy_curve.back();
  EXPECT_EQ(last.approach, prediction.approach);
  EXPECT_EQ(last.contact_fraction, prediction.contact_fraction);
  EXPECT_EQ(last.total_energy, prediction.total_energy);
  EXPECT_EQ(last.normal_load, prediction.normal_load);
  EXPECT_LE(last.generalized_force, 0.0);
  EXPECT_GE(last.carried_load, last.normal_load);
}

TEST(AdhesionModel, computesWhatIsAskedForOnly) {
  Options options = paperOptions();
  options.output = {false, false, false, false, false};
  const Prediction bare = AdhesionModel(options).predict(rough());
  const Prediction full = AdhesionModel(paperOptions()).predict(rough());
  EXPECT_TRUE(bare.contact_map.empty());
  EXPECT_TRUE(bare.deformed_lower.empty());
  EXPECT_TRUE(bare.asperities.empty());
  EXPECT_TRUE(bare.energy_curve.empty());
  EXPECT_EQ(bare.pull_off_force, full.pull_off_force);
  EXPECT_EQ(bare.asperity_count, full.asperity_count);
}

TEST(AdhesionModel, saysWhenTheSearchRangeEnds) {
  Options options = paperOptions();
  options.load.mechanical_load = 1e-4;
  options.approach.max_steps = 3;
  const Prediction prediction = AdhesionModel(options).predict(rough());
  EXPECT_EQ(prediction.status, Status::kNoEquilibrium);
  EXPECT_EQ(prediction.steps, 3);
  EXPECT_NEAR(prediction.approach, 3 * prediction.composite_rms_height / 50,
              1e-18);  // sigma/50 each
  expectAllFinite(prediction);
}

TEST(AdhesionModel, bondsAtTheContactFractionThatIsSet) {
  Options options = paperOptions();
  options.load.mechanical_load = 0.9;  // far more than the contacts carry
  for (const double fraction : {0.1, 0.3, 1.0}) {
    options.approach.max_contact_fraction = fraction;
    const Prediction prediction = AdhesionModel(options).predict(rough());
    EXPECT_EQ(prediction.status, Status::kBonded);
    EXPECT_NEAR(prediction.contact_fraction, fraction,
                1.0 / 6000 + 1e-12);  // the first of 6000 cells beyond
    expectAllFinite(prediction);
  }
}

TEST(AdhesionModel, worksWithoutAdhesion) {
  Options options = paperOptions();
  options.interface.work_of_adhesion = 0.0;
  options.interface.hamaker_constant = 0.0;
  options.load.mechanical_load = 1e-6;
  const Prediction prediction = AdhesionModel(options).predict(rough());
  EXPECT_EQ(prediction.status, Status::kEquilibrium);
  EXPECT_EQ(prediction.pull_off_force, 0.0);
  EXPECT_TRUE(std::isnan(prediction.normalized_bonding_energy));
  EXPECT_TRUE(std::isinf(prediction.adhesion_parameter));
  EXPECT_EQ(prediction.bonding_regime, BondingRegime::kNonBonding);
}

TEST(AdhesionModel, refusesSurfacesThatItCannotUse) {
  AdhesionModel model{paperOptions()};
  EXPECT_THROW(model.predict(HeightMap(cv::Mat1d(4, 5, kNan), kNm, kNm)), SurfaceError);
  EXPECT_THROW(model.predict(SurfacePair(rough(), analytic::flat(80, 74, 10 * kNm, 10 * kNm))),
               SurfaceError);
  EXPECT_THROW(model.predict(SurfacePair(rough(), analytic::flat(80, 75, 10 * kNm, 11 * kNm))),
               SurfaceError);
  for (const double height : {2e154, -2e154, 1e300, -1e300, 1.7e308, -1.7e308}) {
    cv::Mat1d heights = rough().heights().clone();
    heights(3, 4) = height;
    const HeightMap outlier(heights, rough().pitchX(), rough().pitchY());
    EXPECT_THROW(model.predict(outlier), SurfaceError) << height;
    EXPECT_THROW(model.predict(SurfacePair(outlier, rough())), SurfaceError) << height;
    EXPECT_THROW(model.predict(SurfacePair(outlier, outlier)), SurfaceError) << height;
  }
  // and goes on after it
  EXPECT_EQ(model.predict(rough()).pull_off_force,
            AdhesionModel(paperOptions()).predict(rough()).pull_off_force);
}

}  // namespace
}  // namespace mems_stiction
