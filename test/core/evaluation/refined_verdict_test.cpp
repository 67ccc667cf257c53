/// A verdict on a refined scan: the area that each contact of the device has, and what counts as a
/// pixel.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "support/paper_options.hpp"
#include "surface/gaussian_surface.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr double kRoundOff = 1e-12;  // sums of some ten thousand cells

/// 96 x 128 pixels of 10 nm x 8 nm; a corner of 20 x 30 and one pixel amid are missing.
HeightMap roughScan() {
  GaussianSurfaceOptions options;
  options.rows = 96;
  options.cols = 128;
  options.pitch_x = 10e-9;
  options.pitch_y = 8e-9;
  options.rms_height = 4e-9;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  const HeightMap surface = gaussianSurface(options);
  cv::Mat heights = surface.asDouble().heights().clone();
  heights(cv::Rect(0, 0, 30, 20)).setTo(std::numeric_limits<double>::quiet_NaN());
  heights.at<double>(60, 70) = std::numeric_limits<double>::quiet_NaN();
  return {heights, surface.pitchX(), surface.pitchY()};
}

constexpr double kScannedArea = (96 * 128 - 20 * 30 - 1) * 80e-18;

struct Answer {
  Prediction prediction;
  Verdict verdict;
};

Answer answerWith(int refinement) {
  Configuration configuration = paperConfiguration();
  configuration.preprocessing.refine.factor = refinement;
  configuration.model.load.mechanical_load = 2e-6;
  configuration.device.spring_stiffness = 2.0;
  configuration.device.travel = 1e-6;
  configuration.device.contact_area = 50.0 * kScannedArea;
  configuration.device.contacts = 50;
  const HeightMap scan = roughScan();
  Answer answer;
  answer.prediction = ScanPredictor(configuration).predict(scan);
  answer.verdict = verdictOf(answer.prediction, configuration.device, configuration.uncertainty,
                             configuration.model, scan.cellArea());
  return answer;
}

TEST(RefinedVerdict, scalesFromTheAreaThatWasScanned) {
  for (const int refinement : {1, 2, 3}) {
    const Answer answer = answerWith(refinement);
    ASSERT_EQ(answer.prediction.status, Status::kEquilibrium);
    EXPECT_NEAR(answer.prediction.nominal_area / kScannedArea, 1.0, kRoundOff) << refinement;
    EXPECT_NEAR(answer.verdict.device_pull_off_force / (50.0 * answer.prediction.pull_off_force),
                1.0, kRoundOff);
    EXPECT_NEAR(answer.verdict.margin * 50.0 * answer.prediction.pull_off_force / 2e-6, 1.0,
                kRoundOff);
    EXPECT_LT(answer.verdict.margin_lower, answer.verdict.margin);
  }
}

TEST(RefinedVerdict, judgesContactsByThePixelsThatWereMeasured) {
  const Answer fine = answerWith(3);
  // Most of the adhesion is of contacts of less than 20 measured pixels and more than 20
  // interpolated ones.
  const double measured_cell = 80e-18;
  ASSERT_EQ(regimeFlags(fine.prediction, measured_cell / 9.0) & kResolutionFlag, 0U);
  EXPECT_NE(fine.verdict.regime_flags & kResolutionFlag, 0U);
  EXPECT_NE(answerWith(1).verdict.regime_flags & kResolutionFlag, 0U);
}

}  // namespace
}  // namespace mems_stiction
