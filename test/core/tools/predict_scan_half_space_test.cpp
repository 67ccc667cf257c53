/// predict_scan --half-space: its record, curve and maps are the library's, it judges the device,
/// it can be interrupted.

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include <opencv2/imgcodecs.hpp>

#include "half_space/half_space_fields.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "support/predict_scan_program.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

/// A sphere on 32 x 32 pixels, so that a solution takes milliseconds; lifted and tilted, so that it
/// must be cleaned.
class PredictScanHalfSpace : public PredictScan {
 protected:
  std::string scan() const {
    cv::Mat heights = analytic::paraboloid(32, 32, kPitch, kPitch, 100e-9).heights().clone();
    for (int row = 0; row < heights.rows; ++row) heights.row(row) += 1e-6 + 0.05e-9 * row;
    writeHeightTiff(folder_.file("scan.tiff"), heights);
    return folder_.file("scan.tiff");
  }

  std::string arguments() const {
    return "-c " +
           folder_.write("c.yaml",
                         "lower: {hardness: 1e9}\nload: {mechanical_load: 1e-7}\npreprocessing: "
                         "{level: plane, refine: "
                         "{factor: 2}}\nhalf_space: {boundary: free, step: 0.5}\n") +
           " --pitch 2e-9 --half-space " + scan();
  }

  /// What the library says of the same.
  SolvedHalfSpace expected() const {
    Configuration configuration;
    configuration.model.lower.hardness = 1e9;
    configuration.model.load.mechanical_load = 1e-7;
    configuration.preprocessing.level.shape = LevelShape::kPlane;
    configuration.preprocessing.refine.factor = 2;
    configuration.half_space.boundary = HalfSpaceBoundary::kFree;
    configuration.half_space.step = 0.5;
    ScanOptions options;
    options.pitch_x = options.pitch_y = kPitch;
    const PreparedScan prepared =
        ScanPreparer(configuration).prepare(readScanFile(scan(), options));
    return HalfSpaceSolver(configuration.half_space)
        .solve(halfSpaceProblem(prepared, configuration.model));
  }

  static constexpr double kPitch = 2e-9;
};

TEST_F(PredictScanHalfSpace, RecordHasTheLibrarysSolution) {
  const SolvedHalfSpace expected = this->expected();
  ASSERT_EQ(expected.status, HalfSpaceStatus::kSolved) << expected.message;
  const Outcome outcome = run("--json " + arguments());
  ASSERT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.errors.empty()) << outcome.errors.front();
  const nlohmann::json record = nlohmann::json::parse(outcome.output);
  std::string without_it = arguments();
  without_it.erase(without_it.find("--half-space"), std::string("--half-space").size());
  const nlohmann::json without = nlohmann::json::parse(run("--json " + without_it).output);
  EXPECT_EQ(record["status"], without["status"]);
  EXPECT_EQ(record["pull_off_force"], without["pull_off_force"]);
  const nlohmann::json half_space = record["half_space"];
  EXPECT_EQ(half_space["status"], "SOLVED");
  EXPECT_EQ(half_space["pull_off_force"].get<double>(), expected.pull_off_force);
  EXPECT_EQ(half_space["contact_area"].get<double>(), expected.contact_area);
  EXPECT_EQ(half_space["contact_fraction"].get<double>(),
            expected.contact_area / (64 * 64 * 1e-18));
  EXPECT_EQ(half_space["mean_gap"].get<double>(), expected.mean_gap);
  EXPECT_EQ(half_space["apparent_work_of_adhesion"].get<double>(), expected.work_of_adhesion);
  EXPECT_EQ(half_space["adhesion_hysteresis"].get<double>(), expected.hysteresis);
  EXPECT_EQ(half_space["contact_stiffness"].get<double>(), expected.contact_stiffness);
  EXPECT_EQ(half_space["is_converged"].get<bool>(), expected.is_converged);
  EXPECT_EQ(half_space["is_resolved"].get<bool>(), expected.is_resolved);
  EXPECT_EQ(half_space["iterations"].get<int>(), expected.newton_steps);
  EXPECT_GT(half_space["processing_time"].get<double>(), 0.0);
  const std::vector<CurvePoint> curve = curveOf(expected);
  ASSERT_EQ(half_space["curve"].size(), curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(half_space["curve"][i]["height"].get<double>(), curve[i].height) << i;
    EXPECT_EQ(half_space["curve"][i]["force"].get<double>(), curve[i].force) << i;
    EXPECT_EQ(half_space["curve"][i]["direction"], word(curve[i].direction)) << i;
  }

  const YAML::Node yaml = YAML::Load(run("--all " + arguments()).output)["half_space"];
  EXPECT_EQ(yaml["pull_off_force"].as<double>(), expected.pull_off_force);
  EXPECT_EQ(yaml["curve"].size(), curve.size());
  EXPECT_EQ(yaml["curve"][0]["direction"].as<std::string>(), "APPROACH");
  EXPECT_FALSE(YAML::Load(run("--all --pitch 20e-9 " + sphere()).output)["half_space"].IsDefined());
}

