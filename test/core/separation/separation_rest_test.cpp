/// Where surfaces come to rest that could rest in more than one place.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "separation/contact_curve.hpp"
#include "support/sample_frames.hpp"
#include "support/separation_cases.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 120;
constexpr double kPitch = 1e-9;
constexpr int kBump = 3;

/// A stiff bump that holds a plain off, though the plain would hold fast once it came near: the
/// bump carries 5 nN for each 0.016 nm, the plain attracts with 36 nN at first touch, with 90 % of
/// what the bump carries at 0.25 nm past it, and with twice that at 0.7 nm. Beside the plain there
/// is a pit, so that the surfaces cannot conform.
Prediction predictAt(double load, double contact_modulus = 100e9) {
  cv::Mat1d heights(kSide, 2 * kSide, -50e-9);
  heights.colRange(0, kSide) = -1e-9;
  heights(cv::Rect(kSide / 2, kSide / 2, kBump, kBump)) = 0.0;
  const HeightMap surface(heights, kPitch, kPitch);
  return AdhesionModel(separation_cases::elastic(contact_modulus, load)).predict(surface);
}

TEST(SeparationRest, surfacesThatComeNearSlowlyStopAtTheFirstPlaceOfRest) {
  const Prediction prediction = predictAt(0.0);
  EXPECT_EQ(prediction.status, Status::kEquilibrium);
  EXPECT_LE(prediction.contact_area, kBump * kBump * kPitch * kPitch);
  EXPECT_LT(prediction.approach, 0.3e-9);
}

TEST(SeparationRest, aLoadTakesThemPastIt) {
  const Prediction prediction = predictAt(1e-7);
  EXPECT_GT(prediction.approach, 0.95e-9);  // the plain lies as near as the law lets it
  EXPECT_GT(prediction.pull_off_force, 10.0 * predictAt(0.0).pull_off_force);
}

TEST(SeparationRest, isDoubtedWhereHardlyAnythingKeepsTheSurfacesFromOneThatHoldsMore) {
  const Prediction held = predictAt(0.0);  // by a tenth of what the bump carries
  ASSERT_NE(held.model.doubt, nullptr);
  EXPECT_NE(std::string(held.model.doubt).find("nearer rest"), std::string::npos)
      << held.model.doubt;
  // the law's peak that is left: a bump twice as stiff carries twice as much there
  const Prediction stiff = predictAt(0.0, 200e9);
  EXPECT_EQ(stiff.status, Status::kEquilibrium);
  EXPECT_EQ(stiff.model.doubt, nullptr);
  // beyond it there is no other
  const Prediction pressed = predictAt(1e-7);
  EXPECT_TRUE(pressed.model.doubt == nullptr ||
              std::string(pressed.model.doubt).find("nearer rest") == std::string::npos)
      << pressed.model.doubt;
}

TEST(SeparationRest, figuresAreThoseOfACurveThatWasNotAskedForAnother) {
  const HeightMap surface = samples::gaussian(64, 64, 4e-9, 4e-9, 0.6e-9, 30e-9, 97);
  const Options options =
      separation_cases::elastic(10e9);  // soft: what follows rest is another unloading branch
  const Prediction prediction = AdhesionModel(options).predict(surface);
  ASSERT_NE(prediction.model.doubt, nullptr);
  ASSERT_NE(std::string(prediction.model.doubt).find("nearer rest"), std::string::npos)
      << prediction.model.doubt;
  GapField field;
  field.compute(surface);
  ContactCurve curve;
  curve.comeToRest(field, options);
  curve.part();
  // which cells are in order shows in the last digits
  constexpr double kLastDigits = 1e-5;
  const Unloading& alone = curve.byContacts();
  EXPECT_NEAR(prediction.pull_off_force / alone.force, 1.0, kLastDigits);
  EXPECT_NEAR(prediction.apparent_work_of_adhesion / alone.work, 1.0, kLastDigits);
  EXPECT_NEAR(prediction.work_exponents.hamaker, alone.work_exponents.hamaker, kLastDigits);
}

