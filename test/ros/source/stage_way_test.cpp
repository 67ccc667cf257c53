/// What a stage did, by the places of its lines, with an encoder's noise among them.

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "source/stage_way.hpp"

namespace mems_stiction {
namespace {

constexpr double kStep = 20e-6;  // [m]
constexpr std::size_t kLines = 50;

std::vector<double> forth() {
  std::vector<double> places;
  for (std::size_t i = 0; i < kLines; ++i) places.push_back(static_cast<double>(i) * kStep);
  return places;
}

std::vector<double> back() {
  std::vector<double> places = forth();
  std::reverse(places.begin(), places.end());
  return places;
}

std::vector<double> still(double place, std::size_t lines, double noise) {
  static std::mt19937 random(7);
  std::normal_distribution<double> shift(0.0, 1.0);
  std::vector<double> places;
  for (std::size_t i = 0; i < lines; ++i) places.push_back(place + noise * shift(random));
  return places;
}

std::vector<double> joined(const std::vector<std::vector<double>>& parts) {
  std::vector<double> places;
  for (const std::vector<double>& part : parts)
    places.insert(places.end(), part.begin(), part.end());
  return places;
}

StageWay wayOver(const std::vector<double>& places, double line_pitch = 0.0) {
  StageWay way(line_pitch);
  for (const double place : places) way.add(place);
  return way;
}

TEST(StageWay, NoiseIsNoMove) {
  for (int scan = 0; scan < 300; ++scan) {
    for (const std::size_t lines : {1u, 2u, 3u, 5u, 8u, 12u, 25u, 60u, 400u}) {
      const StageWay way = wayOver(still(0.1, lines, 5e-8));
      EXPECT_FALSE(way.hasMoved()) << lines;
      EXPECT_TRUE(way.turns().empty()) << lines;
    }
  }
  EXPECT_FALSE(wayOver(still(0.1, 100, 0.0)).hasMoved());
  EXPECT_FALSE(wayOver(still(0.1, 1000, 3e-6), kStep).hasMoved());
}

TEST(StageWay, LinesAreAMoveWithNoiseBeforeAndBehind) {
  for (const double noise : {0.0, 1e-9, 5e-8, 4e-7}) {
    for (const std::vector<double>& moving : {forth(), back()}) {
      const std::vector<double> places =
          joined({still(moving.front(), 200, noise), moving, still(moving.back(), 200, noise)});
      for (const double line_pitch : {0.0, kStep}) {
        const StageWay way = wayOver(places, line_pitch);
        EXPECT_TRUE(way.hasMoved()) << noise;
        EXPECT_TRUE(way.turns().empty()) << noise;
        EXPECT_EQ(way.fallsFirst(), moving.front() > moving.back());
      }
    }
  }
}

TEST(StageWay, TurnsBehindTheFurthestLine) {
  for (const double line_pitch : {0.0, kStep}) {
    const StageWay way = wayOver(joined({forth(), back(), forth()}), line_pitch);
    EXPECT_EQ(way.turns(), (std::vector<std::size_t>{kLines, 2 * kLines}));
    EXPECT_FALSE(way.fallsFirst());
    EXPECT_TRUE(wayOver(joined({back(), forth()}), line_pitch).fallsFirst());
  }
}

TEST(StageWay, ANoisyStandAtTheTurnIsOneTurn) {
  const StageWay way =
      wayOver(joined({forth(), still((kLines - 1) * kStep, 60, 4e-7), back(), forth()}));
  ASSERT_EQ(way.turns().size(), 2u);
  EXPECT_GE(way.turns()[0], kLines);
  EXPECT_LE(way.turns()[0], kLines + 60);
  EXPECT_EQ(way.turns()[1], 2 * kLines + 60);
}

TEST(StageWay, AStageThatStandsDoesNotGoOn) {
  StageWay way(0.0);
  for (const double place : forth()) EXPECT_TRUE(way.add(place));
  for (const double place : still((kLines - 1) * kStep, 60, 5e-8)) EXPECT_FALSE(way.add(place));
  StageWay turning = wayOver(forth());
  int went_on = 0;
  for (const double place : back()) went_on += turning.add(place) ? 1 : 0;
  EXPECT_GE(went_on, static_cast<int>(kLines) - 6);
}

TEST(Slacks, AreOfTheWayBackAlone) {
  const double backlash = 2.5 * kStep;
  std::vector<double> lagging = back();
  for (double& place : lagging) place -= backlash;
  for (const double line_pitch : {0.0, kStep}) {
    const std::vector<double> forward = slacks(forth(), backlash, line_pitch);
    EXPECT_EQ(*std::max_element(forward.begin(), forward.end()), 0.0);
    const std::vector<double> both = slacks(joined({forth(), lagging}), backlash, line_pitch);
    for (std::size_t i = 0; i < 2 * kLines; ++i)
      EXPECT_NEAR(both[i], i < kLines ? 0.0 : backlash, 1e-12) << i;
    for (const double slack : slacks(lagging, backlash, line_pitch)) EXPECT_EQ(slack, backlash);
  }
}

TEST(Slacks, NoiseAndEqualPlacesDoNotFlipThem) {
  const double backlash = 5e-5;
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (const double share : {0.5, 0.6}) {  // of a step
    std::vector<double> places = forth();
    for (double& place : places) place += share * kStep * noise(random);
    for (const double line_pitch : {0.0, kStep}) {
      for (const double slack : slacks(places, backlash, line_pitch)) EXPECT_EQ(slack, 0.0);
    }
  }
  std::vector<double> twice = {kLines * kStep};
  for (const double place : back()) twice.insert(twice.end(), {place, place});
  for (const double slack : slacks(twice, backlash, 0.0)) EXPECT_EQ(slack, backlash);
}

TEST(Slacks, HoldTheLinesWhileTheBacklashIsTakenUp) {
  const double backlash = 3.0 * kStep;
  const std::vector<double> places = joined({forth(), back(), forth()});
  const std::vector<double> more = slacks(places, backlash, kStep);
  const double top = (kLines - 1) * kStep;
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LE(places[i] + more[i], top + 1e-12);
    EXPECT_GE(places[i] + more[i], i < kLines ? 0.0 : backlash - 1e-12);
  }
}

}  // namespace
}  // namespace mems_stiction
