/// Flat tops whose heights differ by less than they can be drawn out: what a few punches hold
/// together, by hand, and which surfaces are doubted for it.

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "separation/flat_tops.hpp"
#include "support/sample_frames.hpp"
#include "support/separation_cases.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 128;
constexpr double kPitch = 10e-9;
constexpr double kDepth = 50e-9;  ///< of the plain between posts [m]

/// A square lattice of flat posts, round to a cell.
class Posts {
 public:
  /// - @p depths of the posts, from the highest on, in parts of the reach of one, pi a s/(2 E)
  /// - @p width a/a0 of (S8c): up to 1 a punch holds what its area does
  Posts(const std::vector<double>& depths, double width)
      : law_(separation_cases::elastic(1.0).interface) {
    const int per_side = static_cast<int>(std::lround(std::sqrt(depths.size())));
    const int side = kSide / per_side;
    cv::Mat1d post(side, side, 0.0);
    for (int row = 0; row < side; ++row) {
      for (int col = 0; col < side; ++col) {
        if (std::hypot(row - 0.5 * side, col - 0.5 * side) < 12.0) post(row, col) = 1.0;
      }
    }
    const double area = cv::sum(post)[0] * kPitch * kPitch;
    strength_ = law_.strength() * area;
    const double flaw_length = std::sqrt(area / kPi) / width;
    const double modulus =
        flaw_length * kPi * law_.strength() * law_.strength() / (8.0 * law_.workOfAdhesion());
    options_ = separation_cases::elastic(modulus);
    reach_ = std::sqrt(kPi * area) * law_.strength() / (2.0 * modulus);
    heights_ = cv::Mat1d(kSide, kSide, -kDepth);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const int place = static_cast<int>(i);
      const cv::Rect square(place % per_side * side, place / per_side * side, side, side);
      heights_(square) = post * (kDepth - depths[i] * reach_) - kDepth;
    }
  }

  /// The largest pull of all in contact, in parts of what one holds.
  double together() { return tops().pullTogether() / strength_; }
  double oneByOne() { return tops().pullOneByOne() / strength_; }
  Prediction predicted() const {
    return AdhesionModel(options_).predict(HeightMap(heights_, kPitch, kPitch));
  }

 private:
  FlatTops tops() {
    field_.compute(HeightMap(heights_, kPitch, kPitch));
    frame_.start(field_, options_);
    FlatTops tops;
    tops.start(frame_, reach_);
    return tops;
  }

  ContactTraction law_;
  Options options_;
  double strength_;  ///< of one [N]
  double reach_;     ///< [m]
  cv::Mat1d heights_;
  GapField field_;
  FrameSums frame_;
};

bool areDoubted(const Prediction& prediction) {
  return prediction.model.doubt != nullptr && std::strstr(prediction.model.doubt, "flat tops");
}

TEST(FlatTops, ofOneHeightHoldWhatTheyHoldOneByOne) {
  EXPECT_NEAR(Posts({0.0}, 0.9).together(), 1.0, 1e-6);
  EXPECT_NEAR(Posts({0.0}, 0.9).oneByOne(), 1.0, 1e-6);
  const std::vector<double> nine(9, 0.0);
  EXPECT_NEAR(Posts(nine, 0.9).together(), 9.0, 1e-6);
  EXPECT_NEAR(Posts(nine, 0.9).oneByOne(), 9.0, 1e-6);
  // wider ones part by a crack from their edges: Kendall's force goes with a^(3/2)
  EXPECT_NEAR(Posts({0.0}, 4.0).together(), 0.5, 1e-6);
}

TEST(FlatTops, holdTogetherUpToTheirReach) {
  // the lowest, drawn by e, lets go last of all that it stands below: 1 + 0.8 + 0.6 + 0.4
  EXPECT_NEAR(Posts({0.0, 0.2, 0.4, 0.6}, 0.9).together(), 2.8, 1e-6);
  // farther than e below, it has gone before the highest pulls
  EXPECT_NEAR(Posts({0.0, 0.0, 0.0, 0.99}, 0.9).together(), 3.0, 0.02);
  // one by one the higher ones push before the lowest has let go
  const double one_by_one = Posts({0.0, 0.2, 0.4, 0.6}, 0.9).oneByOne();
  EXPECT_GT(one_by_one, 1.0);
  EXPECT_LT(one_by_one, 1.7);
}

TEST(FlatTops, ofNearlyOneHeightAreDoubted) {
  EXPECT_TRUE(areDoubted(Posts({0.0, 0.2, 0.4, 0.6}, 1.1).predicted()));
  EXPECT_FALSE(areDoubted(Posts({0.0, 0.0, 0.0, 0.0}, 1.1).predicted()));
  EXPECT_FALSE(areDoubted(Posts({0.0}, 1.1).predicted()));
  EXPECT_FALSE(areDoubted(Posts({0.0, 2.0, 4.0, 6.0}, 1.1).predicted()));
}

TEST(FlatTops, areNotThoseOfGaussianRoughness) {
  for (const double modulus : {5e9, 20e9, 80e9}) {
    for (const int seed : {1, 2, 3}) {
      const HeightMap surface = samples::gaussian(128, 128, 4e-9, 4e-9, 1e-9, 20e-9, seed);
      EXPECT_FALSE(areDoubted(AdhesionModel(separation_cases::elastic(modulus)).predict(surface)))
          << modulus << " Pa, seed " << seed;
    }
  }
}

}  // namespace
}  // namespace mems_stiction
