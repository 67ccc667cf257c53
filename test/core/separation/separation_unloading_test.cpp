/// What holds on the unloading branch: soft summits beyond their touch, shoulders that the contact
/// has opened, and how surfaces part. Against JKR's closed form and against the half-space.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "separation/chosen_constants.hpp"
#include "separation/contact_traction.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/separation_cases.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

using separation_cases::elastic;
using separation_cases::halfSpaceOf;
using separation_cases::kWork;
using separation_cases::rangeOf;

/// Force at the point of the curve that is nearest to a displacement.
double forceAt(const Prediction& prediction, double displacement, bool is_separation) {
  const SeparationCurvePoint* nearest = nullptr;
  for (const SeparationCurvePoint& point : prediction.curve) {
    if (point.is_separation != is_separation) continue;
    if (nearest == nullptr || std::abs(point.displacement - displacement) <
                                  std::abs(nearest->displacement - displacement)) {
      nearest = &point;
    }
  }
  return nearest == nullptr ? 0.0 : nearest->force;
}

class SoftSphere : public testing::TestWithParam<double> {
 protected:
  static constexpr double kRadius = 50e-9;
  /// Of the sphere with Tabor's parameter mu.
  static Prediction predicted(double tabor) {
    const double range = rangeOf(Options());
    const Options options =
        elastic(std::sqrt(kRadius * kWork * kWork / std::pow(tabor * range, 3.0)));
    return AdhesionModel(options).predict(
        analytic::paraboloid(257, 257, 0.25e-9, 0.25e-9, kRadius));
  }
};

TEST_P(SoftSphere, holdsUntilJkrsPullOffDisplacement) {
  const double tabor = GetParam();
  const Prediction sphere = predicted(tabor);
  // delta_c = -(1/3) (9 pi/8)^(2/3) mu z0; the law's own range does as much for mu up to 1/2
  const double hold =
      std::pow(9.0 * kPi / 8.0, 2.0 / 3.0) / 3.0 * (tabor - 0.5) * rangeOf(Options());
  EXPECT_NEAR(forceAt(sphere, -0.8 * hold, true) / sphere.pull_off_force, 1.0, 0.06);
  EXPECT_LT(forceAt(sphere, -1.0 * hold - rangeOf(Options()), true), 0.6 * sphere.pull_off_force);
  EXPECT_LT(forceAt(sphere, -0.8 * hold, false), forceAt(sphere, -0.8 * hold, true))
      << "no hysteresis";
}

INSTANTIATE_TEST_SUITE_P(Tabor, SoftSphere, testing::Values(1.5, 2.0, 3.0));

TEST(StiffSphere, goesOutAsItCameIn) {
  const Options options = elastic(1e12);
  const Prediction sphere =
      AdhesionModel(options).predict(analytic::paraboloid(129, 129, 0.25e-9, 0.25e-9, 20e-9));
  EXPECT_TRUE(std::none_of(sphere.curve.begin(), sphere.curve.end(),
                           [](const SeparationCurvePoint& point) { return point.is_separation; }));
}

/// A summit of the gap height (r/width)^exponent.
HeightMap summit(double exponent, double height, double width, int side, double pitch) {
  cv::Mat1d heights(side, side);
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col) {
      const double r = pitch * std::hypot(row - side / 2, col - side / 2);
      heights(row, col) = -height * std::pow(r / width, exponent);
    }
  }
  return HeightMap(heights, pitch, pitch);
}

struct Tip {
  double exponent;
  double height;
  double modulus;
};

/// Over what the half-space says.
struct Ratios {
  double pull_off;
  double area;
  double work;
};

Ratios againstHalfSpace(const HeightMap& surface, const Options& options) {
  const Prediction prediction = AdhesionModel(options).predict(surface);
  const SolvedHalfSpace solved = halfSpaceOf(surface, options);
  EXPECT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  return {prediction.pull_off_force / solved.pull_off_force,
          prediction.contact_area / solved.contact_area,
          prediction.apparent_work_of_adhesion / solved.work_of_adhesion};
}

