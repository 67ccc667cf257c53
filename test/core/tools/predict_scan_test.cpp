/// The command line as users and scripts call it: the real executable, its output, its exit status.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include <opencv2/imgcodecs.hpp>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/half_space/half_space_fields.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/import/scan_writer.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "mems_stiction/scan/half_space_scan.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

struct Outcome {
  int status = -1;
  std::string output;
  std::vector<std::string> errors;  ///< lines
};

class PredictScan : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    const std::string command = std::string(MEMS_STICTION_PREDICT_SCAN) + " " + arguments + " >" + folder_.file("out") +
                                " 2>" + folder_.file("err");
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.output = ScratchFolder::read(folder_.file("out"));
    std::istringstream errors(ScratchFolder::read(folder_.file("err")));
    for (std::string line; std::getline(errors, line);) outcome.errors.push_back(line);
    return outcome;
  }

  /// A sphere of 2 um in a frame of 2 um, float32 metres.
  std::string sphere(const std::string& name = "sphere.tiff") const {
    writeHeightTiff(folder_.file(name), analytic::paraboloid(101, 101, 20e-9, 20e-9, 2e-6).heights());
    return folder_.file(name);
  }

  ScratchFolder folder_;
};

TEST_F(PredictScan, PrintsTheRecordOfTheCoresPrediction) {
  const std::string scan = sphere();
  const Outcome outcome = run("--pitch 20e-9 --load 1e-6 " + scan);
  ASSERT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.errors.empty()) << outcome.errors.front();
  const YAML::Node record = YAML::Load(outcome.output);

  Configuration configuration;
  configuration.model.load.mechanical_load = 1e-6;
  ScanOptions options;
  options.pitch_x = options.pitch_y = 20e-9;
  const Prediction prediction = ScanPredictor(configuration).predict(readScanFile(scan, options));
  EXPECT_EQ(record["file"].as<std::string>(), scan);
  EXPECT_EQ(record["mechanical_load"].as<double>(), 1e-6);
  EXPECT_EQ(record["pull_off_force"].as<double>(), prediction.pull_off_force);
  EXPECT_EQ(record["contact_area"].as<double>(), prediction.contact_area);
  EXPECT_EQ(record["roughness"]["sq"].as<double>(), prediction.roughness.sq);
}

TEST_F(PredictScan, JsonIsOneObjectPerLine) {
  const std::string scan = sphere();
  const Outcome outcome = run("--json --pitch 20e-9,30e-9 " + scan + " " + scan);
  ASSERT_EQ(outcome.status, 0);
  std::istringstream lines(outcome.output);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const nlohmann::json record = nlohmann::json::parse(line);
    EXPECT_EQ(record["file"], scan);
    EXPECT_EQ(record["pitch_x"].get<double>(), 20e-9);
    EXPECT_EQ(record["pitch_y"].get<double>(), 30e-9);
  }
  EXPECT_EQ(count, 2);
}

TEST_F(PredictScan, ConfigurationFileAndOptionsMeet) {
  const std::string configuration = folder_.write(
      "c.yaml",
      "interface: {insulator_thickness: 100e-9}\nload: {mechanical_load: 1e-6, voltage: 1}\nscan: {pitch_x: "
      "20e-9, pitch_y: 20e-9}\n");
  const YAML::Node record =
      YAML::Load(run("--config " + configuration + " --voltage -5 --step 0.1e-9 " + sphere()).output);
  EXPECT_EQ(record["voltage"].as<double>(), -5.0) << "the option goes before the file";
  EXPECT_EQ(record["mechanical_load"].as<double>(), 1e-6);
  EXPECT_GT(record["electrostatic_force"].as<double>(), 0.0);
}

