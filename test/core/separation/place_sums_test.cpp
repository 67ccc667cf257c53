/// Sums over places: those of two tiles at a common height are those of the whole, and a frame's do
/// not depend on the order of the calls.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "separation/frame_sums.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/separation_cases.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

/// One frame, its displacements counted from a common height.
struct Tile {
  Tile(const cv::Mat1d& heights, double top, const Options& options)
      : depth(top - highestOf(heights)) {
    field.compute(HeightMap(heights, 2e-9, 2e-9));
    frame.start(field, options);
  }
  static double highestOf(const cv::Mat1d& heights) {
    return *std::max_element(heights.begin(), heights.end());
  }

  PlaceSums at(double approach, double hold) {
    PlaceSums sums = frame.reach(approach - depth, hold);
    frame.add(approach - depth, hold, sums);
    return sums;
  }

  double depth;  ///< of its highest point below that of all [m]
  GapField field;
  FrameSums frame;
};

Options pressed() {
  Options options = separation_cases::elastic(5e9);
  options.load.voltage = 10.0;
  options.interface.insulator_thickness = 20e-9;
  options.capillary.relative_humidity = 0.5;
  return options;
}

constexpr double PlaceSums::*kSums[] = {
    &PlaceSums::adhesion,  &PlaceSums::electrostatic, &PlaceSums::carried,  &PlaceSums::opened,
    &PlaceSums::weight,    &PlaceSums::soft,          &PlaceSums::loss,     &PlaceSums::loss_alone,
    &PlaceSums::edge_loss, &PlaceSums::edge_slope,    &PlaceSums::capillary};

void expectEqual(const PlaceSums& a, const PlaceSums& b, double relative) {
  EXPECT_EQ(a.contact_count, b.contact_count);
  for (const auto sum : kSums) {
    if (sum == &PlaceSums::capillary) continue;
    EXPECT_NEAR(a.*sum, b.*sum, relative * std::abs(b.*sum));
  }
  // far from contact, cells that water fills are counted by the bucket
  EXPECT_NEAR(a.capillary, b.capillary, 0.01 * b.capillary);
}

TEST(PlaceSums, ofTilesAddUpToThoseOfTheWhole) {
  // spheres of two heights, one row of them in each tile, so that no patch lies across the seam
  cv::Mat1d heights = analytic::sphereArray(80, 120, 2e-9, 2e-9, {300e-9}, 3, 2).heights();
  heights.rowRange(0, 40) -= 0.7e-9;
  const double top = Tile::highestOf(heights);
  const Options options = pressed();
  Tile whole(heights, top, options);
  Tile upper(heights.rowRange(0, 40).clone(), top, options);
  Tile lower(heights.rowRange(40, 80).clone(), top, options);
  for (const double approach : {-0.2e-9, 0.5e-9, 1.5e-9}) {
    SCOPED_TRACE(approach);
    PlaceSums sums = upper.at(approach, 0.1e-9);
    const PlaceSums below = lower.at(approach, 0.1e-9);
    sums.contact_count += below.contact_count;
    for (const auto sum : kSums) sums.*sum += below.*sum;
    const PlaceSums expected = whole.at(approach, 0.1e-9);
    // buckets of the tiles lie elsewhere than those of the whole
    expectEqual(sums, expected, 1e-4);
    EXPECT_GT(expected.weight, 0.0);
  }
}

TEST(PlaceSums, doNotDependOnTheOrderOfTheCalls) {
  GaussianSurfaceOptions surface;
  surface.rows = surface.cols = 64;
  surface.pitch_x = surface.pitch_y = 2e-9;
  surface.rms_height = 1e-9;
  surface.correlation_length_x = surface.correlation_length_y = 20e-9;
  const cv::Mat1d heights = gaussianSurface(surface).heights();
  const Options options = pressed();
  Tile wandering(heights, Tile::highestOf(heights), options);
  for (const double approach : {1e-9, 2e-9, -1e-9, 1.5e-9, 0.5e-9, 1.5e-9}) {
    if (approach == 0.5e-9) wandering.frame.mark();
    Tile fresh(heights, Tile::highestOf(heights), options);
    expectEqual(wandering.at(approach, 0.0), fresh.at(approach, 0.0), 1e-12);
  }
}

}  // namespace
}  // namespace mems_stiction
