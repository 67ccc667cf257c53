/// What predict_scan says of wrong files, settings and options: one line that names what is wrong, and exit status 2.

#include <nlohmann/json.hpp>

#include "support/predict_scan_program.hpp"

namespace mems_stiction {
namespace {

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

}  // namespace
}  // namespace mems_stiction