TEST_F(PredictScan, WritesTheDeformedSurface) {
  const std::string out = folder_.file("deformed.tiff");
  ASSERT_EQ(run("--pitch 20e-9 --load 0.1 --deformed " + out + " " + sphere()).status, 0);
  const cv::Mat deformed = cv::imread(out, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(deformed.type(), CV_32FC1);
  EXPECT_EQ(deformed.size(), cv::Size(101, 101));
  EXPECT_LT(deformed.at<float>(50, 50), 0.0F) << "the apex was at 0 and is flattened";
  EXPECT_EQ(deformed.at<float>(0, 0), cv::imread(sphere(), cv::IMREAD_UNCHANGED).at<float>(0, 0));
}

TEST_F(PredictScan, BadInputIsOneLineAndTheOthersArePredicted) {
  const std::string good = sphere();
  const std::string whole = ScratchFolder::read(good);
  const std::string bad = folder_.write("bad.tiff", whole.substr(0, whole.size() / 2));
  const Outcome outcome = run("--json --pitch 20e-9 " + bad + " " + good + " " + folder_.file("none.png"));
  EXPECT_EQ(outcome.status, 2);
  ASSERT_EQ(outcome.errors.size(), 2u);
  EXPECT_NE(outcome.errors[0].find(bad), std::string::npos) << outcome.errors[0];
  EXPECT_NE(outcome.errors[1].find("none.png: there is no such file"), std::string::npos) << outcome.errors[1];
  EXPECT_EQ(nlohmann::json::parse(outcome.output)["file"], good);
}

TEST_F(PredictScan, BadSettingsAreOneLineEach) {
  const std::string scan = sphere();
  const std::string broken = folder_.write("broken.yaml", "lower: {youngs_modulos: 1e9}\n");
  const std::string printed = folder_.write("printed.yaml", "approach: {formulation: printed}\n");
  for (const std::string& arguments :
       {"--pitch 0 " + scan, "--pitch 2e-9x " + scan, "--pitch 20e-9 --load -1 " + scan,
        "--pitch 20e-9 --voltage 5 " + scan, "--config " + broken + " " + scan, "--config /nonexistent.yaml " + scan,
        "--pitch 20e-9 --deformed x.tiff " + scan + " " + scan, scan,
        "--pitch 20e-9 --half-space --curve x.csv " + scan + " " + scan,
        "--pitch 20e-9 --curve x.csv " + scan + " " + scan,
        "--pitch 20e-9 --curve x.csv --formulation-curve y.csv " + scan,
        "--pitch 20e-9 --record-curve -c " + printed + " " + scan,
        "--pitch 20e-9 --curve x.csv -c " + printed + " " + scan,
        "--pitch 20e-9 --half-space --half-space-gap x.tiff " + scan + " " + scan,
        "--pitch 20e-9 --half-space-pressure x.tiff " + scan}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.errors.size(), 1u) << arguments;
    EXPECT_TRUE(outcome.output.empty()) << arguments;
  }
  EXPECT_EQ(run("").status, 2);
  EXPECT_EQ(run("--no_such_option " + scan).status, 2);
  EXPECT_EQ(run("--load heavy " + scan).status, 2);
}

TEST_F(PredictScan, AFormulationOfEarlierVersionsIsRefusedWithWhatServesInstead) {
  const std::string old = folder_.write("old.yaml", "approach: {formulation: corrected}\n");
  const Outcome outcome = run("--pitch 20e-9 --config " + old + " " + sphere());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.output.empty());
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find("must be one of: "), std::string::npos) << outcome.errors[0];
  EXPECT_NE(outcome.errors[0].find("'corrected' is no longer there: "), std::string::npos) << outcome.errors[0];
}

TEST_F(PredictScan, UnitSlipsAreWarnedOfOnStandardError) {
  const Outcome outcome = run("--pitch 20 " + sphere());
  EXPECT_EQ(outcome.status, 0);
  ASSERT_FALSE(outcome.errors.empty());
  EXPECT_NE(outcome.errors[0].find("warning: pitch_x 20 m"), std::string::npos) << outcome.errors[0];
  EXPECT_EQ(outcome.output.find("warning"), std::string::npos);
}