TEST(SeparationRest, contactsGrowUnderALoadThatPressesBeyondTheSearch) {
  const HeightMap surface = samples::gaussian(64, 64, 4e-9, 4e-9, 2e-9, 30e-9, 1);
  const auto predict = [&](double load, double max_contact_fraction) {
    Options options = separation_cases::elastic(50e9, load);
    options.approach.max_contact_fraction = max_contact_fraction;
    return AdhesionModel(options).predict(surface);
  };
  const double load = 5e-5;  // 0.76 GPa
  const Prediction whole = predict(load, 1.0);
  ASSERT_EQ(whole.status, Status::kEquilibrium);
  const double before = predict(0.5 * load, 0.3).contact_area;
  for (const double share : {0.3, 0.5}) {
    const Prediction ended = predict(load, share);
    ASSERT_EQ(ended.status, Status::kBonded) << share;
    ASSERT_LT(ended.approach, 0.9 * whole.approach) << share;
    EXPECT_NEAR(ended.contact_area, whole.contact_area, 0.15 * whole.contact_area) << share;
    EXPECT_GT(ended.contact_area, 1.2 * before) << share;
  }
}

TEST(SeparationRest, allTouchesUnderALoadThatPressesTheSurfaceFlat) {
  const HeightMap surface = samples::gaussian(64, 64, 4e-9, 4e-9, 2e-9, 30e-9, 1);
  const double slope = 2.0 * 2e-9 / 30e-9;
  const double area = 64 * 64 * 4e-9 * 4e-9;
  const auto touching = [&](double pressure) {
    const Options options = separation_cases::elastic(50e9, pressure * area);
    return AdhesionModel(options).predict(surface).contact_area / area;
  };
  EXPECT_GT(touching(50e9 * slope / std::sqrt(kPi)), 0.8);
  EXPECT_GT(touching(50e9 * slope * 1.5), 0.99);
}

TEST(SeparationRest, forcesBalanceThereThoughOneSideIsAWall) {
  const double load = 1e-7;
  const Prediction prediction = predictAt(load);
  double elastic = 0.0;
  for (const Asperity& asperity : prediction.asperities) elastic += asperity.load;
  EXPECT_NEAR(prediction.van_der_waals_force + load, elastic, 2e-3 * elastic);
}

/// Rough surfaces far from bonding, on a frame of 256 nm.
Prediction predictWithLowerBody(double thickness, Backing backing, double substrate_modulus = 0.0) {
  Options options = separation_cases::elastic(40e9);
  options.lower.thickness = thickness;
  options.lower.backing = backing;
  options.lower.substrate.youngs_modulus = substrate_modulus;
  options.lower.substrate.poisson_ratio = options.lower.poisson_ratio;
  return AdhesionModel(options).predict(samples::gaussian(64, 64, 4e-9, 4e-9, 3e-9, 20e-9, 5));
}

TEST(ThinBodies, haveTheFiguresOfThickOnesAndADoubt) {
  const double width = 64 * 4e-9;
  const Prediction thick = predictWithLowerBody(0.0, Backing::kFree);
  EXPECT_EQ(thick.model.doubt, nullptr);
  for (const Backing backing : {Backing::kFree, Backing::kBonded}) {
    const Prediction thin = predictWithLowerBody(width / 8.0, backing);
    EXPECT_TRUE(separation_cases::sameFigures(thin, thick));
    ASSERT_NE(thin.model.doubt, nullptr);
    EXPECT_NE(std::string(thin.model.doubt).find("thin"), std::string::npos);
    EXPECT_EQ(predictWithLowerBody(2.0 * width, backing).model.doubt, nullptr);
  }
  // nor does a wave feel where a body ends on a thick one of the same material
  EXPECT_EQ(predictWithLowerBody(width / 8.0, Backing::kBonded, 40e9).model.doubt, nullptr);
}

}  // namespace
}  // namespace mems_stiction