TEST_F(PredictScanHalfSpace, JudgesTheDeviceAndSaysSo) {
  const auto call = [&](const std::string& half_space) {
    return "--pitch 2e-9 -c " +
           folder_.write(
               "device.yaml",
               "lower: {hardness: 1e9}\nload: {mechanical_load: 1e-7}\n"
               "preprocessing: {level: plane, refine: {factor: 2}}\nhalf_space: {boundary: free, " +
                   half_space +
                   "}\n"
                   // as large as the frame
                   "device: {spring_stiffness: 1e-3, travel: 1e-6, contact_area: 4.096e-15}\n"
                   "device_force: {enabled: false}\n") +
           " " + scan();
  };
  const SolvedHalfSpace expected = this->expected();
  ASSERT_TRUE(expected.is_converged && expected.is_resolved && expected.is_step_converged);
  const nlohmann::json plain = nlohmann::json::parse(run("--json " + call("step: 0.5")).output);
  EXPECT_FALSE(plain.contains("verdict_by"));
  const nlohmann::json record =
      nlohmann::json::parse(run("--json --half-space " + call("step: 0.5")).output);
  EXPECT_EQ(record["pull_off_force"], plain["pull_off_force"]) << "the prediction's figure stays";
  EXPECT_EQ(record["verdict_by"], "half_space");
  EXPECT_EQ(record["reason"].get<std::string>().find("by the half-space: margin "), 0U)
      << record["reason"];
  EXPECT_NEAR(record["margin"].get<double>(), 1e-9 / expected.pull_off_force,
              1e-12 * record["margin"].get<double>());
  EXPECT_EQ(record["device_apparent_work_of_adhesion"].get<double>(), expected.work_of_adhesion);
  const YAML::Node yaml = YAML::Load(run("--all --half-space " + call("step: 0.5")).output);
  EXPECT_EQ(yaml["verdict_by"].as<std::string>(), "half_space");
  EXPECT_EQ(yaml["reason"].as<std::string>(), record["reason"].get<std::string>());

  const nlohmann::json unsolved =
      nlohmann::json::parse(run("--json --half-space " + call("max_states: 10")).output);
  EXPECT_EQ(unsolved["verdict_by"], "prediction");
  for (const char* name :
       {"sticks", "margin", "margin_lower", "device_apparent_work_of_adhesion"}) {
    EXPECT_EQ(unsolved[name], plain[name]) << name;
  }
  const std::string reason = unsolved["reason"].get<std::string>();
  EXPECT_EQ(reason.find(plain["reason"].get<std::string>() + "; the half-space does not count: "),
            0U)
      << reason;
  EXPECT_NE(reason.find("half_space/max_states = 10"), std::string::npos) << reason;
}

