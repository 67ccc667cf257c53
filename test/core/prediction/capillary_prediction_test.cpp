/// The capillary term inside a prediction, against closed forms.

#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;

Options humid(double relative_humidity) {
  Options options = paperOptions();
  options.interface.hamaker_constant = 0.0;
  options.capillary.relative_humidity = relative_humidity;
  return options;
}

TEST(CapillaryPrediction, ofASphereIsFourPiGammaR) {
  const HeightMap sphere = analytic::paraboloid(451, 451, 1 * kNm, 1 * kNm, 2e-6);
  for (const double humidity : {0.5, 0.8}) {
    const Prediction prediction = AdhesionModel(humid(humidity)).predict(sphere);
    ASSERT_EQ(prediction.status, Status::kEquilibrium);
    const double expected = 4.0 * kPi * 0.072 * 2e-6;
    EXPECT_NEAR(prediction.capillary_force, expected,
                0.02 * expected);  // rings counted in pixels
    EXPECT_EQ(prediction.normal_load, prediction.capillary_force);
    EXPECT_EQ(prediction.pull_off_force,
              prediction.pull_off_force_jkr + prediction.capillary_force);
  }
}

// Rest lies between two neighbouring numbers: nothing is carried at 0, all at the next.
TEST(CapillaryPrediction, ofAPlaneEndsAndBonds) {
  const HeightMap plane(cv::Mat::zeros(8, 8, CV_64FC1), 1 * kNm, 1 * kNm);
  for (const double humidity : {1e-12, 0.01, 0.5}) {
    Options options;
    options.capillary.relative_humidity = humidity;
    const Prediction prediction = AdhesionModel(options).predict(plane);
    EXPECT_EQ(prediction.status, Status::kBonded) << humidity;
    EXPECT_GT(prediction.pull_off_force, 0.0);
  }
}

TEST(CapillaryPrediction, isOffByDefault) {
  const HeightMap sphere = analytic::paraboloid(101, 101, 1 * kNm, 1 * kNm, 2e-6);
  EXPECT_EQ(AdhesionModel(paperOptions()).predict(sphere).capillary_force, 0.0);
}

}  // namespace
}  // namespace mems_stiction