TEST_F(PredictScan, ConvergenceIsAListInBothFormatsAndATableForPeople) {
  const std::string call = "--convergence --pitch 20e-9 --load 1e-5 " + sphere();
  const Outcome json = run("--json " + call);
  ASSERT_EQ(json.status, 0);
  const nlohmann::json record = nlohmann::json::parse(json.output);
  ASSERT_EQ(record["convergence"].size(), 3u);
  EXPECT_EQ(record["convergence"][2]["decimation"], 4);
  EXPECT_EQ(record["convergence"][2]["cols"], 25);
  EXPECT_EQ(record["is_resolution_limited"].type(), nlohmann::json::value_t::boolean);

  const Outcome yaml = run(call);
  EXPECT_NE(yaml.output.find("# half "), std::string::npos) << yaml.output;
  const YAML::Node document = YAML::Load(yaml.output);
  EXPECT_EQ(document["convergence"][1]["pull_off_force"].as<double>(),
            record["convergence"][1]["pull_off_force"].get<double>());
}

/// Height [m] and force [N] of the points of one direction, in the order of the file.
std::vector<std::pair<double, double>> pointsOf(const std::string& csv, const std::string& direction) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "height,force,direction");
  std::vector<std::pair<double, double>> points;
  while (std::getline(lines, line)) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    if (line.substr(second + 1) == direction) {
      points.emplace_back(std::stod(line), std::stod(line.substr(first + 1, second - first - 1)));
    }
  }
  return points;
}

TEST_F(PredictScan, TheFormulationsCurveGoesToRestAndBackOverTheHalfSpacesHeight) {
  const std::string file = folder_.file("curve.csv");
  const Outcome outcome = run("--json --record-curve --pitch 20e-9 --curve " + file + " " + sphere());
  ASSERT_EQ(outcome.status, 0);
  const nlohmann::json record = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(record["formulation"], "consistent");
  const auto approach = pointsOf(ScratchFolder::read(file), "APPROACH");
  const auto retraction = pointsOf(ScratchFolder::read(file), "RETRACTION");
  ASSERT_EQ(approach.size(), record["curve"].size());
  const double range = std::sqrt(65e-21 / (16.0 * kPi * 0.05));  // z0 of the default interface
  for (std::size_t i = 0; i < approach.size(); ++i) {
    // numbers are written so that they read back as they were; the difference is rounded once
    EXPECT_NEAR(approach[i].first, range - record["curve"][i]["displacement"].get<double>(), 1e-22) << i;
    EXPECT_EQ(approach[i].second, record["curve"][i]["force"].get<double>()) << i;
  }
  EXPECT_EQ(std::vector(approach.rbegin(), approach.rend()), retraction) << "nothing flows";
  double largest = 0.0;
  for (const auto& point : retraction) largest = std::max(largest, point.second);
  // the pull-off force is the summit of a parabola through the highest points
  EXPECT_NEAR(largest / record["pull_off_force"].get<double>(), 1.0, 0.02);
  EXPECT_LT(retraction.front().first, range) << "at rest contacts are pressed in";
}

TEST_F(PredictScan, AStatedDeviceIsJudged) {
  const std::string device =
      folder_.write("d.yaml", "device: {spring_stiffness: 1.0, travel: 1.0e-6, contact_area: 1.0e-12}\n");
  const std::string call = " --pitch 20e-9 " + sphere();
  const YAML::Node record = YAML::Load(run("-c " + device + call).output);
  const double scale = 1e-12 / record["nominal_area"].as<double>();
  EXPECT_DOUBLE_EQ(record["margin"].as<double>(), 1e-6 / (record["pull_off_force"].as<double>() * scale));
  EXPECT_LT(record["margin_lower"].as<double>(), record["margin"].as<double>());
  EXPECT_GT(record["margin_upper"].as<double>(), record["margin"].as<double>());
  EXPECT_FALSE(record["sticks"].as<std::string>().empty());
  EXPECT_FALSE(record["reason"].as<std::string>().empty());
  EXPECT_NE(record["regime_flag_names"].as<std::string>().find("few_contacts"), std::string::npos);
  const YAML::Node without = YAML::Load(run(call).output);
  EXPECT_FALSE(without["margin"].IsDefined());
  EXPECT_EQ(without["regime_flags"].as<unsigned>(), record["regime_flags"].as<unsigned>());
}

