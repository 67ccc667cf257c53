/// Whatever the settings, margin, interval and word of a device are those of the one distribution
/// of its force in every message that states them: restoring force over force, quantile by
/// quantile.

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "device/device_evidence.hpp"
#include "errors/one_line.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "ros/device_force_conversion.hpp"
#include "ros/device_verdict_topic.hpp"
#include "ros/message_parts.hpp"
#include "ros/prediction_conversion.hpp"
#include "surface/gaussian_surface.hpp"
#include "verdict/finding.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {
namespace {

constexpr int kCases = 16;
constexpr double kRoundingOfRatios = 1e-12;  // of a few products

/// Fine enough for its waves, so that few verdicts are unknown.
HeightMap scanOf(int seed, double rms_height) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 72;
  options.pitch_x = options.pitch_y = 10e-9;
  options.rms_height = rms_height;
  options.correlation_length_x = options.correlation_length_y = 120e-9;
  options.seed = seed;
  return gaussianSurface(options);
}

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}

  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  double byRatio(double least, double most) {
    return std::exp(between(std::log(least), std::log(most)));
  }
  int oneOf(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }

 private:
  std::mt19937 engine_;
};

/// A spring, or a cantilever that is pulled open or peeled.
Configuration drawnConfiguration(Draw& draw, double scan_area) {
  Configuration configuration;
  configuration.model.interface.work_of_adhesion = draw.byRatio(0.01, 0.2);
  configuration.model.load.mechanical_load = draw.oneOf(2) * draw.byRatio(1e-9, 1e-7);
  configuration.model.lower.hardness = draw.byRatio(3e9, 3e10);
  UncertaintyOptions& uncertainty = configuration.uncertainty;
  uncertainty.work_of_adhesion = draw.between(0.0, 0.8);
  uncertainty.youngs_modulus = draw.between(0.0, 0.2);
  uncertainty.scan_sampling = draw.oneOf(2) == 0;
  uncertainty.samples = 20 + draw.oneOf(400);
  uncertainty.seed = draw.oneOf(1000);
  DeviceForceOptions& made = configuration.device_force;
  made.realisations = 3 + draw.oneOf(3);
  made.max_cells = 1e4;
  made.seed = draw.oneOf(1000);
  DeviceOptions& device = configuration.device;
  device.contact_area = scan_area * draw.byRatio(0.2, 20.0);
  device.contacts = 1 + draw.oneOf(3);
  if (draw.oneOf(2) == 0) {
    device.travel = 1e-6;
    device.spring_stiffness = draw.byRatio(1e-3, 10.0);
  } else {
    device.beam_type = BeamType::kCantilever;
    device.beam_length = draw.byRatio(1e-5, 3e-4);
    // the contact reaches over a share of the length
    device.beam_width = device.contact_area / (draw.byRatio(0.005, 0.9) * device.beam_length);
    device.beam_thickness = 2e-7;  // short against the contact, so that some peel
    device.beam_gap = 2e-6;
    device.beam_modulus = 160e9;
  }
  configuration.check();
  return configuration;
}

struct Judged {
  Configuration configuration;
  Prediction prediction;
  DeviceForce force;
  Verdict verdict;
};

Judged judgedScan(const HeightMap& scan, const Configuration& configuration) {
  Judged judged{configuration, {}, {}, {}};
  ScanPredictor predictor(configuration);
  const PreparedScan prepared = predictor.preparer().prepare(scan);
  judged.prediction = predictor.predict(prepared);
  const Evidence evidence = evidenceOfScan(prepared, configuration, {}, &judged.force);
  judged.verdict = verdictOf(judged.prediction, configuration.device, configuration.uncertainty,
                             onFrame(configuration.model, configuration.device, prepared.surfaces),
                             scan.cellArea(), evidence);
  return judged;
}

/// What the distribution allows to say; an objection may make a "no" unknown.
Sticks wordOfInterval(double lowest, double upper) {
  return upper < 1.0 ? Sticks::kYes : lowest > 1.0 ? Sticks::kNo : Sticks::kMarginal;
}

void expectRatio(double value, double expected, const std::string& what) {
  EXPECT_NEAR(value / expected, 1.0, kRoundingOfRatios) << what;
}

/// The verdict's figures are the quantiles of the force's samples.
void expectOneDistribution(const Judged& judged) {
  const DeviceForce& force = judged.force;
  const Verdict& verdict = judged.verdict;
  const auto quantileOf = [](double median, const std::vector<double>& factors, double share) {
    return median * quantile(factors, share);
  };
  const double weakest = quantileOf(force.pull_off_force, force.force_factors, kLowerShare);
  const double strongest = quantileOf(force.pull_off_force, force.force_factors, kUpperShare);
  expectRatio(force.pull_off_force_lower, weakest, "lower end of the force");
  expectRatio(force.pull_off_force_upper, strongest, "upper end of the force");
  expectRatio(verdict.margin, verdict.restoring_force / force.pull_off_force, "margin");
  expectRatio(verdict.margin_lower, verdict.restoring_force / strongest, "lower end of the margin");
  expectRatio(verdict.margin_upper, verdict.restoring_force / weakest, "upper end of the margin");
  double lowest = std::min(verdict.margin_lower, verdict.margin_transition);
  double upper = verdict.margin_upper;
  if (judged.configuration.device.hasBeam()) {
    const double work = force.apparent_work_of_adhesion;
    const double least = quantileOf(work, force.work_factors, kLowerShare);
    const double most = quantileOf(work, force.work_factors, kUpperShare);
    expectRatio(verdict.peel_number_lower, verdict.peel_number * work / most, "lower peel number");
    expectRatio(verdict.peel_number_upper, verdict.peel_number * work / least, "upper peel number");
    if (verdict.governed_by == kGovernedByPeeling) {
      lowest = verdict.peel_number_lower;
      upper = verdict.peel_number_upper;
    }
  }
  const Sticks word = wordOfInterval(lowest, upper);
  const bool has_objection = verdict.reason.find("; but ") != std::string::npos;
  EXPECT_EQ(verdict.sticks, word == Sticks::kNo && has_objection ? Sticks::kUnknown : word)
      << verdict.reason;
}

