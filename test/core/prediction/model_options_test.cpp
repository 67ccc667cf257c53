/// Settings of the model that are out of range: every message names the key, the value and what is
/// allowed.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/contact_solvers.hpp"

namespace mems_stiction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> violationsOf(const Options& options) {
  try {
    AdhesionModel model(options);
  } catch (const OptionsError& error) {
    return error.violations();
  }
  return {};
}

/// The only violation names its key, its value and what is allowed.
void expectViolation(const Options& options, const std::string& key, const std::string& value,
                     const std::string& allowed) {
  const std::vector<std::string> violations = violationsOf(options);
  ASSERT_EQ(violations.size(), 1u) << key;
  EXPECT_NE(violations[0].find(key), std::string::npos) << violations[0];
  EXPECT_NE(violations[0].find(value), std::string::npos) << violations[0];
  EXPECT_NE(violations[0].find(allowed), std::string::npos) << violations[0];
}

TEST(ModelOptions, nameWhatIsWrongItsValueAndWhatIsAllowed) {
  EXPECT_TRUE(violationsOf(Options()).empty());
  Options options;
  options.lower.youngs_modulus = -1.0;
  expectViolation(options, "lower/youngs_modulus", "-1", "> 0");
  options = Options();
  options.upper.poisson_ratio = 0.6;
  expectViolation(options, "upper/poisson_ratio", "0.6", "(-1, 0.5]");
  options = Options();
  options.upper.hardness = kNan;
  expectViolation(options, "upper/hardness", "nan", "> 0");
  options = Options();
  options.interface.work_of_adhesion = -0.01;
  expectViolation(options, "interface/work_of_adhesion", "-0.01", ">= 0");
  options = Options();
  options.solver.of<PaperOptions>().cutoff_distance = 0.0;
  expectViolation(options, "paper/cutoff_distance", "0", "> 0");
  options = Options();
  options.interface.hardness_ratio_limit = 1.0;
  expectViolation(options, "interface/hardness_ratio_limit", "1", "(0, 1)");
  options = Options();
  options.load.mechanical_load = -1e-6;
  expectViolation(options, "load/mechanical_load", "-1e-06", "[0, 1]");
  options = Options();
  options.approach.max_contact_fraction = 0.0;
  expectViolation(options, "approach/max_contact_fraction", "0", "(0, 1]");
  options = Options();
  options.approach.max_steps = 0;
  expectViolation(options, "approach/max_steps", "0", "[1,");
  options = Options();
  options.solver.of<PaperOptions>().step = std::numeric_limits<double>::infinity();
  expectViolation(options, "paper/step", "inf", ">= 0");
}

TEST(ModelOptions, ofTheOtherSideOfABodyGoTogether) {
  Options options;
  options.upper.thickness = -1e-6;
  expectViolation(options, "upper/thickness", "-1e-06", ">= 0");
  options = Options();
  options.lower.thickness = std::numeric_limits<double>::infinity();
  expectViolation(options, "lower/thickness", "inf", ">= 0");
  options = Options();
  options.lower.thickness = 2e-6;
  EXPECT_TRUE(violationsOf(options).empty());
  options.lower.substrate.youngs_modulus = 7e10;
  expectViolation(options, "lower/substrate/youngs_modulus", "7e+10", "lower/backing free");
  options.lower.backing = Backing::kBonded;
  EXPECT_TRUE(violationsOf(options).empty());
  options.lower.substrate.poisson_ratio = 0.51;
  expectViolation(options, "lower/substrate/poisson_ratio", "0.51", "(-1, 0.5]");
  options.lower.substrate = {-1.0, 0.3};
  expectViolation(options, "lower/substrate/youngs_modulus", "-1", ">= 0");
}

TEST(ModelOptions, needAnInsulatorUnderAVoltage) {
  Options options;
  options.load.voltage = 5.0;
  expectViolation(options, "interface/insulator_thickness", "5 V", "> 0");
  options.interface.insulator_thickness = 1e-9;
  EXPECT_TRUE(violationsOf(options).empty());
  options.load.voltage = 2000.0;
  expectViolation(options, "load/voltage", "2000", "[-1000, 1000]");
}

TEST(ModelOptions, needAnInsulatorUnderAContactPotential) {
  Options options;
  options.load.contact_potential = -0.2;
  expectViolation(options, "interface/insulator_thickness", "load/contact_potential -0.2 V", "> 0");
  options.interface.insulator_thickness = 4e-9;
  EXPECT_TRUE(violationsOf(options).empty());
  for (const double wrong : {50.5, -300.0, std::nan("")}) {
    options.load.contact_potential = wrong;
    expectViolation(options, "load/contact_potential", "V is not allowed", "[-50, 50]");
  }
}

TEST(ModelOptions, stayWhenNewOnesAreRefused) {
  AdhesionModel model{Options()};
  Options bad;
  bad.lower.hardness = 0.0;
  bad.load.voltage = 1.0;
  EXPECT_THROW(model.setOptions(bad), OptionsError);
  EXPECT_EQ(model.options().lower.hardness, Options().lower.hardness);
  EXPECT_EQ(violationsOf(bad).size(), 2u);  // all of them at once
}

TEST(ContactSolvers, refuseAnUnknownFormulationInTheWordsOfTheOptions) {
  for (const char* name : {"printd", "corrected", ""}) {
    Options options;
    options.formulation = name;
    try {
      makeContactSolver(options.formulation);
      FAIL() << "no error: " << name;
    } catch (const OptionsError& error) {
      EXPECT_EQ(error.violations(), options.validate()) << name;
    }
  }
}

TEST(ContactSolvers, sayWhatServesInPlaceOfAFormulationOfEarlierVersions) {
  const std::string reason = retirement("corrected");
  for (const char* part :
       {"approach/formulation", "'corrected'", "`separation_curve`", "`paper`"}) {
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  }
  Options options;
  options.formulation = "corrected";
  const std::vector<std::string> violations = violationsOf(options);
  ASSERT_EQ(violations.size(), 2u);
  EXPECT_NE(violations[0].find("must be one of"), std::string::npos);
  EXPECT_EQ(violations[1], reason);
}

TEST(ContactSolvers, sayNothingMoreOfOtherNames) {
  for (const std::string& name : formulationNames()) EXPECT_EQ(retirement(name), "");
  EXPECT_EQ(retirement("printd"), "");
}

}  // namespace
}  // namespace mems_stiction
