/// The real predict_device: its record, its scans of several pitches, and what it refuses.

#include <cmath>
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "import/scan_writer.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"
#include "support/program_run.hpp"
#include "support/scratch_folder.hpp"
#include "surface/translated_gaussian_surface.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {
namespace {

/// Small and quick: three made surfaces of 2e4 pixels.
constexpr const char* kQuick = " --realisations 3 --max-cells 2e4 ";
constexpr const char* kArea = " --area 1e-11 ";

class PredictDevice : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    return runProgram(folder_, std::string(MEMS_STICTION_PREDICT_DEVICE) + " " + arguments);
  }
  nlohmann::json record(const std::string& arguments) const {
    const Outcome outcome = run("--json" + std::string(kQuick) + arguments);
    EXPECT_EQ(outcome.status, 0) << (outcome.errors.empty() ? "" : outcome.errors.front());
    return outcome.status == 0 ? nlohmann::json::parse(outcome.output) : nlohmann::json();
  }

  /// 64 x 64 pixels of a Gaussian surface with an rms height of 2 nm, float32 metres; the file does
  /// not state its pitch.
  std::string scan(const std::string& name, int seed, double pitch = 10e-9) const {
    TranslatedGaussianOptions options;
    options.gaussian.rows = options.gaussian.cols = 64;
    options.gaussian.pitch_x = options.gaussian.pitch_y = pitch;
    options.gaussian.rms_height = 2e-9;
    options.gaussian.correlation_length_x = options.gaussian.correlation_length_y = 60e-9;
    options.gaussian.seed = seed;
    writeHeightTiff(folder_.file(name), translatedGaussianSurface(options).heights());
    return folder_.file(name);
  }
  std::string config(const std::string& text) const { return folder_.write("part.yaml", text); }

  ScratchFolder folder_;
};

TEST_F(PredictDevice, saysForceIntervalAndListsByTheirNames) {
  const nlohmann::json device =
      record(kArea + std::string("--pitch 10e-9 ") + scan("a.tiff", 1) + " " + scan("b.tiff", 2));
  ASSERT_FALSE(device.is_null());
  const double force = device["pull_off_force"];
  EXPECT_GT(force, 0.0);
  EXPECT_LT(device["pull_off_force_lower"].get<double>(), force);
  EXPECT_GT(device["pull_off_force_upper"].get<double>(), force);
  EXPECT_GT(device["apparent_work_of_adhesion"].get<double>(), 0.0);
  EXPECT_GT(device["linear_pull_off_force"].get<double>(), 0.0);
  EXPECT_GT(device["contacts"].get<double>(), 0.0);
  EXPECT_DOUBLE_EQ(device["area"].get<double>(), 1e-11);
  EXPECT_EQ(device["realisations"].size(), 3u);
  EXPECT_GT(device["realisations"][0]["pull_off_force"].get<double>(), 0.0);
  EXPECT_GT(device["spectrum"].size(), 3u);
  EXPECT_TRUE(device["spectrum"][0].contains("is_measured"));
  EXPECT_GE(device["parts_of_scans"].size(), 2u);
  EXPECT_TRUE(device["warnings"].is_array());
  EXPECT_EQ(device["scans"].size(), 2u);
  EXPECT_EQ(device["formulation"], "separation_curve");
  EXPECT_EQ(device["settings_hash"].get<std::string>().size(), 16u);
  EXPECT_FALSE(device.contains("sticks")) << "no device is to be opened";
}

TEST_F(PredictDevice, takesAreaSpringAndSeedFromTheSettings) {
  const std::string settings =
      "device: {contact_area: 1e-11, spring_stiffness: 100, travel: 1e-6}\ndevice_force: "
      "{realisations: 3, max_cells: "
      "1e4}\n";
  const std::string path = scan("a.tiff", 1);
  const Outcome first = run("--json --config " + config(settings) + " --pitch 10e-9 " + path);
  ASSERT_EQ(first.status, 0);
  EXPECT_EQ(run("--json --config " + config(settings) + " --pitch 10e-9 " + path).output,
            first.output);
  const nlohmann::json device = nlohmann::json::parse(first.output);
  EXPECT_EQ(device["sticks"], "no");
  const std::string yaml = run("--config " + config(settings) + " --pitch 10e-9 " + path).output;
  const std::string reason = device["reason"];
  EXPECT_EQ(yaml.substr(yaml.rfind("\n# ") + 1), "# Does it stick? No: " + reason + ".\n");
  EXPECT_NEAR(device["margin"].get<double>() * device["pull_off_force"].get<double>(), 1e-4, 1e-12);
  const Outcome other = run("--json --config " + config(settings + "device_force/seed: 2\n") +
                            " --pitch 10e-9 " + path);
  ASSERT_EQ(other.status, 0);
  EXPECT_NE(nlohmann::json::parse(other.output)["realisations"], device["realisations"]);
}

