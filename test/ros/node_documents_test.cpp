/// doc/parameters.md repeats the settings of the node.

#include <gtest/gtest.h>

#include "ros/parameters.hpp"
#include "support/documents.hpp"

namespace mems_stiction {
namespace {

TEST(NodeDocuments, ParametersAreThoseOfTheCode) {
  NodeOptions options;
  documents::expectUpToDate(
      MEMS_STICTION_SOURCE_DIR "/doc/parameters.md", "node",
      documents::parameterTables([&](OptionVisitor& visitor) { options.describe(visitor); }));
}

}  // namespace
}  // namespace mems_stiction
