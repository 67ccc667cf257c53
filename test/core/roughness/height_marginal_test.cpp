#include "roughness/height_marginal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace mems_stiction {
namespace {

std::vector<double> sampleOf(int count, int seed, const std::function<double(double)>& height) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  std::vector<double> sample;
  for (int i = 0; i < count; ++i) sample.push_back(height(normal(engine)));
  return sample;
}

TEST(HeightMarginal, NormalShareAndItsInverse) {
  EXPECT_NEAR(normalShare(1.959963984540054), 0.975, 1e-12);
  for (const double g : {-5.0, -1.0, 0.0, 0.3, 4.0})
    EXPECT_NEAR(normalNumber(normalShare(g)), g, 1e-7);
}

TEST(HeightMarginal, GaussianHeightsGoOnAsGaussian) {
  const HeightMarginal marginal(sampleOf(100000, 1, [](double g) { return 5e-9 + 2e-9 * g; }), 1e5);
  EXPECT_NEAR(marginal.tailShape(), 0.0, 0.12);
  for (const double g : {-2.0, 0.0, 2.0, 5.5}) {
    EXPECT_NEAR(marginal.heightOf(g), 5e-9 + 2e-9 * g, 1e-9) << g;
    EXPECT_NEAR(marginal.numberOf(marginal.heightOf(g)), g, 1e-9) << g;
  }
}

/// Beyond the highest one that was measured, in one of 100,000, the distribution goes on as it is.
TEST(HeightMarginal, TailsGoOnBeyondTheSample) {
  for (const double shape : {-0.25, 0.3}) {
    const auto height = [&](double g) { return std::expm1(shape * g) / shape; };
    const HeightMarginal marginal(sampleOf(100000, 2, height), 1e5);
    EXPECT_NEAR(marginal.heightOf(5.5) / height(5.5), 1.0, 0.12) << shape;
    EXPECT_NEAR(marginal.heightOf(-1.0), height(-1.0), 0.05) << shape;
  }
}

TEST(HeightMarginal, FewIndependentPlacesSayAsAGaussianSurface) {
  const auto height = [](double g) { return std::expm1(0.3 * g) / 0.3; };
  const std::vector<double> sample = sampleOf(20000, 3, height);
  const double many = HeightMarginal(sample, 20000).tailShape();
  const double few = HeightMarginal(sample, 40).tailShape();
  EXPECT_GT(many, 0.2);
  EXPECT_LT(few, 0.75 * many);
  EXPECT_GT(few, 0.0);
}

TEST(HeightMarginal, MixedWithAGaussianOne) {
  const HeightMarginal marginal(sampleOf(20000, 4, [](double g) { return std::exp(0.3 * g); }),
                                20000);
  const HeightMarginal half = marginal.mixed(0.5, 1.0, 0.2);
  EXPECT_NEAR(half.heightOf(2.0), 0.5 * marginal.heightOf(2.0) + 0.5 * 1.4, 1e-9);
}

/// c = 1/3 with g0 = 2 is T' = b g/2: heights as squares of normal numbers.
TEST(HeightMarginal, TheOtherFormOfALongerTail) {
  const auto height = [](double g) { return g > 0.0 ? g * g : 0.1 * g; };
  const std::vector<double> sample = sampleOf(100000, 5, height);
  const HeightMarginal power(sample, 1e5, TailForm::kPower);
  EXPECT_NEAR(power.tailShape(), 1.0 / 3.0, 0.1);
  EXPECT_NEAR(power.heightOf(5.5) / height(5.5), 1.0, 0.06);
  // the exponential one goes on higher
  EXPECT_GT(HeightMarginal(sample, 1e5).heightOf(5.5), 1.03 * power.heightOf(5.5));
}

}  // namespace
}  // namespace mems_stiction