TEST_F(PredictScan, CleaningsAreAListWithTheirSpread) {
  const Outcome outcome = run("--cleanings --pitch 20e-9 " + sphere());
  ASSERT_EQ(outcome.status, 0);
  const YAML::Node record = YAML::Load(outcome.output);
  ASSERT_EQ(record["cleanings"].size(), 9u);
  EXPECT_EQ(record["cleanings"][0]["cleaning"].as<std::string>(), "as configured");
  EXPECT_EQ(record["cleanings"][0]["pull_off_force"].as<double>(), record["pull_off_force"].as<double>());
  EXPECT_GE(record["cleaning_spread"]["pull_off_factor"].as<double>(), 1.0);
  EXPECT_NE(outcome.output.find("# Over "), std::string::npos);
}

TEST_F(PredictScan, CleaningsWidenTheMargin) {
  const std::string call =
      "-c " + folder_.write("d.yaml", "device: {spring_stiffness: 1.0, travel: 1e-6, contact_area: 4.0804e-12}\n") +
      " --pitch 20e-9 " + sphere();
  const YAML::Node plain = YAML::Load(run(call).output);
  const YAML::Node record = YAML::Load(run("--cleanings " + call).output);
  ASSERT_GT(record["cleaning_spread"]["pull_off_factor"].as<double>(), 1.0);
  EXPECT_EQ(record["margin"].as<double>(), plain["margin"].as<double>());
  const auto span = [](const YAML::Node& of) {
    return of["margin_upper"].as<double>() / of["margin_lower"].as<double>();
  };
  EXPECT_GT(span(record), span(plain));
  EXPECT_NE(record["reason"].as<std::string>().find("(cleaning included)"), std::string::npos);
  EXPECT_EQ(plain["reason"].as<std::string>().find("cleaning"), std::string::npos);
}

TEST_F(PredictScan, TheRecordSaysHowTheScanWasCleanedAndHowFarItsRoughnessReaches) {
  const std::string configuration = folder_.write(
      "c.yaml", "preprocessing: {level: plane, tip: {radius: 50e-9}}\noutput: {spatial_roughness: true}\n");
  const YAML::Node record = YAML::Load(run("-c " + configuration + " --pitch 20e-9 " + sphere()).output);
  ASSERT_EQ(record["preprocessing"].size(), 2u);
  EXPECT_EQ(record["preprocessing"][0]["step"].as<std::string>(), "tip");
  EXPECT_EQ(record["preprocessing"][1]["parameters"].as<std::string>(), "shape=plane robust=false");
  EXPECT_TRUE(record["tip_unreached_fraction"].IsDefined());
  EXPECT_GT(record["roughness"]["sal"].as<double>(), 0.0);
  EXPECT_FALSE(YAML::Load(run("--pitch 20e-9 " + sphere()).output)["roughness"]["sal"].IsDefined());
}

