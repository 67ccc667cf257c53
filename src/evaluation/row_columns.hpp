#pragma once

/// @file
/// Which columns a table of predictions gets: named groups of them, single ones, or all that some
/// row has a value for. stiction_batch and export_predictions choose by the same words.

#include <optional>
#include <string>
#include <vector>

namespace mems_stiction {

/// Columns that belong together. A column is of the first group that it fits.
struct ColumnGroup {
  const char* name;
  const char* meaning;
  const char* pattern;  ///< of whole names, a regular expression that C++ and Python read alike
};

const std::vector<ColumnGroup>& columnGroups();

/// All groups with their meanings, for --help.
std::string columnGroupsText();

/// Those of the names that a table gets, in the order of the names; what is wanted, in the order
/// in which it is wanted.
/// @param names all columns
/// @param known those of the names that some row has a value for
/// @param wanted groups and columns with commas between, or "all"; nothing: what is known
/// @throw OptionsError naming --columns and the word that is neither a column nor a group
std::vector<std::string> chosenColumns(const std::vector<std::string>& names,
                                       const std::vector<std::string>& known,
                                       const std::optional<std::string>& wanted);

}  // namespace mems_stiction
