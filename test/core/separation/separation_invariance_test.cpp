/// What the separation curve must not depend on, and bounds that hold for every surface.

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "support/analytic_surfaces.hpp"
#include "support/sample_frames.hpp"
#include "support/separation_cases.hpp"

namespace mems_stiction {
namespace {

using separation_cases::elastic;
using separation_cases::kWork;
using separation_cases::rangeOf;
using separation_cases::sameFigures;

HeightMap rough(double rms = 1e-9, int seed = 3) {
  return samples::gaussian(72, 96, 4e-9, 4e-9, rms, 40e-9, seed);
}

Prediction predict(const Options& options, const SurfacePair& surfaces) {
  return AdhesionModel(options).predict(surfaces);
}

void expectSame(const Prediction& one, const Prediction& other, double tolerance) {
  EXPECT_EQ(one.status, other.status);
  EXPECT_EQ(one.asperity_count, other.asperity_count);
  EXPECT_NEAR(one.pull_off_force / other.pull_off_force, 1.0, tolerance);
  EXPECT_NEAR(one.apparent_work_of_adhesion / other.apparent_work_of_adhesion, 1.0, tolerance);
  EXPECT_NEAR(one.contact_area / other.contact_area, 1.0, tolerance);
  EXPECT_NEAR(one.approach / other.approach, 1.0, tolerance);
}

TEST(SeparationBounds, neitherStrengthNorWorkOfTheLawAreExceeded) {
  for (const double modulus : {0.3e9, 5e9, 89e9}) {
    for (const double rms : {0.03e-9, 0.3e-9, 1e-9, 4e-9}) {
      const Options options = elastic(modulus);
      const Prediction prediction = predict(options, rough(rms));
      const double strength = 1.0264 * kWork / rangeOf(options) * prediction.nominal_area;
      for (const SeparationCurvePoint& point : prediction.curve) EXPECT_LE(point.force, strength);
      EXPECT_LE(prediction.pull_off_force, strength);
      EXPECT_GT(prediction.pull_off_force, 0.0);
      EXPECT_LE(prediction.apparent_work_of_adhesion,
                1.05 * kWork);  // trapezia of a curve in steps of 0.3 z0
      EXPECT_LE(prediction.contact_area, prediction.nominal_area);
    }
  }
}

TEST(SeparationScaling, everythingLargerByAFactor) {
  const double scale = 1e4;
  Options options = elastic(20e9);
  options.interface.hamaker_constant = 0.0;  // so that the range is stated
  const Prediction one = predict(options, rough());
  options.interface.work_of_adhesion *= scale;
  options.interface.equilibrium_distance *= scale;
  const cv::Mat heights = rough().heights() * scale;
  Prediction large = predict(options, HeightMap(heights, 4e-9 * scale, 4e-9 * scale));
  large.pull_off_force /= scale * scale;
  large.contact_area /= scale * scale;
  large.apparent_work_of_adhesion /= scale;
  large.approach /= scale;
  expectSame(one, large, 1e-6);  // round-off, in buckets of other widths
}

TEST(SeparationScaling, modulusAndAdhesionTogether) {
  Options options = elastic(20e9);
  options.interface.hamaker_constant = 0.0;
  const Prediction one = predict(options, rough());
  options.lower.youngs_modulus *= 1e-3;
  options.interface.work_of_adhesion *= 1e-3;
  options.upper.youngs_modulus *= 1e-3;
  Prediction thousandth = predict(options, rough());
  thousandth.pull_off_force *= 1e3;
  thousandth.apparent_work_of_adhesion *= 1e3;
  expectSame(one, thousandth, 1e-9);  // round-off
}

TEST(SeparationSymmetry, transposedFramesWithTheirPitchAreTheSame) {
  const HeightMap oblong = samples::gaussian(60, 90, 3e-9, 5e-9, 1e-9, 40e-9, 5);
  const cv::Mat turned = oblong.heights().t();
  const Options options = elastic(20e9);
  expectSame(predict(options, oblong), predict(options, HeightMap(turned, 5e-9, 3e-9)),
             1e-9);  // sums in another order
}

TEST(SeparationSymmetry, mirroredFramesAreTheSame) {
  const Options options = elastic(20e9);
  for (const int code : {-1, 0, 1}) {
    cv::Mat mirrored;
    cv::flip(rough().heights(), mirrored, code);
    expectSame(predict(options, rough()), predict(options, HeightMap(mirrored, 4e-9, 4e-9)), 1e-9);
  }
}

TEST(SeparationSymmetry, anisotropicPixelsDescribeTheSameSphere) {
  const Options options = elastic(5e9);
  const Prediction square =
      predict(options, analytic::paraboloid(160, 160, 0.5e-9, 0.5e-9, 100e-9));
  const Prediction oblong =
      predict(options, analytic::paraboloid(100, 200, 0.4e-9, 0.8e-9, 100e-9));
  EXPECT_NEAR(oblong.pull_off_force / square.pull_off_force, 1.0,
              0.01);  // pixels of a tenth of the contact's ring
  EXPECT_NEAR(oblong.apparent_work_of_adhesion / square.apparent_work_of_adhesion, 1.0, 0.01);
}

TEST(SeparationFrames, invalidPixelsNeverTouch) {
  const HeightMap holed = samples::withHoles(rough(), 0.2, 9);
  const Prediction prediction = predict(elastic(20e9, 1e-6), holed);
  ASSERT_FALSE(prediction.contact_map.empty());
  int holes = 0;
  for (int row = 0; row < holed.rows(); ++row) {
    for (int col = 0; col < holed.cols(); ++col) {
      if (std::isfinite(holed.height(row, col))) continue;
      ++holes;
      EXPECT_EQ(prediction.contact_map.at<std::uint8_t>(row, col), 0);
    }
  }
  EXPECT_GT(holes, 100);
  EXPECT_NEAR(prediction.nominal_area, (72 * 96 - holes) * 16e-18, 1e-24);
}

TEST(SeparationFrames, withoutWorkOfAdhesionNothingHolds) {
  Options options = elastic(20e9, 1e-6);
  options.interface.work_of_adhesion = 0.0;
  const Prediction prediction = predict(options, rough());
  EXPECT_EQ(prediction.status, Status::kEquilibrium);
  EXPECT_EQ(prediction.pull_off_force, 0.0);
  EXPECT_EQ(prediction.van_der_waals_force, 0.0);
  EXPECT_EQ(prediction.apparent_work_of_adhesion, 0.0);
  EXPECT_GT(prediction.contact_area, 0.0);
  EXPECT_TRUE(std::isinf(prediction.adhesion_parameter));
}

TEST(SeparationFrames, withoutHamakerConstantTheRangeIsStated) {
  Options options = elastic(20e9);
  const double range = rangeOf(options);
  const Prediction derived = predict(options, rough());
  options.interface.hamaker_constant = 0.0;
  options.interface.equilibrium_distance = range;
  const Prediction stated = predict(options, rough());
  EXPECT_NEAR(stated.pull_off_force / derived.pull_off_force, 1.0, 1e-9);
}

TEST(SeparationFrames, loadCarriesOnIntoFullContact) {
  // the order is made for a 64th of the cells at first and again for more as the approach goes on
  Options options = elastic(0.2e9, 1.5e-7);
  options.interface.work_of_adhesion = 0.0;
  options.approach.max_contact_fraction = 1.0;
  const Prediction prediction = predict(options, rough());
  ASSERT_EQ(prediction.status, Status::kEquilibrium);
  double touching = 0.0;
  const HeightMap surface = rough();
  double top = -1.0;
  for (int row = 0; row < 72; ++row) {
    for (int col = 0; col < 96; ++col) top = std::max(top, surface.height(row, col));
  }
  for (int row = 0; row < 72; ++row) {
    for (int col = 0; col < 96; ++col)
      touching += top - surface.height(row, col) < prediction.approach ? 1.0 : 0.0;
  }
  EXPECT_GT(touching / (72 * 96), 0.5);
  // half of the overlap, and the other half of each summit's cell
  const double summits = static_cast<double>(prediction.asperities.size());
  EXPECT_NEAR(prediction.contact_area / (0.5 * (touching + summits) * 16e-18), 1.0, 1e-9);
  // all that is carried is the load, to where the search of rest ends
  double carried = 0.0;
  for (const Asperity& asperity : prediction.asperities) carried += asperity.load;
  EXPECT_NEAR(carried / 1.5e-7, 1.0, 2e-3);
}

TEST(SeparationFrames, pullOffForceOfElasticSurfacesDoesNotDependOnTheLoadThatPressedThem) {
  const Prediction unloaded = predict(elastic(50e9), rough(2e-9));
  const Prediction loaded = predict(elastic(50e9, 2e-6), rough(2e-9));
  EXPECT_GT(loaded.contact_area, 1.5 * unloaded.contact_area);
  EXPECT_NEAR(loaded.pull_off_force / unloaded.pull_off_force, 1.0,
              1e-3);  // the same steps up to the maximum
}

TEST(SeparationFrames, bitsAreThoseOfAFreshObject) {
  const Options options = elastic(20e9, 1e-6);
  AdhesionModel used(options);
  const Prediction first = used.predict(rough());
  used.predict(samples::gaussian(31, 45, 3e-9, 3e-9, 2e-9, 20e-9, 8));
  used.predict(rough(0.05e-9, 11));
  const Prediction again = used.predict(rough());
  EXPECT_TRUE(sameFigures(first, again));
  EXPECT_EQ(cv::norm(first.contact_map, again.contact_map, cv::NORM_INF), 0.0);
}

TEST(SeparationFrames, exponentsAreTheChangesWithTheConstants) {
  const Options options = elastic(50e9);
  const Prediction at = predict(options, rough(3e-9));
  ASSERT_FALSE(at.is_conforming);
  const double factor = 1.02;
  const auto expectExponents = [&](const Options& changed, double of_force, double of_work) {
    const Prediction moved = predict(changed, rough(3e-9));
    // the change of the bending factor and of what contacts open is left out: up to a tenth
    EXPECT_NEAR(std::log(moved.pull_off_force / at.pull_off_force) / std::log(factor), of_force,
                0.1);
    EXPECT_NEAR(
        std::log(moved.apparent_work_of_adhesion / at.apparent_work_of_adhesion) / std::log(factor),
        of_work, 0.1);
  };
  Options changed = options;
  changed.lower.youngs_modulus *= factor;
  expectExponents(changed, at.pull_off_exponents.modulus, at.work_exponents.modulus);
  changed = options;
  changed.interface.work_of_adhesion *= factor;
  expectExponents(changed, at.pull_off_exponents.adhesion, at.work_exponents.adhesion);
  changed = options;
  changed.interface.hamaker_constant *= factor;
  expectExponents(changed, at.pull_off_exponents.hamaker, at.work_exponents.hamaker);
}

}  // namespace
}  // namespace mems_stiction
