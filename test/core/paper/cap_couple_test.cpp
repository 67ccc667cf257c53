#include "paper/cap_couple.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/plain_adhesion_model.hpp"

namespace mems_stiction {
namespace {

using plain::Touch;

constexpr double kNm = 1e-9;
constexpr double kCutoffDistance = 0.165 * kNm;
constexpr double kRoundOff = 1e-9;  // relative, of sums and differences of nanometres
constexpr double kDegree = kPi / 180.0;

std::vector<CapCouple> allCaps(const GapField& field, double approach,
                               Touch touch = Touch::kBelow) {
  const plain::Labelling labelling =
      plain::labelPatches(field, approach, touch, Connectivity::kFour);
  std::vector<CapCouple> caps;
  for (std::size_t i = 0; i < labelling.patches.size(); ++i) {
    PatchCentre centre = boxCentre(labelling.patches[i], field);
    const bool is_inside =
        labelling.labels.at<int>(centre.cell.row, centre.cell.col) == static_cast<int>(i) + 1;
    if (!is_inside) centre = deepestCentre(labelling.patches[i], field);
    caps.push_back(capCouple(labelling.patches[i], field, centre, kCutoffDistance));
  }
  return caps;
}

CapCouple onlyCaps(const GapField& field, double approach, Touch touch = Touch::kBelow) {
  const std::vector<CapCouple> caps = allCaps(field, approach, touch);
  EXPECT_EQ(caps.size(), 1u);
  return caps.at(0);
}

GapField againstPlane(const HeightMap& lower) {
  GapField field;
  field.compute(lower);
  return field;
}

GapField between(const HeightMap& lower, const HeightMap& upper) {
  GapField field;
  field.compute({lower, upper});
  return field;
}

HeightMap frame(const cv::Mat1d& heights_nm, double pitch_x = 10 * kNm, double pitch_y = 10 * kNm) {
  const cv::Mat1d heights = heights_nm * kNm;
  return {heights, pitch_x, pitch_y};
}

HeightMap negative(const HeightMap& surface) {
  const cv::Mat1d heights = -surface.heights();
  return {heights, surface.pitchX(), surface.pitchY()};
}

double radiusOfCaps(double cap_radius, double height) {
  return (cap_radius * cap_radius + height * height) / (2.0 * height);
}

/// Largest relative error of R and of rc over many places on the pixel grid.
struct CapErrors {
  double radius = 0.0;
  double cap_radius = 0.0;
};

CapErrors errorsAt(double pixels_per_radius, double pitch_ratio) {
  constexpr double kRadius = 2e-6;
  const double rc = 50 * kNm;
  const double pitch_x = rc / pixels_per_radius;
  const double pitch_y = pitch_x * pitch_ratio;
  const int cols = static_cast<int>(2.6 * rc / pitch_x) + 3;
  const int rows = static_cast<int>(2.6 * rc / pitch_y) + 4;
  CapErrors errors;
  for (int k = 0; k < 12; ++k) {
    const double shift = k / 12.0;
    const GapField field = againstPlane(analytic::paraboloid(
        rows, cols, pitch_x, pitch_y, kRadius, shift * pitch_x, 0.7 * shift * pitch_y));
    const double apex_gap =
        field.lowerHeight(0) + field.gap(0);  // 0: the level is the highest pixel
    const CapCouple caps = onlyCaps(field, rc * rc / (2 * kRadius) + apex_gap);
    errors.radius = std::max(errors.radius, std::abs(caps.composite_radius / kRadius - 1.0));
    errors.cap_radius = std::max(errors.cap_radius, std::abs(caps.cap_radius / rc - 1.0));
  }
  return errors;
}

class ParaboloidOnFlat : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(PitchRatios, ParaboloidOnFlat, testing::Values(1.0, 1.3, 0.6));

TEST_P(ParaboloidOnFlat, hasItsRadiusOnceItSpansPixels) {
  // the summit lies up to 0.7 px from the cell taken for it: (0.7/n)^2 of the cap's height, and the
  // box's half pixel
  EXPECT_LT(errorsAt(6, GetParam()).radius, 0.12);
  EXPECT_LT(errorsAt(12, GetParam()).radius, 0.06);
  EXPECT_LT(errorsAt(25, GetParam()).radius, 0.03);
  EXPECT_LT(errorsAt(50, GetParam()).radius, 0.015);
}

TEST_P(ParaboloidOnFlat, hasABaseRadiusThatConverges) {
  EXPECT_LT(errorsAt(25, GetParam()).cap_radius, 0.03);
  EXPECT_LT(errorsAt(50, GetParam()).cap_radius, 0.015);
}

TEST(CapCouple, combinesTwoSpheresToTheirCompositeRadius) {
  const double pitch = 2 * kNm;
  for (const double upper_radius : {1e-6, 2e-6, 5e-6}) {
    const HeightMap lower = analytic::paraboloid(81, 80, pitch, 1.2 * pitch, 2e-6);
    const HeightMap upper =
        negative(analytic::paraboloid(81, 80, pitch, 1.2 * pitch, upper_radius));
    const double expected = 1.0 / (1.0 / 2e-6 + 1.0 / upper_radius);  // (5)
    const double rc = 50 * kNm;
    const CapCouple caps = onlyCaps(between(lower, upper), rc * rc / (2 * expected));
    EXPECT_NEAR(caps.composite_radius, expected, 0.03 * expected);           // 25 pixels per rc
    EXPECT_NEAR(caps.height, rc * rc / (2 * expected), 0.05 * caps.height);  // delta_c1 + delta_c2
  }
}

TEST(CapCouple, isTheSameWhicheverSurfaceIsOnTop) {
  const HeightMap lower = analytic::paraboloid(61, 60, 3 * kNm, 3 * kNm, 2e-6);
  const HeightMap upper = negative(analytic::paraboloid(61, 60, 3 * kNm, 3 * kNm, 0.7e-6));
  const CapCouple caps = onlyCaps(between(lower, upper), 1 * kNm);
  const CapCouple turned = onlyCaps(between(negative(upper), negative(lower)), 1 * kNm);
  EXPECT_NEAR(caps.composite_radius, turned.composite_radius, kRoundOff * caps.composite_radius);
  EXPECT_NEAR(caps.height, turned.height, kRoundOff * caps.height);
  EXPECT_EQ(caps.cap_radius, turned.cap_radius);
}

TEST(CapCouple, hasTheSameCapsAgainstAFlatAsAgainstNoSurface) {
  const HeightMap lower = analytic::paraboloid(50, 61, 3 * kNm, 2 * kNm, 2e-6, 1 * kNm, 2 * kNm);
  const CapCouple plain = onlyCaps(againstPlane(lower), 0.7 * kNm);
  const CapCouple on_flat =
      onlyCaps(between(lower, analytic::flat(50, 61, 3 * kNm, 2 * kNm, 1e-6)), 0.7 * kNm);
  EXPECT_NEAR(plain.composite_radius, on_flat.composite_radius, kRoundOff * plain.composite_radius);
  EXPECT_NEAR(plain.tilt(), on_flat.tilt(), 1e-9);
}

TEST(CapCouple, measuresATiltOfTenDegrees) {
  const double pitch = 2 * kNm;
  for (const double azimuth : {0.0, 30.0, 90.0, 135.0, 200.0, 315.0}) {
    const double slope_x = std::tan(10 * kDegree) * std::cos(azimuth * kDegree);
    const double slope_y = std::tan(10 * kDegree) * std::sin(azimuth * kDegree);
    const HeightMap plane =
        analytic::tiltedPlane(75, 80, pitch, 1.5 * pitch, slope_x, slope_y, 3e-7);
    const HeightMap sphere = analytic::sum(
        analytic::paraboloid(75, 80, pitch, 1.5 * pitch, 2e-6, 0.3 * pitch, 0.2 * pitch), plane);
    const CapCouple caps = onlyCaps(between(sphere, plane), 0.6 * kNm);
    EXPECT_NEAR(caps.tilt() / kDegree, 10.0, 0.2) << "azimuth " << azimuth;
    EXPECT_NEAR(caps.cos_tilt, std::cos(caps.tilt()), 1e-12);
    EXPECT_NEAR(caps.composite_radius, 2e-6, 0.05 * 2e-6) << "azimuth " << azimuth;
  }
}

TEST(CapCouple, hasTheTiltOfTheMidSurface) {
  // only the lower surface's neighbourhood is tilted by s over a level plane: the mid-surface by
  // s/2
  cv::Mat1d heights(5, 5, 0.0);
  for (int row = 0; row < 5; ++row) {
    for (int col = 0; col < 5; ++col) heights(row, col) = 1.0 * col;
  }
  heights(2, 2) = 30.0;
  const CapCouple caps = onlyCaps(againstPlane(frame(heights)), 20 * kNm);
  // edges a pixel apart carry half the difference of neighbours two pixels apart: the slope is that
  // of the surface
  EXPECT_NEAR(std::tan(caps.tilt()), 0.5 * 1.0 / 10.0, 1e-9);
}

TEST(CapCouple, countsAHollowSurfaceAsFlat) {
  const double pitch = 2 * kNm;
  const HeightMap sphere = analytic::paraboloid(81, 81, pitch, pitch, 2e-6);
  const HeightMap bowl =
      analytic::paraboloid(81, 81, pitch, pitch, 6e-6);  // z2 falls away from the middle
  const CapCouple caps = onlyCaps(between(sphere, bowl), 0.5 * kNm);
  EXPECT_NEAR(caps.composite_radius, 2e-6, 0.04 * 2e-6);  // kappa2 = 0, not negative
}

TEST(CapCouple, ofOneRaisedPixelFollowsTheFormulas) {
  // edges at half the height, the outline half a pixel beyond the centre on every side
  const CapCouple caps =
      onlyCaps(againstPlane(analytic::flatWithBump(7, 9, 10 * kNm, 16 * kNm, 4 * kNm)), 1 * kNm);
  EXPECT_NEAR(caps.cap_radius, (10 + 16) / 4.0 * kNm, kRoundOff * kNm);
  EXPECT_NEAR(caps.height, 2 * kNm, kRoundOff * kNm);
  EXPECT_NEAR(caps.composite_radius, radiusOfCaps(6.5 * kNm, 2 * kNm),
              kRoundOff * caps.composite_radius);
  EXPECT_EQ(caps.centre.index, 3 * 9 + 4);
  EXPECT_NEAR(caps.tilt(), 0.0, 1e-12);
}

TEST(CapCouple, ofAPlateauHasTheMeanOfBothSides) {
  cv::Mat1d heights(8, 12, 0.0);
  heights(cv::Rect(3, 2, 6, 3)) = 4.0;  // 6 columns, 3 rows
  const CapCouple caps = onlyCaps(againstPlane(frame(heights, 10 * kNm, 16 * kNm)), 1 * kNm);
  EXPECT_NEAR(caps.cap_radius, (6 * 10 + 3 * 16) / 4.0 * kNm, kRoundOff * kNm);
  EXPECT_NEAR(caps.height, 2 * kNm, kRoundOff * kNm);
}

TEST(CapCouple, takesTheDeepestCellWhereTheCentreIsOutside) {
  cv::Mat1d heights(7, 7, 0.0);
  heights(cv::Rect(1, 1, 1, 5)) = 10.0;  // a bent patch: left column and bottom row
  heights(cv::Rect(1, 5, 5, 1)) = 10.0;
  heights(5, 4) = 12.0;
  const CapCouple caps = onlyCaps(againstPlane(frame(heights)), 6 * kNm);
  EXPECT_EQ(caps.centre.index, 5 * 7 + 4);
}

TEST(CapCouple, takesTheDeepestOfTheMiddleCells) {
  cv::Mat1d heights(6, 8, 0.0);
  heights(cv::Rect(2, 2, 4, 2)) = 8.0;  // four columns, two rows: four middle cells
  heights(3, 4) = 9.0;
  heights(3, 5) = 10.0;  // the summit is not one of them
  EXPECT_EQ(onlyCaps(againstPlane(frame(heights)), 5 * kNm).centre.index, 3 * 8 + 4);
  cv::Mat flipped;
  cv::flip(heights, flipped, -1);
  EXPECT_EQ(onlyCaps(againstPlane(frame(flipped)), 5 * kNm).centre.index, 2 * 8 + 3);
}

TEST(CapCouple, takesTheInterferenceWhereTheCentreIsNotTheSummit) {
  cv::Mat1d heights(9, 9, 0.0);
  heights(cv::Rect(2, 2, 5, 5)) = 10.0;
  heights(4, 4) = 5.1;  // a crater: its floor is hardly above the base plane at 5
  const CapCouple caps = onlyCaps(againstPlane(frame(heights)), 6 * kNm);
  EXPECT_EQ(caps.centre.index, 4 * 9 + 4);
  EXPECT_NEAR(caps.height, 5 * kNm,
              0.05 * kNm);  // edges of the crater's rim, if there are any, move the mean little
  EXPECT_NEAR(caps.composite_radius, radiusOfCaps(caps.cap_radius, caps.height),
              kRoundOff * caps.composite_radius);
}

TEST(CapCouple, takesTheInterferenceAlsoWhereTheUpperSurfaceHasALowCap) {
  cv::Mat1d lower(9, 9, 0.0);
  lower(cv::Rect(2, 2, 5, 5)) = 10.0;
  lower(4, 4) = 4.9;  // below the base plane at 5
  cv::Mat1d upper(9, 9, 0.0);
  upper(4, 4) = -0.3;
  const CapCouple caps = onlyCaps(between(frame(lower), frame(upper)), 6 * kNm);
  EXPECT_EQ(caps.centre.index, 4 * 9 + 4);
  EXPECT_NEAR(caps.height, 5 * kNm, 0.05 * kNm);
  EXPECT_NEAR(caps.composite_radius, radiusOfCaps(caps.cap_radius, caps.height),
              kRoundOff * caps.composite_radius);
}

TEST(CapCouple, ofAPlaneHasAFiniteRadius) {
  const CapCouple caps =
      onlyCaps(againstPlane(analytic::flat(20, 30, 10 * kNm, 8 * kNm)), 0.0, Touch::kUpTo);
  EXPECT_NEAR(caps.cap_radius, (30 * 10 + 20 * 8) / 4.0 * kNm, kRoundOff * kNm);
  EXPECT_EQ(caps.height, kCutoffDistance);
  EXPECT_NEAR(caps.composite_radius, radiusOfCaps(caps.cap_radius, kCutoffDistance),
              kRoundOff * caps.composite_radius);
  EXPECT_EQ(caps.tilt(), 0.0);
  EXPECT_EQ(caps.cos_tilt, 1.0);
}

TEST(CapCouple, hasALevelBaseWithFewerThanFourEdges) {
  // a corner pixel has two edges, a border pixel three
  cv::Mat1d heights(6, 6, 0.0);
  heights(0, 0) = 8.0;
  heights(0, 1) = 4.0;
  heights(1, 0) = 1.0;
  const CapCouple corner = onlyCaps(againstPlane(frame(heights)), 1 * kNm);
  EXPECT_EQ(corner.tilt(), 0.0);
  EXPECT_NEAR(corner.height, 8 * kNm - (6 + 4.5) / 2 * kNm, kRoundOff * kNm);

  cv::Mat1d border(6, 6, 0.0);
  border(0, 3) = 8.0;
  border(0, 2) = 2.0;
  EXPECT_EQ(onlyCaps(againstPlane(frame(border)), 1 * kNm).tilt(), 0.0);
}

TEST(CapCouple, hasALevelBaseWithEdgesOnOneLine) {
  // one row: two edges; a stripe across the frame whose edges all lie on one side: many edges on
  // one line
  const CapCouple row =
      onlyCaps(againstPlane(frame((cv::Mat1d(1, 5) << 0.0, 3.0, 9.0, 1.0, 0.0))), 1 * kNm);
  EXPECT_EQ(row.tilt(), 0.0);
  EXPECT_TRUE(std::isfinite(row.composite_radius));
  cv::Mat1d stripe(6, 8, 0.0);
  stripe.row(0) = 5.0;
  stripe(1, 2) = 1.0;
  const CapCouple caps = onlyCaps(againstPlane(frame(stripe)), 1 * kNm);
  EXPECT_EQ(caps.tilt(), 0.0);
  EXPECT_TRUE(std::isfinite(caps.composite_radius));
}

TEST(CapCouple, endsAtTheCellsEdgeAtTheFramesBorder) {
  constexpr double kRadius = 2e-6;
  const double pitch = 2 * kNm;
  const double rc = 60 * kNm;
  const int cols = 60;
  const GapField field = againstPlane(analytic::paraboloid(
      91, cols, pitch, pitch, kRadius, -0.5 * (cols - 1) * pitch));  // cut in half
  const CapCouple caps = onlyCaps(field, rc * rc / (2 * kRadius));
  EXPECT_NEAR(caps.cap_radius, (rc + 0.5 * pitch + 2 * rc) / 4, 0.03 * rc);
}

TEST(CapCouple, endsAtTheCellsEdgeBesideInvalidPixels) {
  const HeightMap bump = analytic::flatWithBump(7, 7, 10 * kNm, 10 * kNm, 4 * kNm);
  const CapCouple open = onlyCaps(againstPlane(bump), 1 * kNm);
  const CapCouple beside = onlyCaps(againstPlane(analytic::withInvalidPixel(bump, 3, 4)), 1 * kNm);
  EXPECT_NEAR(beside.cap_radius, open.cap_radius, kRoundOff * kNm);  // half a pixel either way
  EXPECT_NEAR(beside.height, open.height, kRoundOff * kNm);
  EXPECT_EQ(beside.tilt(), 0.0);  // three edges are left
}

TEST(CapCouple, doesNotDependOnThePlaceInTheFrame) {
  cv::Mat1d heights(400, 500, 0.0);
  const cv::Mat1d patch = (cv::Mat1d(3, 4) << 3, 5, 4, 2, 4, 9, 7, 3, 2, 6, 5, 4);
  patch.copyTo(heights(cv::Rect(2, 3, 4, 3)));
  patch.copyTo(heights(cv::Rect(480, 390, 4, 3)));
  const std::vector<CapCouple> caps =
      allCaps(againstPlane(frame(heights, 10 * kNm, 7 * kNm)), 8 * kNm);
  ASSERT_EQ(caps.size(), 2u);
  EXPECT_NEAR(caps[0].composite_radius, caps[1].composite_radius,
              kRoundOff * caps[0].composite_radius);
  EXPECT_NEAR(caps[0].tilt(), caps[1].tilt(), 1e-9);
  EXPECT_NEAR(caps[0].cap_radius, caps[1].cap_radius, kRoundOff * kNm);
}

/// Hills with and without neighbours, at the frame's border, with a crater, in one line of edges,
/// bent, and without any edge: each is described in its own way.
HeightMap frameOfAllKinds() {
  cv::Mat1d heights(24, 40, 0.0);
  heights.row(0) = 5.0;  // edges on one line
  heights(1, 12) = 1.0;
  heights(4, 0) = 8.0;  // three edges
  heights(4, 5) = 7.0;  // a pixel
  const cv::Mat1d hill = (cv::Mat1d(3, 4) << 3, 5, 4, 2, 4, 9, 7, 3, 2, 6, 5, 4);
  hill.copyTo(heights(cv::Rect(10, 4, 4, 3)));
  heights(cv::Rect(18, 4, 5, 5)) = 10.0;  // with a crater
  heights(6, 20) = 5.1;
  heights(cv::Rect(26, 4, 1, 5)) = 10.0;  // bent
  heights(cv::Rect(26, 8, 5, 1)) = 10.0;
  heights(cv::Rect(34, 6, 3, 2)) = 2.5;
  heights(cv::Rect(2, 14, 3, 3)) = std::numeric_limits<double>::quiet_NaN();
  heights(15, 3) = 6.0;  // without edges
  heights(cv::Rect(8, 14, 6, 3)) = 4.0;
  heights(cv::Rect(20, 14, 8, 6)) = 3.0;
  heights(cv::Rect(21, 15, 4, 4)) = 6.0;
  heights(23, 39) = 4.0;  // two edges
  return frame(heights, 10 * kNm, 16 * kNm);
}

TEST(CapCouple, isFiniteForEveryKindOfPatch) {
  const HeightMap lower = frameOfAllKinds();
  const HeightMap upper = negative(analytic::paraboloid(24, 40, 10 * kNm, 16 * kNm, 100e-6));
  for (const GapField& field : {againstPlane(lower), between(lower, upper)}) {
    const std::vector<CapCouple> all = allCaps(field, 8.5 * kNm);
    ASSERT_EQ(all.size(), 11u);
    for (const CapCouple& caps : all) {
      EXPECT_TRUE(std::isfinite(caps.composite_radius));
      EXPECT_GT(caps.composite_radius, 0.0);
      EXPECT_GT(caps.cap_radius, 0.0);
      EXPECT_GT(caps.height, 0.0);
      EXPECT_GT(caps.cos_tilt, 0.0);
    }
  }
}

TEST(CapCouple, ofAPatchWithoutEdgesHasItsInterferenceForHeight) {
  cv::Mat1d heights(5, 7, 0.0);
  heights(cv::Rect(1, 1, 3, 3)) = std::numeric_limits<double>::quiet_NaN();
  heights(2, 2) = 6.0;
  for (const GapField& field :
       {againstPlane(frame(heights)),
        between(frame(heights), analytic::flatWithBump(5, 7, 10 * kNm, 10 * kNm, kNm))}) {
    const CapCouple caps = onlyCaps(field, 2 * kNm);
    EXPECT_EQ(caps.height, kCutoffDistance);  // all of its gap is one
    EXPECT_EQ(caps.squared_slope, 0.0);
    EXPECT_EQ(caps.cos_tilt, 1.0);
    EXPECT_NEAR(caps.cap_radius, 5 * kNm, kRoundOff * kNm);
  }
}

}  // namespace
}  // namespace mems_stiction