/// A ratio with its interval: the verdict's, or none.
void expectFigure(double value, double expected, bool is_stated, const std::string& what) {
  if (is_stated && !std::isnan(expected)) {
    EXPECT_EQ(value, expected) << what;
  } else {
    EXPECT_TRUE(std::isnan(value)) << what;
  }
}

template <typename Message>
void expectMargin(const Message& message, const Verdict& verdict, bool is_stated,
                  const std::string& what) {
  expectFigure(message.margin, verdict.margin, is_stated, what);
  expectFigure(message.margin_lower, verdict.margin_lower, is_stated, what);
  expectFigure(message.margin_upper, verdict.margin_upper, is_stated, what);
}

template <typename Message>
void expectPeelNumber(const Message& message, const Verdict& verdict, bool is_stated,
                      const std::string& what) {
  expectFigure(message.peel_number, verdict.peel_number, is_stated, what);
  expectFigure(message.peel_number_lower, verdict.peel_number_lower, is_stated, what);
  expectFigure(message.peel_number_upper, verdict.peel_number_upper, is_stated, what);
}

/// Both ratios side by side, and which one governs.
template <typename Message>
void expectSameVerdict(const Message& message, const Verdict& verdict, const std::string& what) {
  EXPECT_EQ(static_cast<Sticks>(message.sticks), verdict.sticks) << what;
  EXPECT_EQ(message.governed_by, verdict.governed_by) << what;
  expectMargin(message, verdict, true, what);
  expectPeelNumber(message, verdict, true, what);
}

/// PartVerdict has no governed_by: it states the ratio that governs alone.
void expectSamePart(const PartVerdict& message, const Verdict& verdict) {
  EXPECT_EQ(static_cast<Sticks>(message.sticks), verdict.sticks);
  expectMargin(message, verdict, verdict.governed_by != kGovernedByPeeling, "PartVerdict");
  expectPeelNumber(message, verdict, verdict.governed_by != kGovernedByForce, "PartVerdict");
}

void expectSameInMessages(const Judged& judged) {
  const Verdict& verdict = judged.verdict;
  PredictedScan scan;
  scan.prediction = judged.prediction;
  scan.verdict = verdict;
  const StictionPrediction of_scan = predictionMessage(scan, {});
  expectSameVerdict(of_scan, verdict, "StictionPrediction");
  EXPECT_EQ(of_scan.device_pull_off_force, verdict.device_pull_off_force);
  EXPECT_EQ(of_scan.device_pull_off_force_lower, verdict.device_pull_off_force_lower);
  EXPECT_EQ(of_scan.device_pull_off_force_upper, verdict.device_pull_off_force_upper);
  EXPECT_EQ(of_scan.reason, withoutCommas(verdict.reason));

  DeviceAdhesion of_device = deviceMessage(judged.force, judged.configuration.model.load, {});
  fillVerdict(verdict, of_device);
  expectSameVerdict(of_device, verdict, "DeviceAdhesion");
  expectRatio(of_device.margin_lower * of_device.pull_off_force_upper, verdict.restoring_force,
              "upper end of DeviceAdhesion");
  expectRatio(of_device.margin_upper * of_device.pull_off_force_lower, verdict.restoring_force,
              "lower end of DeviceAdhesion");
  EXPECT_EQ(of_device.reason, withoutCommas(oneLine(verdict.reason)));

  DeviceAnswer answer{{}, verdict, std::nullopt, true};
  const DeviceVerdict said = deviceVerdictMessage(answer, {});
  expectSameVerdict(said, verdict, "DeviceVerdict");
  EXPECT_EQ(said.word, sticksText(verdict.sticks));

  const std::vector<ScanStatement> statements = {statementOf("scan", judged.prediction, verdict)};
  const PooledVerdict part = pooledVerdictOf(statements, verdict);
  expectSamePart(partVerdictMessage(part, {}), verdict);
  answer.part = part;
  const DeviceVerdict of_part = deviceVerdictMessage(answer, {});
  expectSameVerdict(of_part, verdict, "DeviceVerdict of a part");
  EXPECT_EQ(of_part.word, sticksText(verdict.sticks));
}

TEST(OneDistribution, isInEveryMessageWhateverTheSettings) {
  int words[4] = {};
  int peeled = 0;
  for (int number = 0; number < kCases; ++number) {
    Draw draw(static_cast<unsigned>(number));
    const HeightMap scan = scanOf(number, draw.byRatio(1e-9, 6e-9));
    const double area = scan.rows() * scan.cols() * scan.cellArea();
    const Judged judged = judgedScan(scan, drawnConfiguration(draw, area));
    SCOPED_TRACE(number);
    ASSERT_TRUE(judged.force.missing_scan.empty()) << judged.force.missing_scan;
    expectOneDistribution(judged);
    expectSameInMessages(judged);
    ++words[static_cast<int>(judged.verdict.sticks)];
    peeled += judged.verdict.governed_by == kGovernedByPeeling ? 1 : 0;
  }
  // the draws reach every plain word
  for (const Sticks word : {Sticks::kNo, Sticks::kMarginal, Sticks::kYes})
    EXPECT_GT(words[static_cast<int>(word)], 0) << sticksText(word);
  EXPECT_GT(peeled, 0);
}

}  // namespace
}  // namespace mems_stiction
