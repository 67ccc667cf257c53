/// The verification table as a test: every row holds, a false one is noticed, and the page has the
/// references of the program.

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "verification/sections.hpp"
#include "verification/table.hpp"

namespace mems_stiction {
namespace verification {
namespace {

const std::vector<Section>& table() {
  static const std::vector<Section> sections = allSections();
  return sections;
}

/// Exit status of the program.
int verify(const std::string& arguments) {
  const int status = std::system((std::string(MEMS_STICTION_VERIFY) + " " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(VerificationTable, everyRowIsWithinItsTolerance) {
  for (const Section& section : table()) {
    for (const Row& row : section.rows) {
      EXPECT_TRUE(row.isWithin()) << section.title << ": " << row.quantity << ": computed "
                                  << row.computed << ", reference " << row.reference << ", error "
                                  << row.error() << ", tolerance " << row.tolerance << " ("
                                  << row.reason << "), order "
                                  << (row.convergence ? row.convergence->order() : std::nan(""));
    }
  }
}

TEST(VerificationTable, everyRowSaysWhatItIsAndWhy) {
  std::set<std::string> names;
  for (const std::string& name : rowNames(table()))
    EXPECT_TRUE(names.insert(name).second) << name << " twice";
  EXPECT_GT(names.size(), 100u);
  for (const Section& section : table()) {
    for (const Row& row : section.rows) {
      SCOPED_TRACE(section.title + ": " + row.quantity);
      EXPECT_FALSE(row.source.empty());
      EXPECT_FALSE(row.reason.empty());
      EXPECT_GE(row.tolerance, 0.0);
      EXPECT_LT(row.tolerance,
                0.11);  // a published figure of one digit has 0.1; more would judge nothing
      if (!row.convergence) continue;
      EXPECT_GE(row.convergence->resolutions.size(), 3u);
      EXPECT_EQ(row.convergence->errors.size(), row.convergence->resolutions.size());
      EXPECT_FALSE(row.convergence->reason.empty());
    }
  }
}

TEST(VerificationTable, noticesEveryFalsifiedRow) {
  std::vector<Section> sections = table();
  ASSERT_EQ(countRows(sections).out, 0);
  for (Section& section : sections) {
    for (Row& row : section.rows) {
      const Row sound = row;
      // twice the tolerance, since 1 % of the smallest ones is below a double's spacing
      const double wrong_by =
          2.0 * (row.reference == 0.0 ? row.tolerance + 1e-300 : row.tolerance * row.reference);
      for (const double wrong : {row.reference + wrong_by, row.reference - wrong_by,
                                 std::numeric_limits<double>::quiet_NaN()}) {
        row.computed = wrong;
        EXPECT_EQ(countRows(sections).out, 1)
            << section.title << ": " << row.quantity << ": " << wrong;
      }
      row = sound;
      if (row.convergence && row.convergence->least_order > 0.0) {
        for (double& error : row.convergence->errors) error = 1e-3;  // the pitch no longer helps
        EXPECT_EQ(countRows(sections).out, 1) << section.title << ": " << row.quantity;
        row = sound;
      }
    }
  }
}

TEST(VerificationTableEvidence, programFailsOnAFalsifiedRow) {
  const ScratchFolder scratch;
  const std::string name = rowNames(table()).front();
  const std::string page = scratch.file("verification.md");
  const std::string output = " > " + scratch.file("output.txt") + " 2>&1";
  EXPECT_EQ(verify("--falsify '" + name + "' --markdown " + page + output), 1);
  EXPECT_NE(ScratchFolder::read(page).find(", 1 out"), std::string::npos);
  EXPECT_NE(ScratchFolder::read(scratch.file("output.txt")).find("<-- OUT"), std::string::npos);
  EXPECT_NE(ScratchFolder::read(page).find("| **out:** "), std::string::npos);
  EXPECT_EQ(verify("--falsify 'no such row'" + output), 2);
}

TEST(VerificationTable, pageHasTheReferencesOfTheProgram) {
  const std::string page = ScratchFolder::read(MEMS_STICTION_VERIFICATION_PAGE);
  EXPECT_EQ(referencesOfPage(page), referencesOf(table())) << "scripts/verify writes the page anew";
  EXPECT_NE(page.find(", 0 out"), std::string::npos);
}

TEST(Convergence, hasTheOrderOfAPowerLaw) {
  Convergence convergence{"pixels", {10, 20, 40}, {1e-2, 2.5e-3, 6.25e-4}, 2.0, "made so"};
  EXPECT_NEAR(convergence.order(), 2.0, 1e-12);
  convergence.errors = {0.0, 0.0, 0.0};
  EXPECT_TRUE(std::isinf(convergence.order()));
}

TEST(PublishedRow, allowsHalfAUnitOfTheLastDigit) {
  EXPECT_TRUE(published("q", "", "s", 235.6194e-9, "235.619e-9").isWithin());
  EXPECT_FALSE(published("q", "", "s", 235.6196e-9, "235.619e-9").isWithin());
  EXPECT_TRUE(published("q", "", "s", -0.43679049, "-0.436790").isWithin());
  EXPECT_FALSE(published("q", "", "s", -0.4367906, "-0.436790").isWithin());
  EXPECT_NE(published("q", "", "s", 1.0, "0.0756").reason.find("3 published digits"),
            std::string::npos);
}

}  // namespace
}  // namespace verification
}  // namespace mems_stiction