TEST_F(PredictDevice, writesTheSameAsYaml) {
  const Outcome outcome = run(kQuick + std::string(kArea) + "--pitch 10e-9 " + scan("a.tiff", 1));
  ASSERT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output.rfind("---\nscans:\n", 0), 0u) << outcome.output;
  for (const char* name : {"\npull_off_force: ", "\nrealisations:\n", "\nspectrum:\n",
                           "\nparts_of_scans:\n", "\n# Pull-off force of "}) {
    EXPECT_NE(outcome.output.find(name), std::string::npos) << name;
  }
}

TEST_F(PredictDevice, takesAPitchForEachScan) {
  const std::string scans = scan("fine.tiff", 1) + " " + scan("wide.tiff", 2, 40e-9);
  const nlohmann::json apart = record(kArea + std::string("--pitch 10e-9 --pitch 40e-9 ") + scans);
  EXPECT_DOUBLE_EQ(apart["pitch"].get<double>(), 10e-9);
  const nlohmann::json one = record(kArea + std::string("--pitch 10e-9 ") + scans);
  EXPECT_NE(apart["pull_off_force"], one["pull_off_force"]);
  folder_.write("wide.tiff.yaml", "pitch_x: 40e-9\npitch_y: 40e-9\n");
  folder_.write("fine.tiff.yaml", "pitch_x: 10e-9\npitch_y: 10e-9\n");
  EXPECT_EQ(record(kArea + scans)["pull_off_force"], apart["pull_off_force"]);
  const Outcome three = run("--pitch 1e-8 --pitch 2e-8 --pitch 3e-8" + std::string(kArea) + scans);
  EXPECT_EQ(three.status, 2);
  ASSERT_EQ(three.errors.size(), 1u);
  EXPECT_NE(three.errors[0].find("--pitch: 3 are given for 2 scans"), std::string::npos)
      << three.errors[0];
  const Outcome number = run("--pitch 1e-8 2e-8" + std::string(kArea) + scans);
  EXPECT_EQ(number.status, 2);
  ASSERT_EQ(number.errors.size(), 1u);
  EXPECT_NE(number.errors[0].find("give the option again"), std::string::npos) << number.errors[0];
}

TEST_F(PredictDevice, needsAnArea) {
  const Outcome outcome = run("--pitch 10e-9 " + scan("a.tiff", 1));
  EXPECT_EQ(outcome.status, 2);
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find("--area"), std::string::npos) << outcome.errors[0];
  const Outcome negative = run("--pitch 10e-9 --area=-1 " + scan("a.tiff", 1));
  EXPECT_EQ(negative.status, 2);
  ASSERT_EQ(negative.errors.size(), 1u);
  EXPECT_NE(negative.errors[0].find("device/contact_area"), std::string::npos)
      << negative.errors[0];
}

TEST_F(PredictDevice, refusesAllForOneBadScanAndNamesIt) {
  const std::string bad = folder_.write("bad.tiff", "no picture");
  const Outcome outcome =
      run(kArea + std::string(kQuick) + "--pitch 10e-9 " + scan("a.tiff", 1) + " " + bad);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.output.empty());
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find(bad), std::string::npos) << outcome.errors[0];
}

TEST_F(PredictDevice, takesACounterSurfaceThatSaysHowItFaces) {
  const std::string scans =
      "--pitch 10e-9 --counter-surface " + scan("upper.tiff", 3) + " " + scan("a.tiff", 1);
  const Outcome unstated = run(kArea + std::string(kQuick) + scans);
  EXPECT_EQ(unstated.status, 2);
  ASSERT_EQ(unstated.errors.size(), 1u);
  EXPECT_NE(unstated.errors[0].find("counter_surface/facing"), std::string::npos)
      << unstated.errors[0];
  const nlohmann::json device = record(kArea + std::string("--config ") +
                                       config("counter_surface/facing: up\n") + " " + scans);
  ASSERT_FALSE(device.is_null());
  EXPECT_EQ(device["counter_surface"].size(), 1u);
  EXPECT_EQ(device["scans"].size(), 1u);
}

TEST_F(PredictDevice, refusesAPictureThatCannotBe) {
  const std::string rest = kArea + std::string("--pitch 10e-9 ") + scan("a.tiff", 1);
  for (const std::string& path : {folder_.file("out.jpg"), folder_.file("none/out.png")}) {
    const Outcome outcome = run("--picture " + path + rest);
    EXPECT_EQ(outcome.status, 2);
    ASSERT_EQ(outcome.errors.size(), 1u);
    EXPECT_NE(outcome.errors[0].find("--picture"), std::string::npos) << outcome.errors[0];
  }
}

}  // namespace
}  // namespace mems_stiction
