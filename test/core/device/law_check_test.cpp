#include "device/law_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/gaussian_heights.hpp"
#include "support/holed_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;
constexpr int kSide = 64;

std::vector<HeightMap> scansOf(double rms, int first_seed, int count) {
  std::vector<HeightMap> scans;
  for (int seed = first_seed; seed < first_seed + count; ++seed) {
    scans.emplace_back(gaussianHeights(kSide, kPitch, 50e-9, rms, seed), kPitch, kPitch);
  }
  return scans;
}

LawMisfit misfitOf(const std::vector<HeightMap>& scans, double rms) {
  LawCheck check(Options(), scans, {});
  const int count = static_cast<int>(scans.size());
  for (int round = 0; round < 4; ++round) check.add(scansOf(rms, 100 + round * count, count), {});
  return check.force();
}

TEST(LawCheck, ScansOfTheSameSurfacesHaveNoMisfit) {
  const LawMisfit misfit = misfitOf(scansOf(5e-9, 1, 4), 5e-9);
  EXPECT_GT(misfit.deviation, 0.0);
  EXPECT_LT(std::abs(misfit.difference), 3.0 * misfit.deviation);
  EXPECT_LT(std::abs(misfit.shift()), 0.6 * std::abs(misfit.difference));
}

TEST(LawCheck, ScansThatHoldMoreStronglyHaveOne) {
  const LawMisfit misfit = misfitOf(scansOf(1e-9, 1, 4), 10e-9);
  EXPECT_GT(misfit.difference, 5.0 * misfit.deviation);
  EXPECT_GT(misfit.shift(), 0.5 * misfit.difference);
  EXPECT_LT(misfit.shift(), misfit.difference);
  EXPECT_GT(misfit.shiftDeviation(), 0.2 * misfit.difference);
  EXPECT_FALSE(misfitOf(scansOf(5e-9, 1, 4), 5e-9).fails());
}

TEST(LawCheck, ALawFailsByAFactorOfThreeAndItsMisfitIsContained) {
  const LawMisfit failed{std::log(4.0), 0.05};
  EXPECT_TRUE(failed.fails());
  EXPECT_TRUE((LawMisfit{-std::log(4.0), 0.05}.fails()));
  EXPECT_GT(1.96 * failed.shiftDeviation(), failed.share() * failed.difference);
  EXPECT_FALSE((LawMisfit{std::log(3.1), 0.05}.fails()));
  EXPECT_FALSE((LawMisfit{std::log(4.0), 1.0}.fails())) << "by chance";
}

/// A hole takes the summits of its place away, from the scan and from those that are made like it.
TEST(LawCheck, MadeScansHaveTheHolesOfTheScan) {
  std::vector<HeightMap> scans = scansOf(5e-9, 1, 4);
  for (HeightMap& scan : scans) scan = withRoundHoles(scan, 0.6, 1);
  LawCheck check(Options(), scans, {});
  check.add(scansOf(5e-9, 1, 4), {});  // the same but for the holes
  EXPECT_NEAR(check.force().difference, 0.0, 1e-6);
}

/// Many scans are not all made in each round, and none is left out.
TEST(LawCheck, ManyScansTakeTurns) {
  const LawMisfit all = misfitOf(scansOf(1e-9, 1, 10), 10e-9);
  EXPECT_GT(all.difference, 5.0 * all.deviation);
  EXPECT_NEAR(all.difference, misfitOf(scansOf(1e-9, 1, 4), 10e-9).difference,
              0.5 * all.difference);
}

TEST(LawMisfit, TwoStandardErrorsAreChance) {
  EXPECT_EQ((LawMisfit{0.2, 0.1}).shift(), 0.0);
  EXPECT_EQ((LawMisfit{-0.2, 0.1}).shiftDeviation(), 0.0);
  EXPECT_EQ((LawMisfit{}).shift(), 0.0);
  EXPECT_GT((LawMisfit{0.4, 0.1}).shift(), 0.0);
  EXPECT_LT((LawMisfit{-0.4, 0.1}).shift(), 0.0);
}

}  // namespace
}  // namespace mems_stiction