/// A sphere on 32 x 32 pixels, so that a solution takes milliseconds; lifted and tilted, so that it must be cleaned.
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
                         "lower: {hardness: 1e9}\nload: {mechanical_load: 1e-7}\npreprocessing: {level: plane, refine: "
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
    const PreparedScan prepared = ScanPreparer(configuration).prepare(readScanFile(scan(), options));
    return HalfSpaceSolver(configuration.half_space).solve(halfSpaceProblem(prepared, configuration.model));
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
  EXPECT_EQ(half_space["contact_fraction"].get<double>(), expected.contact_area / (64 * 64 * 1e-18));
  EXPECT_EQ(half_space["mean_gap"].get<double>(), expected.mean_gap);
  EXPECT_EQ(half_space["apparent_work_of_adhesion"].get<double>(), expected.work_of_adhesion);
  EXPECT_EQ(half_space["adhesion_hysteresis"].get<double>(), expected.hysteresis);
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

  const YAML::Node yaml = YAML::Load(run(arguments()).output)["half_space"];
  EXPECT_EQ(yaml["pull_off_force"].as<double>(), expected.pull_off_force);
  EXPECT_EQ(yaml["curve"].size(), curve.size());
  EXPECT_EQ(yaml["curve"][0]["direction"].as<std::string>(), "APPROACH");
  EXPECT_FALSE(YAML::Load(run("--pitch 20e-9 " + sphere()).output)["half_space"].IsDefined());
}

TEST_F(PredictScanHalfSpace, JudgesTheDeviceAndSaysSo) {
  const auto call = [&](const std::string& half_space) {
    return "--pitch 2e-9 -c " +
           folder_.write("device.yaml",
                         "lower: {hardness: 1e9}\nload: {mechanical_load: 1e-7}\n"
                         "preprocessing: {level: plane, refine: {factor: 2}}\nhalf_space: {boundary: free, " +
                             half_space +
                             "}\n"
                             // as large as the frame
                             "device: {spring_stiffness: 1e-3, travel: 1e-6, contact_area: 4.096e-15}\n") +
           " " + scan();
  };
  const SolvedHalfSpace expected = this->expected();
  ASSERT_TRUE(expected.is_converged && expected.is_resolved && expected.is_step_converged);
  const nlohmann::json plain = nlohmann::json::parse(run("--json " + call("step: 0.5")).output);
  EXPECT_FALSE(plain.contains("verdict_by"));
  const nlohmann::json record = nlohmann::json::parse(run("--json --half-space " + call("step: 0.5")).output);
  EXPECT_EQ(record["pull_off_force"], plain["pull_off_force"]) << "the prediction's figure stays";
  EXPECT_EQ(record["verdict_by"], "half_space");
  EXPECT_EQ(record["reason"].get<std::string>().find("by the half-space: margin "), 0U) << record["reason"];
  EXPECT_NEAR(record["margin"].get<double>(), 1e-9 / expected.pull_off_force, 1e-12 * record["margin"].get<double>());
  EXPECT_EQ(record["apparent_work_of_adhesion"].get<double>(), expected.work_of_adhesion);
  const YAML::Node yaml = YAML::Load(run("--half-space " + call("step: 0.5")).output);
  EXPECT_EQ(yaml["verdict_by"].as<std::string>(), "half_space");
  EXPECT_EQ(yaml["reason"].as<std::string>(), record["reason"].get<std::string>());

  const nlohmann::json unsolved = nlohmann::json::parse(run("--json --half-space " + call("max_states: 10")).output);
  EXPECT_EQ(unsolved["verdict_by"], "prediction");
  for (const char* name : {"sticks", "margin", "margin_lower", "apparent_work_of_adhesion"}) {
    EXPECT_EQ(unsolved[name], plain[name]) << name;
  }
  const std::string reason = unsolved["reason"].get<std::string>();
  EXPECT_EQ(reason.find(plain["reason"].get<std::string>() + "; the half-space does not count: "), 0U) << reason;
  EXPECT_NE(reason.find("half_space/max_states = 10"), std::string::npos) << reason;
}

