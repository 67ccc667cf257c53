/// doc/parameters.md repeats the settings of scan_source.

#include <gtest/gtest.h>

#include "source/source_options.hpp"
#include "support/documents.hpp"

namespace mems_stiction {
namespace {

TEST(SourceDocuments, ParametersAreThoseOfTheCode) {
  SourceOptions options;
  documents::expectUpToDate(
      MEMS_STICTION_SOURCE_DIR "/doc/parameters.md", "source",
      documents::parameterTables([&](OptionVisitor& visitor) { options.describe(visitor); }));
}

}  // namespace
}  // namespace mems_stiction
