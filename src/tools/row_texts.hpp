#pragma once

/// What rowText() has written, read back.

#include <map>
#include <string>
#include <vector>

#include "batch_rows.hpp"

namespace mems_stiction {

/// The texts of a row by the names of their columns, whatever the format; none where there is
/// nothing.
using RowTexts = std::map<std::string, std::string>;

/// Empty where there is nothing.
std::string textOf(const RowTexts& row, const std::string& name);

/// - @p columns CSV only @throw nlohmann::json::exception for what is no row of JSON
RowTexts rowTextsOf(const std::string& line, RowFormat format,
                    const std::vector<std::string>& columns);

/// All rows of a file, by the columns that it names. @throw FileError
std::vector<RowTexts> rowTextsOf(const std::string& path);

/// A line of CSV as rowText() writes it, in its cells.
std::vector<std::string> cellsOf(const std::string& line);

}  // namespace mems_stiction
