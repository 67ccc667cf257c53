/// Scans of one surface by pixels of several sizes: which of them a verdict rests on, in every
/// face.

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "device/device_evidence.hpp"
#include "evaluation/device_prediction.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/plausibility.hpp"
#include "evaluation/scan_flags.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/constants.hpp"
#include "numeric/words.hpp"
#include "station/contact_cycles.hpp"
#include "station/load_sweep.hpp"
#include "surface/tiled_surface.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr double kFinePitch = 5e-9;

SurfaceSpectrum spectrumOf(double hurst, double rolloff, double shortest, double rms_height) {
  SurfaceSpectrum spectrum;
  spectrum.wave_number = {2.0 * kPi / rolloff, 2.0 * kPi / shortest};
  spectrum.density = {1.0, std::pow(shortest / rolloff, 2.0 + 2.0 * hurst)};
  const double scale = rms_height * rms_height / spectrum.variance();
  for (double& density : spectrum.density) density *= scale;
  return spectrum;
}

/// Every so many pixels of a surface, as a scan.
HeightMap scanOfSurface(const SurfaceSpectrum& spectrum, double pitch, int side, int seed) {
  cv::Mat heights(side, side, CV_32FC1);
  TiledSurface(spectrum, side, side, pitch, pitch, static_cast<std::uint64_t>(seed))
      .heights(0, 0, heights);
  return {heights, pitch, pitch};
}

/// Means over so many pixels, as light has them.
HeightMap means(const HeightMap& fine, int factor) {
  cv::Mat coarse;
  cv::resize(fine.heights(), coarse, fine.heights().size() / factor, 0.0, 0.0, cv::INTER_AREA);
  return {coarse, factor * fine.pitchX(), factor * fine.pitchY()};
}

Configuration stated() {
  Configuration configuration;
  configuration.device.spring_stiffness = 10.0;
  configuration.device.travel = 1e-6;
  configuration.device.contact_area = 1e-12;
  configuration.device_force.realisations = 3;
  return configuration;
}

/// As predict_scan, the batch and Python judge a scan.
Verdict judged(const HeightMap& scan, const Configuration& configuration) {
  ScanPredictor predictor(configuration);
  const PreparedScan prepared = predictor.preparer().prepare(scan);
  const Prediction prediction = predictor.predict(prepared);
  std::vector<std::string> warnings =
      predictionWarnings(prepared, configuration, prediction, configuration.model);
  DeviceForce force;
  const Verdict verdict = verdictOf(prediction, configuration.device, configuration.uncertainty,
                                    configuration.model, prepared.surfaces.lower.cellArea(),
                                    evidenceOfScan(prepared, configuration, {}, &force));
  addMissing(force.warnings, warnings);
  const bool is_unresolved = (verdict.regime_flags & kUnresolvedFlag) != 0;
  const auto said = std::count_if(warnings.begin(), warnings.end(), [](const std::string& line) {
    return line.find("what holds") != std::string::npos;
  });
  EXPECT_EQ(said, is_unresolved ? 1 : 0) << "said once";
  EXPECT_EQ(is_unresolved, verdict.reason.find("what holds") != std::string::npos)
      << verdict.reason;
  EXPECT_TRUE(!is_unresolved || verdict.sticks == Sticks::kUnknown);
  return verdict;
}

TEST(CoarseScan, ofLightIsUnknownWhereTheForceMicroscopeIsNot) {
  const SurfaceSpectrum rough = spectrumOf(0.8, 2e-6, 10e-9, 4e-9);
  const HeightMap fine = scanOfSurface(rough, kFinePitch, 512, 1);
  EXPECT_EQ(judged(fine, stated()).regime_flags & kUnresolvedFlag, 0U);
  const HeightMap wide = means(scanOfSurface(rough, 40e-9, 640, 2), 5);
  const Verdict by_light = judged(wide, stated());
  EXPECT_EQ(by_light.sticks, Sticks::kUnknown);
  EXPECT_NE(by_light.reason.find("AFM"), std::string::npos) << by_light.reason;
}

TEST(CoarseScan, isNoneOfASurfaceThatItsPixelsShow) {
  // nothing shorter than 2 um: pixels of 200 nm show it all
  EXPECT_EQ(judged(scanOfSurface(spectrumOf(0.9, 10e-6, 2e-6, 3e-9), 200e-9, 256, 3), stated())
                    .regime_flags &
                kUnresolvedFlag,
            0U);
}

TEST(CoarseScan, isNoFinerByInterpolation) {
  Configuration refining = stated();
  refining.preprocessing.refine.factor = 2;
  const HeightMap coarse = scanOfSurface(spectrumOf(0.8, 2e-6, 10e-9, 4e-9), 80e-9, 128, 4);
  EXPECT_EQ(judged(coarse, refining).sticks, Sticks::kUnknown);
}

/// The word of a sweep, or of cycles, of one scan.
Sticks sweptWord(const PreparedScan& prepared, const Configuration& configuration,
                 const std::optional<MeasuredScan>& scan) {
  return sweepLoads(configuration.model, prepared.model_surfaces, {{0.0}, {0.0}},
                    configuration.device, configuration.uncertainty, {}, {}, scan)
      .rows.front()
      .sticks;
}

Sticks cycledWord(const PreparedScan& prepared, const Configuration& configuration,
                  const std::optional<MeasuredScan>& scan) {
  return cycleContacts(configuration.model, prepared.model_surfaces, 1, configuration.device,
                       configuration.uncertainty, {}, {}, scan)
      .cycles.front()
      .sticks;
}