TEST(SoftTips, holdAsInTheHalfSpace) {
  // Tabor parameters of 1.6 to 1.9: let go where they would on the loading branch, they hold 0.83
  // to 0.86, the paraboloid's work is 0.79
  for (const Tip& tip :
       {Tip{2.0, 3e-9, 5e9}, {1.5, 3e-9, 5e9}, {1.3, 3e-9, 5e9}, {1.3, 6e-9, 5e9}}) {
    SCOPED_TRACE(testing::Message() << "exponent " << tip.exponent << ", height " << tip.height);
    const Ratios ratios =
        againstHalfSpace(summit(tip.exponent, tip.height, 40e-9, 128, 1e-9), elastic(tip.modulus));
    EXPECT_NEAR(ratios.pull_off, 1.0, 0.07);
    EXPECT_NEAR(ratios.work, 1.0, 0.13);
  }
}

TEST(Shoulders, thatAContactHasOpenedDoNotAttract) {
  // a stiff tip with shoulders: attracted by all of the undeformed gap it would touch on a quarter
  // more
  const Ratios ratios = againstHalfSpace(summit(1.3, 6e-9, 40e-9, 128, 1e-9), elastic(20e9));
  EXPECT_NEAR(ratios.area, 1.0, 0.12);
  EXPECT_NEAR(ratios.pull_off, 1.0, 0.08);
}

/// Height of 200 nm over everything around.
HeightMap punch(double radius, int pixels, double pitch) {
  cv::Mat1d heights(pixels, pixels, -200e-9);
  for (int row = 0; row < pixels; ++row) {
    for (int col = 0; col < pixels; ++col) {
      if (std::hypot(row - pixels / 2, col - pixels / 2) * pitch < radius) heights(row, col) = 0.0;
    }
  }
  return {heights, pitch, pitch};
}

/// A bump on a flat film, Gaussian.
HeightMap bumpOnFilm(double height, double width, int side, double pitch) {
  cv::Mat1d heights(side, side);
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col) {
      const double r = pitch * std::hypot(row - side / 2, col - side / 2);
      heights(row, col) = height * std::exp(-r * r / (width * width));
    }
  }
  return {heights, pitch, pitch};
}

TEST(FlatFilm, holdsNoMoreThanItsAreaBesideABumpOfAnyHeight) {
  constexpr int kSide = 96;
  constexpr double kPitch = 2e-9;
  const double area = kSide * kPitch * kSide * kPitch;
  const Options options = elastic(1.2e11, 80e6 * area);
  const double strength = ContactTraction(options.interface).strength();
  const auto forceOf = [&](double height) {
    return AdhesionModel(options).predict(bumpOnFilm(height, 16e-9, kSide, kPitch)).pull_off_force;
  };
  double before = forceOf(1.7e-9);
  // z0 is 0.2 nm: the film comes and goes within less than a step of the bump's displacement
  for (double height = 1.73e-9; height < 2.0e-9; height += 0.03e-9) {
    const double force = forceOf(height);
    EXPECT_LT(force, strength * area) << height;
    EXPECT_NEAR(force / before, 1.0, 0.1) << height;
    before = force;
  }
}

class FlatPunch : public testing::TestWithParam<double> {};