TEST_F(PredictScanHalfSpace, CurveFileHasThePullOffForceAsItsLargestAttraction) {
  const SolvedHalfSpace expected = this->expected();
  ASSERT_EQ(run("--curve " + folder_.file("curve.csv") + " " + arguments()).status, 0);
  std::istringstream lines(ScratchFolder::read(folder_.file("curve.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "height,force,direction");
  double largest = 0.0;
  double height = 0.0;
  std::size_t count = 0;
  for (; std::getline(lines, line); ++count) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    const double force = std::stod(line.substr(first + 1));
    if (line.substr(second + 1) != "RETRACTION" || force <= largest) continue;
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
  const Outcome outcome = run("--json --curve " + curve + " --formulation-curve " + beside + " " + arguments());
  ASSERT_EQ(outcome.status, 0);
  const nlohmann::json record = nlohmann::json::parse(outcome.output);
  const auto of_half_space = pointsOf(ScratchFolder::read(curve), "RETRACTION");
  const auto of_formulation = pointsOf(ScratchFolder::read(beside), "RETRACTION");
  EXPECT_EQ(of_half_space.size(), expected().retraction.size());
  const auto highest = [](const std::vector<std::pair<double, double>>& points) {
    return *std::max_element(points.begin(), points.end(),
                             [](const auto& left, const auto& right) { return left.second < right.second; });
  };
  EXPECT_EQ(highest(of_half_space).second, record["half_space"]["pull_off_force"].get<double>());
  // both count the height from first touch: for a sphere they part within the range of the forces, 0.16 nm
  EXPECT_NEAR(highest(of_half_space).first, highest(of_formulation).first, 0.16e-9);
}

TEST_F(PredictScanHalfSpace, MapFilesAreTheLibrarysMaps) {
  const SolvedHalfSpace expected = this->expected();
  const std::string pressure_file = folder_.file("pressure.tiff");
  const std::string gap_file = folder_.file("gap.tiff");
  const std::string deformed_file = folder_.file("deformed.tiff");
  ASSERT_EQ(run("--half-space-pressure " + pressure_file + " --half-space-gap " + gap_file + " --half-space-deformed " +
                deformed_file + " " + arguments())
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
  const Outcome outcome =
      run("--half-space-gap " + folder_.file("gap.tiff") + " -c " +
          folder_.write("few.yaml", "half_space: {max_states: 10}\n") + " --pitch 2e-9 --half-space " + scan());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.output.empty());
  ASSERT_FALSE(outcome.errors.empty());
  EXPECT_NE(outcome.errors.back().find("gap.tiff: not written"), std::string::npos) << outcome.errors.back();
  EXPECT_NE(outcome.errors.back().find("half_space/max_states = 10"), std::string::npos) << outcome.errors.back();
}

TEST_F(PredictScanHalfSpace, WhatHasNoSolutionIsNullWithItsReasonOnStandardError) {
  const Outcome outcome = run("--json -c " + folder_.write("few.yaml", "half_space: {max_states: 10}\n") +
                              " --pitch 2e-9 --half-space " + scan());
  ASSERT_EQ(outcome.status, 0) << "the prediction is as good as without it";
  const nlohmann::json half_space = nlohmann::json::parse(outcome.output)["half_space"];
  EXPECT_EQ(half_space["status"], "TOO_MANY_STATES");
  EXPECT_TRUE(half_space["pull_off_force"].is_null());
  EXPECT_FALSE(half_space["is_converged"].get<bool>());
  EXPECT_GT(half_space["curve"].size(), 0u);
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find("half_space/max_states = 10"), std::string::npos) << outcome.errors[0];
}

TEST_F(PredictScanHalfSpace, WhatItCannotBeAskedIsOneLine) {
  const std::string no_adhesion = folder_.write("c.yaml", "interface: {work_of_adhesion: 0}\n");
  const std::string too_small = folder_.write("d.yaml", "half_space: {max_pixels: 1023}\n");
  for (const std::string& configuration : {no_adhesion, too_small}) {
    EXPECT_EQ(run("-c " + configuration + " --pitch 2e-9 " + scan()).status, 0) << "without --half-space";
    const Outcome outcome = run("-c " + configuration + " --pitch 2e-9 --half-space " + scan());
    EXPECT_EQ(outcome.status, 2) << configuration;
    EXPECT_EQ(outcome.errors.size(), 1u) << configuration;
    EXPECT_TRUE(outcome.output.empty()) << configuration;
  }
}

TEST_F(PredictScanHalfSpace, InterruptEndsIt) {
  // a minute of work, so that it is interrupted in the middle
  writeHeightTiff(folder_.file("large.tiff"), analytic::paraboloid(1024, 1024, 5e-9, 5e-9, 10e-6).heights());
  const std::string command = "timeout --preserve-status -s INT 1 " + std::string(MEMS_STICTION_PREDICT_SCAN) + " -c " +
                              folder_.write("fine.yaml", "half_space: {step: 0.01, max_states: 1000000}\n") +
                              " --pitch 5e-9 --half-space " + folder_.file("large.tiff") + " >" + folder_.file("out");
  const auto before = std::signal(SIGINT, SIG_DFL);  // a shell that put this test into the background ignores it
  const auto begin = std::chrono::steady_clock::now();
  const int status = std::system(command.c_str());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::signal(SIGINT, before);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  EXPECT_LT(seconds, 20.0) << "a transform of this frame takes a hundredth of a second; the rest is for busy machines";
  EXPECT_TRUE(ScratchFolder::read(folder_.file("out")).empty());
}

TEST_F(PredictScan, HelpNamesEveryOption) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* option :
       {"--config", "--pitch", "--voltage", "--load", "--step", "--json", "--deformed", "--convergence", "--half-space",
        "--curve", "--formulation-curve", "--record-curve", "--cleanings", "--half-space-pressure", "--half-space-gap",
        "--half-space-deformed", "SCAN"}) {
    EXPECT_NE(outcome.output.find(option), std::string::npos) << option;
  }
}