TEST(CoarseScan, isNoFinerByInterpolationInSweepsAndCycles) {
  Configuration refining = stated();
  refining.device_force.enabled = false;
  refining.preprocessing.refine.factor = 4;
  const HeightMap coarse = scanOfSurface(spectrumOf(0.5, 2e-6, 10e-9, 1e-9), 80e-9, 128, 4);
  refining.device.contact_area = coarse.rows() * coarse.cols() * coarse.cellArea();
  refining.device.spring_stiffness = 1e4;
  EXPECT_EQ(judged(coarse, refining).sticks, Sticks::kUnknown);
  const PreparedScan prepared = ScanPreparer(refining).prepare(coarse);
  const MeasuredScan scan = measuredScan(prepared, refining.model);
  EXPECT_EQ(sweptWord(prepared, refining, scan), Sticks::kUnknown);
  EXPECT_EQ(cycledWord(prepared, refining, scan), Sticks::kUnknown);
  // the refined pixels by themselves seem to show it all
  EXPECT_EQ(sweptWord(prepared, refining, std::nullopt), Sticks::kNo);
  EXPECT_EQ(cycledWord(prepared, refining, std::nullopt), Sticks::kNo);
}

TEST(CoarseScan, ofABluntTipIsUnknownByTheTip) {
  Configuration blunt = stated();
  const HeightMap fine = scanOfSurface(spectrumOf(0.8, 2e-6, 10e-9, 4e-9), kFinePitch, 256, 5);
  EXPECT_EQ(judged(fine, blunt).regime_flags & kUnresolvedFlag, 0U);
  blunt.resolution.tip_radius = 2e-6;
  const Verdict verdict = judged(fine, blunt);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_NE(verdict.reason.find("sharper tip"), std::string::npos) << verdict.reason;
}

TEST(DeviceOfScans, isJudgedAlikeInAnyOrderAndSaysWhichScanALoadPresses) {
  const SurfaceSpectrum rough = spectrumOf(0.8, 2e-6, 10e-9, 4e-9);
  const std::vector<HeightMap> scans = {scanOfSurface(rough, kFinePitch, 128, 10),
                                        scanOfSurface(rough, kFinePitch, 128, 11),
                                        scanOfSurface(rough, kFinePitch, 192, 12)};
  Configuration configuration = stated();
  configuration.model.load.mechanical_load = 1e-6;
  configuration.device_force.realisations = 3;
  const auto judged = [&](const std::vector<int>& order) {
    DevicePredictor predictor(configuration);
    for (const int number : order) {
      predictor.add("scan " + std::to_string(number), scans[static_cast<std::size_t>(number)], {},
                    {});
    }
    DevicePrediction prediction = predictor.predict();
    predictor.judge(prediction, [](const auto& solve) { return solve({}); });
    return prediction;
  };
  const DevicePrediction first = judged({0, 1, 2});
  const auto& warnings = first.force.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.rfind("load/mechanical_load of 1e-06 N presses the area of scan 2,", 0) == 0;
  }));
  for (const std::vector<int>& order : {std::vector<int>{2, 0, 1}, std::vector<int>{1, 2, 0}}) {
    const DevicePrediction other = judged(order);
    EXPECT_EQ(other.force.pull_off_force, first.force.pull_off_force);
    EXPECT_EQ(other.force.warnings, first.force.warnings);
    EXPECT_EQ(other.verdict->margin_lower, first.verdict->margin_lower);
    EXPECT_EQ(other.verdict->reason, first.verdict->reason);
  }
}

TEST(CoarseScan, servesAsAWideOneBesideFineScans) {
  const SurfaceSpectrum rough = spectrumOf(0.8, 2e-6, 10e-9, 4e-9);
  const HeightMap wide = means(scanOfSurface(rough, 40e-9, 512, 6), 5);
  const auto predicted = [&](int fine_scans) {
    DevicePredictor predictor(stated());
    for (int i = 0; i < fine_scans; ++i) {
      predictor.add("fine " + std::to_string(i), scanOfSurface(rough, kFinePitch, 256, 10 + i), {},
                    {});
    }
    predictor.add("wide", wide, {}, {});
    DevicePrediction prediction = predictor.predict();
    predictor.judge(prediction, [](const auto& solve) { return solve({}); });
    return prediction;
  };
  const DevicePrediction alone = predicted(0);
  EXPECT_EQ(alone.verdict->sticks, Sticks::kUnknown);
  EXPECT_NE(alone.verdict->reason.find("the scan does not show what holds"), std::string::npos)
      << alone.verdict->reason;
  ASSERT_FALSE(alone.force.warnings.empty());
  EXPECT_EQ(alone.force.warnings.front(), alone.force.missing_scan);
  const DevicePrediction part = predicted(2);
  EXPECT_NE(part.verdict->sticks, Sticks::kUnknown) << part.verdict->reason;
  EXPECT_EQ(part.force.missing_scan, "");
}

/// The folder of scans that instruments have measured.
TEST(CoarseScan, OfInstrumentsAreThoseOfLightAndOfCoarsePixels) {
  const char* const folder = std::getenv("MEMS_STICTION_SCANS");
  if (folder == nullptr)
    GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
  for (const auto& [name, is_coarse] : {std::pair<const char*, bool>{"di-5.di", false},
                                        {"top-1.top", false},
                                        {"example_ps.tiff", false},
                                        {"opd-1.opd", true},
                                        {"x3p-2.x3p", true},
                                        {"al3d-1.al3d", true}}) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    if (!std::filesystem::exists(path)) continue;
    Configuration configuration = stated();
    configuration.device_force.enabled = false;
    configuration.preprocessing.level.shape = LevelShape::kPlane;
    const HeightMap scan = openScanFile(path.string(), configuration.scan).surface;
    EXPECT_EQ((judged(scan, configuration).regime_flags & kUnresolvedFlag) != 0, is_coarse) << name;
  }
}

}  // namespace
}  // namespace mems_stiction
