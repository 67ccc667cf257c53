/// The command line as users and scripts call it: what it predicts, and how it says so.

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include <opencv2/imgcodecs.hpp>

#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "numeric/constants.hpp"
#include "support/predict_scan_program.hpp"

namespace mems_stiction {
namespace {

TEST_F(PredictScan, PrintsTheRecordOfTheCoresPrediction) {
  const std::string scan = sphere();
  const Outcome outcome = run("--all --pitch 20e-9 --load 1e-6 " + scan);
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

TEST_F(PredictScan, AFolderIsItsScansByName) {
  std::filesystem::create_directories(folder_.file("scans/deeper"));
  const std::string pixels = ScratchFolder::read(sphere());
  for (const char* name : {"b.tiff", "a.tiff", "deeper/c.tiff", ".d.tiff"})
    folder_.write(std::string("scans/") + name, pixels);
  folder_.write("scans/b.tiff.yaml", "pitch_x: 30.0e-9\npitch_y: 30.0e-9\n");
  folder_.write("scans/README.md", "no scan");
  folder_.write("scans/a.tiff.yaml", "pitch_x: 20.0e-9\npitch_y: 20.0e-9\n");
  const Outcome outcome = run("--json " + folder_.file("scans"));
  EXPECT_EQ(outcome.status, 0);
  std::istringstream lines(outcome.output);
  std::vector<std::pair<std::string, double>> found;
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json record = nlohmann::json::parse(line);
    found.emplace_back(record["scan_name"], record["pitch_x"]);
  }
  EXPECT_EQ(found, (std::vector<std::pair<std::string, double>>{{"a", 20e-9}, {"b", 30e-9}}));
  const Outcome refused =
      run("--deformed " + folder_.file("out.tiff") + " " + folder_.file("scans"));
  EXPECT_EQ(refused.status, 2) << "one file cannot hold what belongs to two scans";
}

TEST_F(PredictScan, TheVersionIsAllThatIsAskedFor) {
  const Outcome outcome = run("--version --no-such-option");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(std::regex_match(outcome.output,
                               std::regex("predict_scan of mems_stiction \\d+\\.\\d+\\.\\d+\n")))
      << outcome.output;
}

TEST_F(PredictScan, ConfigurationFileAndOptionsMeet) {
  const std::string configuration =
      folder_.write("c.yaml",
                    "interface: {insulator_thickness: 100e-9}\nload: {mechanical_load: 1e-6, "
                    "voltage: 1}\nscan: {pitch_x: "
                    "20e-9, pitch_y: 20e-9}\n");
  const YAML::Node record = YAML::Load(
      run("--all --config " + configuration + " --voltage -5 --step 0.1e-9 " + sphere()).output);
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

TEST_F(PredictScan, ConvergenceIsAListInBothFormatsAndATableForPeople) {
  const std::string call = "--convergence --pitch 20e-9 --load 1e-5 " + sphere();
  const Outcome json = run("--json " + call);
  ASSERT_EQ(json.status, 0);
  const nlohmann::json record = nlohmann::json::parse(json.output);
  ASSERT_EQ(record["convergence"].size(), 3u);
  EXPECT_EQ(record["convergence"][2]["decimation"], 4);
  EXPECT_EQ(record["convergence"][2]["cols"], 25);
  EXPECT_EQ(record["is_resolution_limited"].type(), nlohmann::json::value_t::boolean);

  const Outcome yaml = run("--all " + call);
  EXPECT_NE(yaml.output.find("# half "), std::string::npos) << yaml.output;
  const YAML::Node document = YAML::Load(yaml.output);
  EXPECT_EQ(document["convergence"][1]["pull_off_force"].as<double>(),
            record["convergence"][1]["pull_off_force"].get<double>());
}

TEST_F(PredictScan, TheFormulationsCurveGoesToRestAndBackOverTheHalfSpacesHeight) {
  const std::string file = folder_.file("curve.csv");
  const Outcome outcome =
      run("--json --record-curve --pitch 20e-9 --curve " + file + " " + sphere());
  ASSERT_EQ(outcome.status, 0);
  const nlohmann::json record = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(record["formulation"], "separation_curve");
  const auto approach = pointsOf(ScratchFolder::read(file), "APPROACH");
  const auto retraction = pointsOf(ScratchFolder::read(file), "RETRACTION");
  const double range = std::sqrt(65e-21 / (16.0 * kPi * 0.05));  // z0 of the default interface
  std::vector<std::pair<double, double>> both = approach;
  both.insert(both.end(), retraction.begin(), retraction.end());
  ASSERT_EQ(both.size(), record["curve"].size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    const nlohmann::json& point = record["curve"][i];
    // numbers are written so that they read back as they were; the difference is rounded once
    EXPECT_NEAR(both[i].first, range - point["displacement"].get<double>(), 1e-22) << i;
    EXPECT_EQ(both[i].second, point["force"].get<double>()) << i;
    EXPECT_EQ(point["is_separation"].get<bool>(), i >= approach.size()) << i;
  }
  EXPECT_EQ(approach.back().first, retraction.front().first) << "the way out begins at rest";
  EXPECT_NEAR(retraction.front().second - approach.back().second, 0.0,
              0.05 * record["pull_off_force"].get<double>());
  double largest = 0.0;
  for (const auto& point : retraction) largest = std::max(largest, point.second);
  // the pull-off force is the summit of a parabola through the highest points
  EXPECT_NEAR(largest / record["pull_off_force"].get<double>(), 1.0, 0.02);
  EXPECT_LT(retraction.front().first, range) << "at rest contacts are pressed in";
}

TEST_F(PredictScan, ForceAndMarginAreRoundedForPeopleInACommentAndKeptInTheFields) {
  const std::string device =
      folder_.write("d.yaml",
                    "device: {spring_stiffness: 1.0, travel: 1.0e-6, contact_area: "
                    "4.0804e-12}\ndevice_force: {enabled: false}\n");
  const std::string call = "-c " + device + " --pitch 20e-9 " + sphere();
  const std::string text = run("--all " + call).output;
  const std::size_t place = text.find("\n# Pull-off force ");
  ASSERT_NE(place, std::string::npos);
  const std::string line = text.substr(place + 1, text.find('\n', place + 1) - place - 1);
  // one contact: its interval is wide, so that two digits are left
  EXPECT_TRUE(std::regex_match(
      line, std::regex("# Pull-off force \\d\\.?\\d?e-0\\d N, 95 % within [^;]* N\\.")))
      << line;
  const std::string sentence = text.substr(text.rfind("\n# ") + 1);
  EXPECT_TRUE(std::regex_match(
      sentence,
      std::regex(
          "# Does it stick\\? (No|Marginal|Yes|Not known): margin [^;]*, 95 % within .*\\.\n")))
      << sentence;
}

TEST_F(PredictScan, ACurveSaysWhereItComesFrom) {
  const std::string file = folder_.file("curve.csv");
  const std::string part =
      folder_.write("part.yaml", "part: {id: 'die 12, left', serial: '=A33'}\n");
  const Outcome outcome = run("--json -c " + part + " --pitch 20e-9 --curve " + file + " '" +
                              sphere("wafer 3.tiff") + "'");
  ASSERT_EQ(outcome.status, 0);
  const std::string hash =
      nlohmann::json::parse(outcome.output)["settings_hash"].get<std::string>();
  std::istringstream lines(ScratchFolder::read(file));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    EXPECT_NE(line.find("," + hash + ",wafer 3,\"die 12, left\",'=A33"), std::string::npos) << line;
  }
}

/// As large as the frame of sphere(), which then stands for it; small surfaces.
constexpr const char* kDevice =
    "device: {spring_stiffness: 1.0, travel: 1.0e-6, contact_area: 4.0804e-12}\n";

TEST_F(PredictScan, AStatedDeviceIsJudged) {
  const std::string device =
      folder_.write("d.yaml", kDevice + std::string("device_force: {enabled: false}\n"));
  const std::string call = " --pitch 20e-9 " + sphere();
  const YAML::Node record = YAML::Load(run("--all -c " + device + call).output);
  const double scale = 4.0804e-12 / record["nominal_area"].as<double>();
  EXPECT_DOUBLE_EQ(record["margin"].as<double>(),
                   1e-6 / (record["pull_off_force"].as<double>() * scale));
  EXPECT_LT(record["margin_lower"].as<double>(), record["margin"].as<double>());
  EXPECT_GT(record["margin_upper"].as<double>(), record["margin"].as<double>());
  EXPECT_FALSE(record["sticks"].as<std::string>().empty());
  EXPECT_FALSE(record["reason"].as<std::string>().empty());
  EXPECT_FALSE(record["device_force"].IsDefined());
  EXPECT_NE(record["regime_flag_names"].as<std::string>().find("few_contacts"), std::string::npos);
  const YAML::Node without = YAML::Load(run("--all " + call).output);
  EXPECT_FALSE(without["margin"].IsDefined());
  EXPECT_EQ(without["regime_flags"].as<unsigned>(), record["regime_flags"].as<unsigned>());
}

TEST_F(PredictScan, ADeviceIsJudgedByItsOwnForce) {
  const std::string device = folder_.write(
      "d.yaml", kDevice + std::string("device_force: {realisations: 3, max_cells: 1e4}\n"));
  const YAML::Node record =
      YAML::Load(run("--all -c " + device + " --pitch 20e-9 " + sphere()).output);
  const YAML::Node force = record["device_force"];
  ASSERT_TRUE(force.IsMap());
  EXPECT_EQ(record["device_pull_off_force"].as<double>(), force["pull_off_force"].as<double>());
  EXPECT_DOUBLE_EQ(record["margin"].as<double>(), 1e-6 / force["pull_off_force"].as<double>());
  EXPECT_EQ(record["device_apparent_work_of_adhesion"].as<double>(),
            force["apparent_work_of_adhesion"].as<double>());
  EXPECT_DOUBLE_EQ(force["area"].as<double>(), 4.0804e-12);
}

TEST_F(PredictScan, CleaningsAreAListWithTheirSpread) {
  const Outcome outcome = run("--all --cleanings --pitch 20e-9 " + sphere());
  ASSERT_EQ(outcome.status, 0);
  const YAML::Node record = YAML::Load(outcome.output);
  ASSERT_EQ(record["cleanings"].size(), 9u);
  EXPECT_EQ(record["cleanings"][0]["cleaning"].as<std::string>(), "as configured");
  EXPECT_EQ(record["cleanings"][0]["pull_off_force"].as<double>(),
            record["pull_off_force"].as<double>());
  EXPECT_GE(record["cleaning_spread"]["pull_off_factor"].as<double>(), 1.0);
  EXPECT_NE(outcome.output.find("# Over "), std::string::npos);
}

TEST_F(PredictScan, CleaningsWidenTheMargin) {
  const std::string call =
      "-c " +
      folder_.write("d.yaml",
                    kDevice + std::string("device_force: {realisations: 3, max_cells: 1e4}\n")) +
      " --pitch 20e-9 " + sphere();
  const YAML::Node plain = YAML::Load(run("--all " + call).output);
  const YAML::Node record = YAML::Load(run("--all --cleanings " + call).output);
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
      "c.yaml",
      "preprocessing: {level: plane, tip: {radius: 50e-9}}\noutput: {spatial_roughness: true}\n");
  const YAML::Node record =
      YAML::Load(run("--all -c " + configuration + " --pitch 20e-9 " + sphere()).output);
  ASSERT_EQ(record["preprocessing"].size(), 2u);
  EXPECT_EQ(record["preprocessing"][0]["step"].as<std::string>(), "tip");
  EXPECT_EQ(record["preprocessing"][1]["parameters"].as<std::string>(), "shape=plane robust=false");
  EXPECT_TRUE(record["tip_unreached_fraction"].IsDefined());
  EXPECT_GT(record["roughness"]["sal"].as<double>(), 0.0);
  EXPECT_FALSE(
      YAML::Load(run("--all --pitch 20e-9 " + sphere()).output)["roughness"]["sal"].IsDefined());
}

TEST_F(PredictScan, WhatAScanDoesNotShowStandsOnceWhereTheVerdictGivesItAsItsReason) {
  cv::Mat heights(64, 64, CV_32FC1);  // each pixel by itself: no pixel shows a summit
  cv::RNG(1).fill(heights, cv::RNG::NORMAL, 0.0, 3e-9);
  const std::string scan = folder_.file("noise.tiff");
  writeHeightTiff(scan, heights);
  const std::string device = folder_.write(
      "d.yaml", kDevice + std::string("device_force: {realisations: 3, max_cells: 1e4}\n"));
  const std::string text = run("-c " + device + " --pitch 20e-9 " + scan).output;
  const std::string sentence = "does not show what holds: waves shorter than two pixels";
  const std::size_t first = text.find(sentence);
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_LT(text.rfind('\n', first), text.find("Does it stick? Not known")) << text;
  EXPECT_EQ(text.find(sentence, first + 1), std::string::npos) << text;
}

TEST_F(PredictScan, WithoutOptionsItSaysWhatPeopleAskFor) {
  const std::string device = folder_.write(
      "d.yaml",
      kDevice + std::string("device_force: {enabled: false}\nhalf_space: {enabled: false}\n"
                            "interface: {surface_tension: 0.05}\n"));
  const std::string call = "-c " + device + " --load 0.03 --pitch 20e-9 " + sphere();
  const Outcome outcome = run(call);
  ASSERT_EQ(outcome.status, 0);
  const nlohmann::json record = nlohmann::json::parse(run("--json " + call).output);
  const std::string& text = outcome.output;
  EXPECT_EQ(text.find(sphere() + "\n"), 0U) << text;
  for (const std::string& line :
       {std::string("\n  status: bonded by the load, 1 contact\n"),
        std::string("\n  pull-off force: "),
        "\n  Does it stick? Marginal: " + record["reason"].get<std::string>() + ". ",
        std::string("\n  outside the model's range: few contacts: another place of the surface "
                    "may differ much\n"),
        "\n  warning: " + record["warnings"][0].get<std::string>() + "\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "in\n" << text;
  }
  EXPECT_EQ(text.find('\033'), std::string::npos) << "no colours where nobody looks";
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 12);
  EXPECT_EQ(outcome.errors.size(), record["warnings"].size()) << "a script finds them here, too";
  EXPECT_NE(run("--pitch 20e-9 " + sphere()).output.find("Does it stick? That needs a device"),
            std::string::npos);
  EXPECT_NE(run("--convergence " + call).output.find("\n  resolution "), std::string::npos);
}

TEST_F(PredictScan, HelpNamesEveryOption) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* option :
       {"--config", "--pitch", "--voltage", "--load", "--step", "--all", "--json", "--deformed",
        "--convergence", "--half-space", "--curve", "--formulation-curve", "--record-curve",
        "--cleanings", "--half-space-pressure", "--half-space-gap", "--half-space-deformed",
        "SCAN"}) {
    EXPECT_NE(outcome.output.find(option), std::string::npos) << option;
  }
}