TEST_P(FlatPunch, letsGoFromItsEdge) {
  // from the strength of the law on all of its area to Griffith's crack around it, sqrt(8 pi E
  // Gamma a^3): by its radius over the one at which both are the same
  const double radius = 40e-9;
  const Options law = elastic(1e9);
  const double strength = 16.0 * kWork / (9.0 * std::sqrt(3.0) * rangeOf(law));
  const double even = kPi * radius * radius * strength;
  const double modulus = even * even / (8.0 * kPi * kWork * std::pow(radius, 3.0)) / GetParam();
  const Options options = elastic(modulus);
  const HeightMap surface = punch(radius, 128, 1e-9);
  const double crack = std::sqrt(8.0 * kPi * modulus * kWork * std::pow(radius, 3.0));
  const Prediction prediction = AdhesionModel(options).predict(surface);
  ASSERT_FALSE(prediction.is_conforming);
  EXPECT_NEAR(prediction.pull_off_force * std::hypot(1.0 / even, 1.0 / crack), 1.0, 0.04);
  const Ratios ratios = againstHalfSpace(surface, options);
  EXPECT_NEAR(ratios.pull_off, 1.0, 0.12);
  EXPECT_NEAR(ratios.work, 1.0, 0.1);
  // wider than a0 it parts by a crack, and what roughness and outline make of that the curve does
  // not know
  if (GetParam() != 1.0) {
    EXPECT_EQ(prediction.model.doubt != nullptr, GetParam() > 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(RadiusOverEven, FlatPunch, testing::Values(0.1, 1.0, 10.0));

TEST(Doubt, isOfForcesThatAreDifferences) {
  // what is subtracted raises the force's exponent with the work of adhesion above 1; what wide
  // contacts leave of the limit is less
  GaussianSurfaceOptions rough;
  rough.rows = rough.cols = 96;
  rough.pitch_x = rough.pitch_y = 2e-9;
  rough.correlation_length_x = rough.correlation_length_y = 16e-9;
  rough.rms_height = 0.6e-9;
  int doubted = 0;
  for (const int seed : {1, 2, 3, 4, 5, 6}) {
    rough.seed = seed;
    const Prediction prediction = AdhesionModel(elastic(30e9)).predict(gaussianSurface(rough));
    ASSERT_FALSE(prediction.is_conforming);
    const double excess = prediction.pull_off_exponents.adhesion - 1.0;
    const bool is_doubted = prediction.model.doubt != nullptr;
    EXPECT_TRUE(is_doubted || excess < chosen::kDoubtedContacts) << seed << ", " << excess;
    if (is_doubted && std::string(prediction.model.doubt).find("difference") != std::string::npos) {
      EXPECT_GT(excess, 0.5 * chosen::kDoubtedContacts) << seed;
      ++doubted;
    }
  }
  EXPECT_GT(doubted, 0);
  EXPECT_LT(doubted, 6);
}

TEST(Decision, aTallSummitKeepsSurfacesApartThatWouldHoldIfTheyMet) {
  // pressed flat the relief would store less than adhesion gives
  cv::Mat1d heights(128, 128);
  for (int row = 0; row < 128; ++row) {
    for (int col = 0; col < 128; ++col) {
      const double square = (std::pow(row - 64, 2.0) + std::pow(col - 64, 2.0)) / 36.0;
      heights(row, col) =
          7e-9 * std::exp(-0.5 * square) + 5e-11 * std::sin(0.4 * row) * std::sin(0.5 * col);
    }
  }
  const Options options = elastic(5e9);
  const HeightMap surface(heights, 2e-9, 2e-9);
  const Prediction prediction = AdhesionModel(options).predict(surface);
  EXPECT_LT(prediction.flattening_ratio, chosen::kConformingRatio);
  EXPECT_FALSE(prediction.is_conforming);
  const Ratios ratios = againstHalfSpace(surface, options);
  EXPECT_NEAR(ratios.pull_off, 1.0, 0.15);
}

TEST(Decision, aFilmIsDoubtedThatIsHardlyDrawnPastTheRestOnItsBump) {
  // the half-space rests on the bump, with 0.2 uN
  const Prediction closed = AdhesionModel(Options()).predict(bumpOnFilm(1.0e-9, 24e-9, 112, 2e-9));
  ASSERT_TRUE(closed.is_conforming);
  ASSERT_NE(closed.model.doubt, nullptr);
  EXPECT_NE(std::string(closed.model.doubt).find("farther rest"), std::string::npos);
  const Prediction low = AdhesionModel(Options()).predict(bumpOnFilm(0.3e-9, 24e-9, 112, 2e-9));
  EXPECT_TRUE(low.is_conforming);
  EXPECT_EQ(low.model.doubt, nullptr) << low.model.doubt;
}

TEST(Decision, candidatesMeetWhereItFalls) {
  // a wave that is flattened for a little less and a little more than three quarters of what
  // adhesion gives
  const double pitch = 1e-9;
  const Options options = elastic(100e9);
  const auto waveOf = [&](double amplitude) {
    return analytic::sine(64, 64, pitch, pitch, amplitude, 1, 0);
  };
  const double amplitude = 0.5e-9;
  const double ratio = AdhesionModel(options).predict(waveOf(amplitude)).flattening_ratio;
  for (const double wanted : {0.74, 0.76}) {  // README.md and other pages state the limit
    SCOPED_TRACE(wanted);
    const HeightMap wave = waveOf(amplitude * std::sqrt(wanted / ratio));
    EXPECT_EQ(AdhesionModel(options).predict(wave).is_conforming, wanted < 0.75);
    const Ratios ratios = againstHalfSpace(wave, options);
    EXPECT_NEAR(ratios.pull_off, 1.0, 0.07);
    EXPECT_NEAR(ratios.work, 1.0, 0.2);
  }
}

TEST(Decision, isByTheFlatteningRatioThatIsPublishedInHumidAirToo) {
  Options options = elastic(100e9);
  options.capillary.relative_humidity = 0.5;
  const auto predicted = [&](double amplitude) {
    return AdhesionModel(options).predict(analytic::sine(64, 64, 1e-9, 1e-9, amplitude, 1, 0));
  };
  const double amplitude = 0.5e-9;
  const double ratio = predicted(amplitude).flattening_ratio;
  for (const double wanted : {0.74, 0.76}) {
    const Prediction prediction = predicted(amplitude * std::sqrt(wanted / ratio));
    EXPECT_NEAR(prediction.flattening_ratio, wanted, 1e-9);
    EXPECT_EQ(prediction.is_conforming, wanted < 0.75);
  }
}

/// Egg boxes of this amplitude [m] and wavelength [pixels], 64 x 64 of them, up to `rough_cols`
/// columns and `rough_rows` rows; the rest is a hundredth of them, at another level [m].
HeightMap roughBesideSmooth(double amplitude, double wave, int rough_rows, int rough_cols,
                            double level, double pitch) {
  cv::Mat1d heights(64, 64);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double rough =
          amplitude * std::cos(2.0 * kPi * row / wave) * std::cos(2.0 * kPi * col / wave);
      heights(row, col) = row < rough_rows && col < rough_cols ? rough : level + 0.01 * rough;
    }
  }
  return HeightMap(heights, pitch, pitch);
}

TEST(ChangingTexture, aSmoothPlaceThatClosesByItselfIsDoubted) {
  const Options options = elastic(40e9);
  // as a whole far from bonding; the smooth part holds four times what the contacts of the rough
  // one do
  const HeightMap surface = roughBesideSmooth(1e-9, 12, 38, 64, 0.6e-9, 2e-9);
  const Prediction prediction = AdhesionModel(options).predict(surface);
  EXPECT_GT(prediction.flattening_ratio, 10.0);
  EXPECT_LT(againstHalfSpace(surface, options).pull_off, 0.3);
  EXPECT_NE(prediction.model.doubt, nullptr);
}

TEST(ChangingTexture, aForceThatHangsOnWhatContactsCarryIsDoubted) {
  const Options options = elastic(40e9);
  // the smooth part comes near, but does not close
  const HeightMap surface = roughBesideSmooth(0.3e-9, 8, 38, 64, 0.0, 2e-9);
  EXPECT_LT(againstHalfSpace(surface, options).pull_off, 0.6);
  EXPECT_NE(AdhesionModel(options).predict(surface).model.doubt, nullptr);
}

TEST(ChangingTexture, aSmoothPlaceOutOfReachIsNot) {
  const Options options = elastic(40e9);
  const HeightMap surface = roughBesideSmooth(1e-9, 12, 38, 64, 0.0, 2e-9);
  EXPECT_NEAR(againstHalfSpace(surface, options).pull_off, 1.0, 0.1);
  EXPECT_EQ(AdhesionModel(options).predict(surface).model.doubt, nullptr);
}

TEST(ChangingTexture, bondedSurfacesAreDoubtedWhereAPartIsRougher) {
  const Options options = elastic(20e9);
  const HeightMap changing = roughBesideSmooth(0.6e-9, 16, 26, 26, 0.0, 3e-9);
  const Prediction prediction = AdhesionModel(options).predict(changing);
  EXPECT_TRUE(prediction.is_conforming);
  EXPECT_GT(againstHalfSpace(changing, options).pull_off, 1.3);
  EXPECT_NE(prediction.model.doubt, nullptr);
  const Prediction alike =
      AdhesionModel(options).predict(roughBesideSmooth(0.15e-9, 16, 64, 64, 0.0, 1e-9));
  EXPECT_TRUE(alike.is_conforming);
  EXPECT_EQ(alike.model.doubt, nullptr);
}

TEST(ChangingTexture, framesOfAnyShapeAndWithHolesArePredicted) {
  const Options options = elastic(40e9);
  const double range = rangeOf(options);
  for (const cv::Size size :
       {cv::Size(1, 300), cv::Size(300, 1), cv::Size(9, 9), cv::Size(40, 300), cv::Size(64, 64)}) {
    cv::Mat1d heights(size);
    for (int row = 0; row < size.height; ++row) {
      for (int col = 0; col < size.width; ++col) {
        heights(row, col) = range * ((col < size.width / 2) ? 0.01 : 1.0) * std::sin(1.1 * row) *
                            std::cos(0.7 * col);
        if (size.height > 20 && size.width > 20 && row < size.height / 2 && col < size.width / 4) {
          heights(row, col) = std::nan("");
        }
      }
    }
    const Prediction prediction = AdhesionModel(options).predict(HeightMap(heights, 2e-9, 1e-9));
    EXPECT_GT(prediction.pull_off_force, 0.0) << size;
  }
}

TEST(LongWaves, ofSurfacesThatOnlyWaterBondsMayTearThemToo) {
  // waves of 502 nm; sawn ones, as dunes, hold half as much by the half-space at 30 %
  const HeightMap waves = analytic::sine(64, 128, 7.84e-9, 7.84e-9, 0.825e-9, 2);
  Options options = elastic(45.6e9);
  options.interface.work_of_adhesion = 0.01327;
  options.interface.hamaker_constant = 4.02e-20;
  EXPECT_FALSE(AdhesionModel(options).predict(waves).is_conforming);
  for (const double humidity : {0.3, 0.7}) {
    options.capillary.relative_humidity = humidity;
    const Prediction prediction = AdhesionModel(options).predict(waves);
    EXPECT_TRUE(prediction.is_conforming) << humidity;
    EXPECT_EQ(prediction.model.doubt != nullptr, humidity < 0.5) << humidity;
  }
}

TEST(LongWaves, thatMayTearBondedSurfacesAreDoubted) {
  // spheres side by side: it tears at the cusps between them
  const Options options = elastic(25e9);
  const HeightMap spheres = analytic::sphereArray(96, 96, 3e-9, 3e-9, {2.5e-6}, 3, 3);
  const Prediction prediction = AdhesionModel(options).predict(spheres);
  ASSERT_TRUE(prediction.is_conforming);
  EXPECT_NE(prediction.model.doubt, nullptr);
  EXPECT_GT(againstHalfSpace(spheres, options).pull_off, 1.2);
  // hardly any relief: nothing tears, though a crack would have room
  const HeightMap flat = analytic::sine(96, 96, 3e-9, 3e-9, 0.02e-9, 1, 0);
  EXPECT_EQ(AdhesionModel(options).predict(flat).model.doubt, nullptr);
  EXPECT_NEAR(againstHalfSpace(flat, options).pull_off, 1.0, 0.1);
}

}  // namespace
}  // namespace mems_stiction
