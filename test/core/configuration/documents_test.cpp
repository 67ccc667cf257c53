/// Pages of doc/ that repeat what the code says.

#include "support/documents.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "paper/approach_search.hpp"

namespace mems_stiction {
namespace {

const std::string kDocuments = MEMS_STICTION_DOC_DIR;

void describe(OptionVisitor& visitor) {
  Configuration configuration;
  configuration.describe(visitor);
}

TEST(Documents, ParametersAreThoseOfTheCode) {
  documents::expectUpToDate(kDocuments + "/parameters.md", "core",
                            documents::parameterTables(describe));
}

/// First and second column of the rows of the page's table of defaults, by key.
std::map<std::string, std::string> defaultsOfSensitivityPage() {
  std::ifstream page(kDocuments + "/sensitivity.md");
  std::map<std::string, std::string> defaults;
  bool is_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) is_table = line == "## The defaults";
    if (!is_table || line.rfind("| `", 0) != 0) continue;
    const std::size_t key_end = line.find("` | ");
    const std::size_t value_end = line.find(" | ", key_end + 4);
    defaults[line.substr(3, key_end - 3)] = line.substr(key_end + 4, value_end - key_end - 4);
  }
  return defaults;
}

/// Every numerical choice has its line on the page of sensitivities, and the line states what the
/// code does.
TEST(Documents, SensitivitiesStateTheDefaultsOfTheCode) {
  const std::map<std::string, std::string> stated = defaultsOfSensitivityPage();
  for (const char* key :
       {"paper/step", "approach/max_steps", "approach/max_contact_fraction",
        "approach/connectivity", "approach/formulation", "approach/deformation",
        "paper/cutoff_distance", "interface/equilibrium_distance", "preprocessing/refine/factor",
        "preprocessing/refine/interpolation", "uncertainty/samples"}) {
    ASSERT_EQ(stated.count(key), 1u) << key << " is missing";
  }
  for (const auto& [key, text] : stated) {
    const std::string expected = documents::defaultText(describe, key);
    ASSERT_FALSE(expected.empty()) << key << " is no setting";
    char* end = nullptr;
    const double number = std::strtod(expected.c_str(), &end);
    if (*end == '\0') {  // a number may be written in more than one way: 1.65e-10, 165.0e-12
      EXPECT_EQ(std::strtod(text.c_str(), nullptr), number) << key;
    } else {
      EXPECT_EQ(text, expected) << key;
    }
  }
  // The automatic step is no default of a field but what 0 is taken for.
  std::ostringstream automatic;
  automatic << "sigma/" << std::lround(1.0 / approachStep(PaperOptions(), 1.0)) << ")";
  EXPECT_NE(stated.at("paper/step").find(automatic.str()), std::string::npos)
      << stated.at("paper/step");
}

}  // namespace
}  // namespace mems_stiction
