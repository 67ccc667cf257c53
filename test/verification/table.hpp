#pragma once

/// The verification table for people: in a terminal and as a Markdown page.

#include <string>
#include <vector>

#include "verification/row.hpp"

namespace mems_stiction {
namespace verification {

struct Count {
  int rows = 0;
  int out = 0;
};

Count countRows(const std::vector<Section>& sections);

/// "section: quantity" of every row, in order.
std::vector<std::string> rowNames(const std::vector<Section>& sections);

/// What a page must share with the program: of each section its title, the count of its rows and
/// its references.
std::vector<std::string> referencesOf(const std::vector<Section>& sections);

/// The same read back from a page of markdownPage().
std::vector<std::string> referencesOfPage(const std::string& page);

/// Some 112 columns wide; ends with "N rows, N out".
std::string terminalTable(const std::vector<Section>& sections);

/// A line for each section.
std::string markdownPage(const std::vector<Section>& sections);

}  // namespace verification
}  // namespace mems_stiction
