/// What one scan may take of the machine.

#include "mems_stiction/configuration/configuration.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

HeightMap noise(int size) {
  cv::Mat heights(size, size, CV_64FC1);
  cv::RNG random(1);
  random.fill(heights, cv::RNG::NORMAL, 0.0, 5e-9);
  return {heights, 10e-9, 10e-9};
}

std::string refusal(ScanPredictor& predictor, const HeightMap& scan) {
  try {
    predictor.predict(scan);
  } catch (const SurfaceError& error) {
    return error.what();
  }
  return "";
}

TEST(ScanLimits, AScanOfMorePixelsIsRefused) {
  Configuration configuration;
  configuration.limits.max_pixels = 32 * 32;
  ScanPredictor predictor(configuration);
  EXPECT_EQ(refusal(predictor, noise(33)),
            "a scan of 33 x 33 pixels is larger than limits/max_pixels = 1024");
  EXPECT_EQ(refusal(predictor, noise(32)), "");
}

TEST(ScanLimits, PixelsAreThoseAfterRefinement) {
  Configuration configuration;
  configuration.limits.max_pixels = 32 * 32;
  configuration.preprocessing.refine.factor = 2;
  ScanPredictor predictor(configuration);
  EXPECT_EQ(refusal(predictor, noise(17)),
            "a scan of 34 x 34 pixels, as refined, is larger than limits/max_pixels = 1024");
  EXPECT_EQ(refusal(predictor, noise(16)), "");
}

TEST(ScanLimits, AScanThatTakesLongerIsGivenUpAndTheNextOneIsPredicted) {
  Configuration configuration;
  configuration.model.formulation = "paper";
  configuration.model.solver.of<PaperOptions>().step = 1e-21;  // so many steps take seconds
  configuration.model.approach.max_steps = 10000000;
  configuration.model.load.mechanical_load = 1e-3;
  configuration.limits.max_time = 0.1;
  ScanPredictor predictor(configuration);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(refusal(predictor, noise(256)).find("given up after 0.1 s (limits/max_time)"),
            std::string::npos);
  // a step takes milliseconds at most; a hundred times the limit leaves room for a busy machine
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));

  configuration.model.solver.of<PaperOptions>().step = 0.0;
  predictor.setOptions(configuration.model);
  configuration.limits.max_time = 0.0;
  ScanPredictor unlimited(configuration);
  const HeightMap small = noise(16);
  EXPECT_EQ(predictor.predict(small).pull_off_force, unlimited.predict(small).pull_off_force);
}

TEST(ScanLimits, AnInnerLimitNeverLengthensAnOuterOne) {
  const TimeLimit outer(0.0, "outer");
  const TimeLimit inner(60.0, "inner");
  EXPECT_THROW(TimeLimit::check(), TimeLimitError);
}

TEST(ScanLimits, AnInnerLimitEndsWithItsBlock) {
  const TimeLimit outer(60.0, "outer");
  {
    const TimeLimit inner(0.0, "inner");
    EXPECT_THROW(TimeLimit::check(), TimeLimitError);
  }
  EXPECT_NO_THROW(TimeLimit::check());
}

TEST(ScanLimits, WhatIsDoneBesideIsDoneWhereTheModelAsksForItsTime) {
  ScanPredictor predictor{Configuration()};
  const PreparedScan scan = predictor.preparer().prepare(noise(64));
  int outer = 0, inner = 0;
  const BesideWork beside([&] { ++outer; });
  predictor.predict(scan);
  EXPECT_GT(outer, 2);
  const int before = outer;
  {
    const BesideWork given_up([&] {
      if (++inner == 3) throw 7;
    });
    EXPECT_THROW(predictor.predict(scan), int);
  }
  EXPECT_EQ(inner, 3);
  EXPECT_EQ(outer, before);
  TimeLimit::check();
  EXPECT_EQ(outer, before + 1);
}

TEST(ScanLimits, WithoutALimitNothingIsOver) { EXPECT_NO_THROW(TimeLimit::check()); }

}  // namespace
}  // namespace mems_stiction