TEST_F(PredictScanHalfSpace, ScansWhoseFlagsAskForItAreSolvedAndJudgedByThemselves) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 64;
  options.pitch_x = options.pitch_y = 5e-9;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  options.rms_height = 0.4e-9;
  writeHeightTiff(folder_.file("smooth.tiff"), gaussianSurface(options).heights());
  const auto record = [&](const std::string& arguments, const std::string& half_space) {
    const std::string device =
        "device: {spring_stiffness: 1e-2, travel: 1e-6, contact_area: 1.024e-13}\ndevice_force: "
        "{enabled: false}\n";
    const std::string file =
        folder_.write("flagged.yaml", device + "half_space: {" + half_space + "}\n");
    const Outcome outcome =
        run("--json --pitch 5e-9 -c " + file + " " + arguments + folder_.file("smooth.tiff"));
    EXPECT_EQ(outcome.status, 0);
    nlohmann::json found = nlohmann::json::parse(outcome.output);
    found["errors"] = outcome.errors;
    return found;
  };
  const nlohmann::json flagged = record("", "");
  ASSERT_EQ(flagged["verdict_by"], "half_space");
  const std::string why = "by the half-space, as near_bonding asks for it: margin ";
  EXPECT_EQ(flagged["reason"].get<std::string>().find(why), 0U) << flagged["reason"];
  EXPECT_TRUE(flagged["errors"].empty()) << flagged["errors"];  // progress is for terminals
  const nlohmann::json asked = record("--half-space ", "");
  EXPECT_EQ(flagged["margin"], asked["margin"]);
  EXPECT_EQ(flagged["half_space"]["pull_off_force"], asked["half_space"]["pull_off_force"]);
  EXPECT_EQ(record("", "enabled: true")["reason"], asked["reason"]);

  const nlohmann::json never = record("", "enabled: false");
  EXPECT_FALSE(never.contains("half_space"));
  EXPECT_FALSE(never.contains("verdict_by"));
  const nlohmann::json bounded = record("", "max_flagged_pixels: 2000");
  EXPECT_FALSE(bounded.contains("half_space"));
  EXPECT_EQ(bounded["margin"], never["margin"]);
  const std::string sentence =
      "a frame of 64 x 64 pixels is larger than half_space/max_flagged_pixels = 2000";
  EXPECT_NE(bounded["reason"].get<std::string>().find(sentence), std::string::npos)
      << bounded["reason"];
  ASSERT_EQ(bounded["errors"].size(), 1U);
  EXPECT_NE(bounded["errors"][0].get<std::string>().find("half-space: near_bonding asks for it: " +
                                                         sentence),
            std::string::npos)
      << bounded["errors"];
}