TEST_F(PredictScan, SphereOnFlatGivesThePullOffOfJkr) {
  // No van der Waals forces, so that the pull-off is JKR's alone; 25 pixels across the contact
  // radius.
  const std::string configuration =
      folder_.write("jkr.yaml",
                    "interface: {hamaker_constant: 0, work_of_adhesion: 0.1}\napproach: "
                    "{formulation: paper, deformation: elastic}\n");
  constexpr double kRadius = 2e-6;
  constexpr double kWork = 0.1;
  const double modulus = 4.0 / 3.0 * ContactPair(Material(), Material()).contact_modulus;
  for (const double load : {0.0, 1e-7, 1e-6, 1e-5}) {
    const double adhesion = 3.0 * kPi * kWork * kRadius;
    const double apparent =
        load + adhesion + std::sqrt(2.0 * adhesion * load + adhesion * adhesion);
    const double contact_radius = std::cbrt(kRadius * apparent / modulus);
    const double pitch = contact_radius / 25.0;
    writeHeightTiff(folder_.file("s.tiff"),
                    analytic::paraboloid(201, 201, pitch, pitch, kRadius).heights());
    std::ostringstream arguments;
    arguments << "--config " << configuration << " --pitch " << pitch << " --load " << load << " "
              << folder_.file("s.tiff");
    const YAML::Node record = YAML::Load(run("--all " + arguments.str()).output);
    EXPECT_EQ(record["status"].as<std::string>(), "EQUILIBRIUM");
    EXPECT_NEAR(record["pull_off_force"].as<double>() / (1.5 * kPi * kWork * kRadius), 1.0, 0.03)
        << load;
    EXPECT_NEAR(record["contact_area_jkr"].as<double>() / (kPi * contact_radius * contact_radius),
                1.0, 0.03)
        << load;
    EXPECT_NEAR(record["contact_area"].as<double>() / (kPi * contact_radius * contact_radius), 1.0,
                0.06)
        << load;
  }
}

}  // namespace
}  // namespace mems_stiction