TEST_F(PredictScan, SphereOnFlatGivesThePullOffOfJkr) {
  // No van der Waals forces, so that the pull-off is JKR's alone; 25 pixels across the contact radius.
  const std::string configuration = folder_.write("jkr.yaml",
                                                  "interface: {hamaker_constant: 0, work_of_adhesion: 0.1}\napproach: "
                                                  "{formulation: paper, deformation: elastic}\n");
  constexpr double kRadius = 2e-6;
  constexpr double kWork = 0.1;
  const double modulus = 4.0 / 3.0 * ContactPair(Material(), Material()).contact_modulus;
  for (const double load : {0.0, 1e-7, 1e-6, 1e-5}) {
    const double adhesion = 3.0 * kPi * kWork * kRadius;
    const double apparent = load + adhesion + std::sqrt(2.0 * adhesion * load + adhesion * adhesion);
    const double contact_radius = std::cbrt(kRadius * apparent / modulus);
    const double pitch = contact_radius / 25.0;
    writeHeightTiff(folder_.file("s.tiff"), analytic::paraboloid(201, 201, pitch, pitch, kRadius).heights());
    std::ostringstream arguments;
    arguments << "--config " << configuration << " --pitch " << pitch << " --load " << load << " "
              << folder_.file("s.tiff");
    const YAML::Node record = YAML::Load(run(arguments.str()).output);
    EXPECT_EQ(record["status"].as<std::string>(), "EQUILIBRIUM");
    EXPECT_NEAR(record["pull_off_force"].as<double>() / (1.5 * kPi * kWork * kRadius), 1.0, 0.03) << load;
    EXPECT_NEAR(record["contact_area_jkr"].as<double>() / (kPi * contact_radius * contact_radius), 1.0, 0.03) << load;
    EXPECT_NEAR(record["contact_area"].as<double>() / (kPi * contact_radius * contact_radius), 1.0, 0.06) << load;
  }
}

}  // namespace
}  // namespace mems_stiction