TEST_F(PredictScanHalfSpace, CurveFileHasThePullOffForceAsItsLargestAttraction) {
  const SolvedHalfSpace expected = this->expected();
  ASSERT_EQ(run("--curve " + folder_.file("curve.csv") + " " + arguments()).status, 0);
  std::istringstream lines(ScratchFolder::read(folder_.file("curve.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, kCurveColumns);
  double largest = 0.0;
  double height = 0.0;
  std::size_t count = 0;
  for (; std::getline(lines, line); ++count) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    const double force = std::stod(line.substr(first + 1));
    if (line.compare(second + 1, 11, "RETRACTION,") != 0 || force <= largest) continue;
    largest = force;
    height = std::stod(line);
  }
  EXPECT_EQ(count, expected.approach.size() + expected.retraction.size());
  EXPECT_EQ(largest, expected.pull_off_force);
  EXPECT_EQ(height, expected.pull_off_height);
}

TEST_F(PredictScanHalfSpace, TheFormulationsCurveStandsBesideThatOfTheHalfSpace) {
  const std::string curve = folder_.file("curve.csv");
  const std::string beside = folder_.file("beside.csv");
  const Outcome outcome =
      run("--json --curve " + curve + " --formulation-curve " + beside + " " + arguments());
  ASSERT_EQ(outcome.status, 0);
  const nlohmann::json record = nlohmann::json::parse(outcome.output);
  const auto of_half_space = pointsOf(ScratchFolder::read(curve), "RETRACTION");
  const auto of_formulation = pointsOf(ScratchFolder::read(beside), "RETRACTION");
  EXPECT_EQ(of_half_space.size(), expected().retraction.size());
  const auto highest = [](const std::vector<std::pair<double, double>>& points) {
    return *std::max_element(points.begin(), points.end(), [](const auto& left, const auto& right) {
      return left.second < right.second;
    });
  };
  EXPECT_EQ(highest(of_half_space).second, record["half_space"]["pull_off_force"].get<double>());
  // both count the height from first touch: for a sphere they part within the range of the forces,
  // 0.16 nm
  EXPECT_NEAR(highest(of_half_space).first, highest(of_formulation).first, 0.16e-9);
}

TEST_F(PredictScanHalfSpace, MapFilesAreTheLibrarysMaps) {
  const SolvedHalfSpace expected = this->expected();
  const std::string pressure_file = folder_.file("pressure.tiff");
  const std::string gap_file = folder_.file("gap.tiff");
  const std::string deformed_file = folder_.file("deformed.tiff");
  ASSERT_EQ(run("--half-space-pressure " + pressure_file + " --half-space-gap " + gap_file +
                " --half-space-deformed " + deformed_file + " " + arguments())
                .status,
            0);
  const cv::Mat pressure = cv::imread(pressure_file, cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(pressure, expected.pressure, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(cv::imread(gap_file, cv::IMREAD_UNCHANGED), expected.gap, cv::NORM_INF), 0.0);
  EXPECT_DOUBLE_EQ(cv::countNonZero(pressure > 0.0) * 1e-18, expected.contact_area);
  cv::Mat deformed;
  cv::imread(deformed_file, cv::IMREAD_UNCHANGED).convertTo(deformed, CV_64F);
  // the heights of 1 um less the plane have 10 nm; single precision keeps their 1e-7th part
  EXPECT_LT(cv::norm(deformed, expected.deformed_lower.asDouble().heights(), cv::NORM_INF), 1e-15);
  EXPECT_GT(expected.flowed_volume, 0.0) << "or there is nothing to see";
}

TEST_F(PredictScanHalfSpace, AMapThatThereIsNotIsOneLine) {
  const Outcome outcome = run("--half-space-gap " + folder_.file("gap.tiff") + " -c " +
                              folder_.write("few.yaml", "half_space: {max_states: 10}\n") +
                              " --pitch 2e-9 --half-space " + scan());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.output.empty());
  ASSERT_FALSE(outcome.errors.empty());
  EXPECT_NE(outcome.errors.back().find("gap.tiff: not written"), std::string::npos)
      << outcome.errors.back();
  EXPECT_NE(outcome.errors.back().find("half_space/max_states = 10"), std::string::npos)
      << outcome.errors.back();
}

TEST_F(PredictScanHalfSpace, WhatHasNoSolutionIsNullWithItsReasonOnStandardError) {
  const Outcome outcome =
      run("--json -c " + folder_.write("few.yaml", "half_space: {max_states: 10}\n") +
          " --pitch 2e-9 --half-space " + scan());
  ASSERT_EQ(outcome.status, 0) << "the prediction is as good as without it";
  const nlohmann::json half_space = nlohmann::json::parse(outcome.output)["half_space"];
  EXPECT_EQ(half_space["status"], "TOO_MANY_STATES");
  EXPECT_TRUE(half_space["pull_off_force"].is_null());
  EXPECT_FALSE(half_space["is_converged"].get<bool>());
  EXPECT_GT(half_space["curve"].size(), 0u);
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find("half_space/max_states = 10"), std::string::npos)
      << outcome.errors[0];
}

TEST_F(PredictScanHalfSpace, WhatItCannotBeAskedIsOneLine) {
  const std::string no_adhesion = folder_.write("c.yaml", "interface: {work_of_adhesion: 0}\n");
  const std::string too_small = folder_.write("d.yaml", "half_space: {max_pixels: 1023}\n");
  for (const std::string& configuration : {no_adhesion, too_small}) {
    EXPECT_EQ(run("-c " + configuration + " --pitch 2e-9 " + scan()).status, 0)
        << "without --half-space";
    const Outcome outcome = run("-c " + configuration + " --pitch 2e-9 --half-space " + scan());
    EXPECT_EQ(outcome.status, 2) << configuration;
    EXPECT_EQ(outcome.errors.size(), 1u) << configuration;
    EXPECT_TRUE(outcome.output.empty()) << configuration;
  }
}

TEST_F(PredictScanHalfSpace, InterruptEndsIt) {
  // a minute of work, so that it is interrupted in the middle
  writeHeightTiff(folder_.file("large.tiff"),
                  analytic::paraboloid(1024, 1024, 5e-9, 5e-9, 10e-6).heights());
  const std::string command =
      "timeout --preserve-status -s INT 1 " + std::string(MEMS_STICTION_PREDICT_SCAN) + " -c " +
      folder_.write("fine.yaml", "half_space: {step: 0.01, max_states: 1000000}\n") +
      " --pitch 5e-9 --half-space " + folder_.file("large.tiff") + " >" + folder_.file("out");
  const auto before =
      std::signal(SIGINT, SIG_DFL);  // a shell that put this test into the background ignores it
  const auto begin = std::chrono::steady_clock::now();
  const int status = std::system(command.c_str());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::signal(SIGINT, before);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  EXPECT_LT(seconds, 30.0)
      << "a transform of this frame takes a hundredth of a second; the rest is for busy machines";
  EXPECT_TRUE(ScratchFolder::read(folder_.file("out")).empty());
}

}  // namespace
}  // namespace mems_stiction
