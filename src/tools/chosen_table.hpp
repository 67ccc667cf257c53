#pragma once

/// The table that stiction_batch writes for --columns and --excel: columns of its rows, as
/// export_predictions writes them. The rows themselves, with which a later call goes on, are beside
/// the table.

#include <optional>
#include <string>
#include <vector>

#include "batch_rows.hpp"

namespace mems_stiction {

/// What of the rows the table has, and how.
struct TableForm {
  std::optional<std::string> columns;  ///< as chosenColumns() takes it
  bool is_for_excel = false;           ///< semicolons, decimal commas, a mark of UTF-8 before all

  bool isAsked() const { return columns.has_value() || is_for_excel; }
};

/// TABLE.rows.csv, or TABLE.rows.jsonl of a table of JSON lines.
/// @throw OptionsError for a name that no rows have
std::string rowsPathOf(const std::string& table);

/// Where the rows are that a call wrote to this path: there, or beside the table.
std::string rowsBehind(const std::string& path);

/// Before the work.
/// @param names every column of the rows
/// @throw OptionsError for unknown columns, and for a spreadsheet of JSON lines; FileError if
/// something else would be lost to the table
void checkTable(const std::string& table, const TableForm& form,
                const std::vector<std::string>& names);

/// Writes the table from the rows beside it.
/// @param sample a row with all columns of the rows, whose values have the types of the columns
/// @return how many columns it has. @throw FileError
std::size_t writeTable(const std::string& table, const TableForm& form, const RowFields& sample);

}  // namespace mems_stiction
