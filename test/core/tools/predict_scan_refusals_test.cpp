/// What predict_scan says of wrong files, settings and options: one line that names what is wrong,
/// and exit status 2.

#include <sys/stat.h>
#include <nlohmann/json.hpp>

#include <filesystem>

#include "support/predict_scan_program.hpp"

namespace mems_stiction {
namespace {

TEST_F(PredictScan, BadInputIsOneLineAndTheOthersArePredicted) {
  const std::string good = sphere();
  const std::string whole = ScratchFolder::read(good);
  const std::string bad = folder_.write("bad.tiff", whole.substr(0, whole.size() / 2));
  const Outcome outcome =
      run("--json --pitch 20e-9 " + bad + " " + good + " " + folder_.file("none.png"));
  EXPECT_EQ(outcome.status, 2);
  ASSERT_EQ(outcome.errors.size(), 2u);
  EXPECT_NE(outcome.errors[0].find(bad), std::string::npos) << outcome.errors[0];
  EXPECT_NE(outcome.errors[1].find("none.png: there is no such file"), std::string::npos)
      << outcome.errors[1];
  EXPECT_EQ(nlohmann::json::parse(outcome.output)["file"], good);
}

TEST_F(PredictScan, BadSettingsAreOneLineEach) {
  const std::string scan = sphere();
  const std::string broken = folder_.write("broken.yaml", "lower: {youngs_modulos: 1e9}\n");
  const std::string printed = folder_.write("printed.yaml", "approach: {formulation: printed}\n");
  for (const std::string& arguments :
       {"--pitch 0 " + scan, "--pitch 2e-9x " + scan, "--pitch 20e-9 --load -1 " + scan,
        "--pitch 20e-9 --voltage 5 " + scan, "--config " + broken + " " + scan,
        "--config /nonexistent.yaml " + scan,
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

TEST_F(PredictScan, NumbersTooNearTo0AreNotTakenFor0) {
  const std::string scan = sphere();
  for (const char* text : {"1e-400", "-1e-400", "0.001E-999"}) {
    const std::string tiny = text;
    const std::string config =
        folder_.write("tiny.yaml", "load: {mechanical_load: " + tiny + "}\n");
    for (const std::string& arguments :
         {"-c " + config, "--load=" + tiny, "--voltage=" + tiny, "--sweep-load=0," + tiny}) {
      const Outcome outcome = run("--pitch 20e-9 " + arguments + " " + scan);
      EXPECT_EQ(outcome.status, 2) << arguments;
      ASSERT_EQ(outcome.errors.size(), 1u) << arguments;
      EXPECT_NE(outcome.errors[0].find(tiny), std::string::npos) << outcome.errors[0];
    }
  }
  EXPECT_EQ(run("--pitch 20e-9 --load 0e-400 --voltage 0.0 " + scan).status, 0);
}

TEST_F(PredictScan, AFormulationOfEarlierVersionsIsRefusedWithWhatServesInstead) {
  const std::string old = folder_.write("old.yaml", "approach: {formulation: corrected}\n");
  const Outcome outcome = run("--pitch 20e-9 --config " + old + " " + sphere());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.output.empty());
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find("must be one of: "), std::string::npos) << outcome.errors[0];
  EXPECT_NE(outcome.errors[0].find("'corrected' is no longer there: "), std::string::npos)
      << outcome.errors[0];
}

TEST_F(PredictScan, WhatIsImplausibleIsRefusedUnlessItIsMeant) {
  const Outcome refused = run("--pitch 20 " + sphere());
  EXPECT_EQ(refused.status, 2);
  ASSERT_EQ(refused.errors.size(), 1u);
  EXPECT_NE(refused.errors[0].find("implausible: pitch_x 20 m is above 1 mm"), std::string::npos)
      << refused.errors[0];
  const Outcome meant = run("--all --accept-implausible --pitch 20 " + sphere());
  EXPECT_EQ(meant.status, 0);
  ASSERT_FALSE(meant.errors.empty());
  EXPECT_NE(meant.errors[0].find("warning: pitch_x 20 m"), std::string::npos) << meant.errors[0];
  EXPECT_EQ(meant.output.find("warning: "), std::string::npos)
      << "the record has a list, no complaint";
  const std::string soft = folder_.write("soft.yaml", "lower: {youngs_modulus: 169}\n");
  EXPECT_EQ(run("--config " + soft + " --pitch 20e-9 " + sphere()).status, 2);
  EXPECT_EQ(run("--accept-implausible --config " + soft + " --pitch 20e-9 " + sphere()).status, 0);
}

TEST_F(PredictScan, StrictMakesAWarningAStatus) {
  const std::string call = "--load 1 --pitch 20e-9 " + sphere();
  EXPECT_EQ(run(call).status, 0);
  const Outcome strict = run("--strict " + call);
  EXPECT_EQ(strict.status, 1);
  EXPECT_FALSE(strict.output.empty()) << "the record is there";
  EXPECT_EQ(strict.errors.back(), "predict_scan: 1 warning, and --strict takes none");
  EXPECT_EQ(run("--strict --pitch 20e-9 " + sphere()).status, 0);
}

TEST_F(PredictScan, WhatIsMistypedIsNamedWithWhatIsAllowed) {
  const std::string scan = sphere();
  const std::string settings = folder_.write("part.yaml", "load: {voltage: 0}\n");
  std::filesystem::create_directories(folder_.file("none/of scans"));
  folder_.write("none/README.md", "no scan");
  folder_.write("none/.hidden", "no scan");
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"", "predict_scan: SCAN is required; --help shows all options"},
      {"--piych 20e-9 " + scan, "--piych: there is no such option (did you mean --pitch?)"},
      {"--pitch 20e-9 --voltage 20V " + scan,
       "--voltage: '20V' is not allowed, must be a number: without its unit"},
      {"--pitch 20e-9 --load 0,05 " + scan, "--load: '0,05' is not allowed, must be a number"},
      {"--pitch 20e-9 " + settings,
       "part.yaml: is a file of settings, not a scan; give it with --config"},
      {"--pitch 20e-9 " + folder_.write("a.bag", "#ROSBAG V2.0\n"),
       "a.bag: is a bag; stiction_batch predicts"},
      {"--pitch 20e-9 -c " + folder_.file(".") + " " + scan,
       "is a folder, not a configuration file"},
      {"--pitch 20e-9 " + folder_.file("none"), "none: holds no scan file"},
      {"--pitch 20e-9 " + folder_.write("empty.tiff", ""), "empty.tiff: is empty"}};
  for (const auto& [arguments, expected] : slips) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    ASSERT_EQ(outcome.errors.size(), 1u) << arguments;
    EXPECT_NE(outcome.errors[0].find(expected), std::string::npos) << outcome.errors[0];
    EXPECT_TRUE(outcome.output.empty()) << arguments;
  }
}

