#include "device/place_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "device/scan_list.hpp"
#include "errors/short_number.hpp"
#include "support/gaussian_heights.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;
constexpr int kSide = 128;

cv::Mat evenHeights(int seed) { return gaussianHeights(kSide, kPitch, 50e-9, 5e-9, seed); }

NamedScan evenScan(const std::string& name, int seed) {
  return {name, HeightMap(evenHeights(seed), kPitch, kPitch)};
}

/// The block in the second row, third column has this share of the roughness.
NamedScan scanWithPlace(double share) {
  cv::Mat heights = evenHeights(7);
  heights(cv::Rect(64, 32, 32, 32)) *= share;
  return {"patchy", HeightMap(heights, kPitch, kPitch)};
}

PlaceCheck checkOf(const std::vector<NamedScan>& scans,
                   const std::vector<HeightMap>& counter_surface = {}) {
  constexpr int kRounds = 4;
  PlaceCheck check(Options(), areaOf(scans.front().surface), scans, counter_surface);
  const auto madeLike = [](std::size_t count, int seed) {
    std::vector<HeightMap> made;
    for (std::size_t i = 0; i < count; ++i)
      made.push_back(evenScan("", seed + static_cast<int>(i)).surface);
    return made;
  };
  for (int round = 0; round < kRounds; ++round) check.add(madeLike(scans.size(), 100 + 10 * round));
  const bool is_closing = check.find();
  EXPECT_EQ(is_closing, check.closes());
  for (int round = 0; is_closing && round < kRounds; ++round) {
    check.compare(madeLike(scans.size(), 100 + 10 * round),
                  madeLike(counter_surface.size(), 200 + 10 * round));
  }
  return check;
}

/// Of few made scans less is known of what is chance.
TEST(PlaceCheck, EvenScansAreEven) {
  for (int seed = 301; seed < 381; seed += 4) {
    std::vector<NamedScan> scans;
    for (int i = 0; i < 4; ++i) scans.push_back(evenScan("one", seed + i));
    for (const NamedScan& alone : scans) EXPECT_FALSE(checkOf({alone}).isUneven()) << seed;
    const PlaceCheck check = checkOf(scans);
    EXPECT_FALSE(check.isUneven()) << seed << ": " << check.sentence();
    EXPECT_EQ(check.sentence(), "");
    EXPECT_EQ(check.forceExcess(), 0.0);
  }
}

TEST(PlaceCheck, APlaceThatIsSmootherIsNamed) {
  const NamedScan patchy = scanWithPlace(0.1);
  const PlaceTexture smooth = placeTextures(patchy.surface)[6];
  EXPECT_NEAR(std::exp(0.5 * smooth.gradient), 0.1, 0.03);
  const PlaceCheck check = checkOf({evenScan("one", 1), patchy});
  ASSERT_TRUE(check.isUneven());
  const std::string sentence = check.sentence();
  EXPECT_NE(
      sentence.find(
          "patchy: its places differ by more than chance. The 0.32 x 0.32 um about x = 0.8 um, "
          "y = 0.48 um hold most; over the scan's other places their "
          "rms gradient is " +
          shortNumber(std::exp(0.5 * smooth.gradient), 2)),
      std::string::npos)
      << sentence;
}

/// What bonds by itself may hold the device; rough places that hold less are kept apart as in the
/// scan.
TEST(PlaceCheck, OnlyAPlaceThatBondsByItselfHoldsMoreThanItsScan) {
  const PlaceCheck closing = checkOf({evenScan("one", 1), scanWithPlace(0.01)});
  ASSERT_TRUE(closing.closes());
  EXPECT_GT(closing.forceExcess(), std::log(2.0));
  const PlaceCheck rough = checkOf({evenScan("one", 1), scanWithPlace(4.0)});
  ASSERT_TRUE(rough.isUneven());
  EXPECT_FALSE(rough.closes());
  EXPECT_EQ(rough.forceExcess(), 0.0);
}

/// What a plane would close, roughness above keeps apart.
TEST(PlaceCheck, ASmoothPlaceUnderARoughSurfaceDoesNotClose) {
  const PlaceCheck check =
      checkOf({evenScan("one", 1), scanWithPlace(0.01)}, {evenScan("", 5).surface});
  ASSERT_TRUE(check.isUneven());
  EXPECT_FALSE(check.closes());
}

TEST(PlaceCheck, SmallScansHaveNoPlaces) {
  EXPECT_TRUE(
      placeTextures(HeightMap(evenHeights(1)(cv::Rect(0, 0, 64, 64)).clone(), kPitch, kPitch))
          .empty());
  EXPECT_EQ(placeTextures(evenScan("", 1).surface).size(), 16U);
}

/// A tilt is no roughness.
TEST(PlaceCheck, TexturesDoNotDependOnTilt) {
  const cv::Mat heights = evenHeights(3);
  cv::Mat tilted = heights.clone();
  for (int row = 0; row < kSide; ++row) tilted.row(row) += 3e-9 * row;
  const std::vector<PlaceTexture> plain = placeTextures(HeightMap(heights, kPitch, kPitch));
  const std::vector<PlaceTexture> leaning = placeTextures(HeightMap(tilted, kPitch, kPitch));
  ASSERT_EQ(plain.size(), leaning.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(plain[i].gradient, leaning[i].gradient, 1e-9);
    EXPECT_NEAR(plain[i].height, leaning[i].height, 1e-9);
  }
}

}  // namespace
}  // namespace mems_stiction
