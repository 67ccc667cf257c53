/// Slips of a unit are named, with the unit that was meant; real materials and devices are not.

#include "mems_stiction/scan/plausibility.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/scan/configuration_yaml.hpp"

namespace mems_stiction {
namespace {

std::string onlyWarning(const Configuration& configuration) {
  const std::vector<std::string> lines = settingsWarnings(configuration);
  EXPECT_EQ(lines.size(), 1u);
  return lines.empty() ? "" : lines.front();
}

TEST(Plausibility, ASlipOfAUnitIsNamedWithTheUnitThatWasMeant) {
  Configuration configuration;
  configuration.model.interface.work_of_adhesion = 50.0;
  EXPECT_EQ(
      onlyWarning(configuration),
      "interface/work_of_adhesion 50 J/m^2 is outside the usual 1e-06 to 10 J/m^2: probably 50 mJ/m^2; write 0.05");
  configuration = Configuration();
  configuration.model.lower.youngs_modulus = 169.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 169 GPa; write 1.69e+11"), std::string::npos);
  configuration = Configuration();
  configuration.model.upper.hardness = 12.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 12 GPa; write 1.2e+10"), std::string::npos);
  configuration = Configuration();
  configuration.model.interface.insulator_thickness = 100.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 100 nm; write 1e-07"), std::string::npos);
  configuration = Configuration();
  configuration.model.approach.step = 0.1;
  EXPECT_NE(onlyWarning(configuration).find("approach/step 0.1 m is outside the usual"), std::string::npos);
  configuration = Configuration();
  configuration.model.capillary.temperature = 25.0;
  EXPECT_NE(onlyWarning(configuration).find("degrees Celsius; write 298.1"), std::string::npos);
}

TEST(Plausibility, ALoadThatNoAreaCouldCarryIsNamed) {
  Options options;
  Prediction prediction;
  prediction.nominal_area = 36e-12;
  prediction.mechanical_load = 1e-6;
  EXPECT_TRUE(loadWarnings(prediction, options).empty());
  prediction.mechanical_load = 1.0;  // 1 uN given as 1
  const std::vector<std::string> lines = loadWarnings(prediction, options);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("the mechanical load of 1 N is 2.778e+10 Pa on this frame"), std::string::npos) << lines[0];
  EXPECT_EQ(lines[0].find(','), std::string::npos);
}

TEST(Plausibility, NoCommaStandsInAWarning) {  // `rostopic echo -p` puts commas between fields
  Configuration configuration;
  configuration.model.interface.work_of_adhesion = 1e9;
  EXPECT_EQ(onlyWarning(configuration).find(','), std::string::npos);
}

TEST(Plausibility, ShippedMaterialsAndWhatIsNotStatedAreUsual) {
  EXPECT_TRUE(settingsWarnings(Configuration()).empty());
  for (const auto& entry : std::filesystem::directory_iterator(MEMS_STICTION_CONFIG_DIR)) {
    if (entry.path().extension() != ".yaml" || entry.path().filename() == "node.yaml") continue;
    EXPECT_TRUE(settingsWarnings(loadConfiguration(entry.path().string())).empty()) << entry.path();
  }
}

}  // namespace
}  // namespace mems_stiction