TEST_F(PredictScan, SettingsWithoutEndAreRefusedBeforeTheyAreRead) {
  const std::string scan = sphere();
  const std::string large = folder_.write("large.yaml", "load: {voltage: 0}\n");
  std::filesystem::resize_file(large, std::uint64_t{100} << 30);  // a hole: no disk is used
  const std::string pipe = folder_.file("pipe.yaml");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string beside = folder_.write("beside.tiff", ScratchFolder::read(scan));
  std::filesystem::create_hard_link(large, beside + ".yaml");
  const std::string too_large =
      "has 107374182400 bytes, more than the 1000000 of a configuration file";
  for (const auto& [arguments, expected] :
       {std::make_pair("-c /dev/zero " + scan,
                       std::string("/dev/zero: is a pipe, a socket or a device, not a file")),
        std::make_pair("-c " + pipe + " " + scan,
                       pipe + ": is a pipe, a socket or a device, not a file"),
        std::make_pair("-c " + large + " " + scan, large + ": " + too_large),
        std::make_pair(beside, beside + ".yaml: " + too_large)}) {
    const Outcome outcome = run("--pitch 20e-9 " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    ASSERT_EQ(outcome.errors.size(), 1u) << arguments;
    EXPECT_NE(outcome.errors[0].find(expected), std::string::npos) << outcome.errors[0];
  }
}

TEST_F(PredictScan, OutputsThatCannotBeWrittenAreNamedBeforeAnyWorkAndInputsAreKept) {
  const std::string scan = sphere();
  const std::string before = ScratchFolder::read(scan);
  const std::string settings = folder_.write("part.yaml", "load: {voltage: 0}\n");
  const std::string call = "--pitch 20e-9 -c " + settings + " " + scan;
  const std::string pipe = folder_.file("pipe.csv");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string option : {"--deformed", "--curve", "--half-space --half-space-gap"}) {
    for (const auto& [path, expected] :
         {std::make_pair(scan, "is what is read, which would be lost"),
          std::make_pair(settings, "is what is read, which would be lost"),
          std::make_pair(folder_.file("."), "is a folder, must be a file"),
          std::make_pair(pipe, "is a pipe or a socket, must be a file"),
          std::make_pair(folder_.file("none/x"), "cannot be written: there is no folder")}) {
      const Outcome outcome = run(option + " " + path + " " + call);
      EXPECT_EQ(outcome.status, 2) << path;
      ASSERT_EQ(outcome.errors.size(), 1u) << path;
      EXPECT_NE(outcome.errors[0].find(expected), std::string::npos) << outcome.errors[0];
    }
  }
  EXPECT_EQ(ScratchFolder::read(scan), before);
}

TEST_F(PredictScan, SlipsOfAUnitInLoadAndStepAreWarnedOf) {
  const std::string call = "--json --pitch 20e-9 " + sphere();
  const Outcome pressed = run("--load 1 " + call);
  ASSERT_EQ(pressed.errors.size(), 1u);
  EXPECT_NE(pressed.errors[0].find("warning: the mechanical load of 1 N is"), std::string::npos)
      << pressed.errors[0];
  EXPECT_EQ(nlohmann::json::parse(pressed.output)["warnings"].size(), 1u);
  const Outcome coarse = run("--step 1 " + call);
  ASSERT_EQ(coarse.errors.size(), 2u);
  EXPECT_NE(coarse.errors[1].find("paper/step 1 has no effect"), std::string::npos)
      << coarse.errors[1];
  EXPECT_NE(coarse.errors[0].find("paper/step 1 m is outside the usual"), std::string::npos)
      << coarse.errors[0];
}

TEST_F(PredictScan, NoLineOfProgressReachesWhatIsNoTerminal) {
  EXPECT_TRUE(run("--pitch 20e-9 --cleanings --convergence " + sphere()).errors.empty());
}

}  // namespace
}  // namespace mems_stiction
