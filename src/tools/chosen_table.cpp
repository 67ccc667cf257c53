#include "chosen_table.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "csv_text.hpp"
#include "evaluation/row_columns.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "row_texts.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kByteOrderMark = "\xef\xbb\xbf";  // of UTF-8
/// A text of figures: seconds with all their digits.
constexpr const char* kStamp = "stamp";

bool isThere(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Those of the names that some row has a value for.
std::vector<std::string> knownNames(const std::vector<std::string>& names,
                                    const std::vector<RowTexts>& rows) {
  std::set<std::string> known;
  for (const RowTexts& row : rows) {
    for (const auto& [name, text] : row) {
      if (!text.empty() && text != "nan") known.insert(name);
    }
  }
  std::vector<std::string> found;
  std::copy_if(names.begin(), names.end(), std::back_inserter(found),
               [&](const std::string& name) { return known.count(name) != 0; });
  return found;
}

/// As export_predictions writes it for a spreadsheet. @param sample of its column
std::string excelCell(const std::string& name, std::string text, const nlohmann::json& sample) {
  if (text == "nan") return "";
  if (sample.is_boolean()) return text == "true" ? "1" : text == "false" ? "0" : text;
  if (sample.is_number_float() || name == kStamp) std::replace(text.begin(), text.end(), '.', ',');
  return csvQuoted(text, ';');
}

std::string csvTable(const std::vector<RowTexts>& rows, const std::vector<std::string>& columns,
                     const RowFields& sample, bool is_for_excel) {
  const char separator = is_for_excel ? ';' : ',';
  const std::map<std::string, nlohmann::json> samples(sample.begin(), sample.end());
  std::string text = is_for_excel ? kByteOrderMark : "";
  text += csvLine(columns, separator, [](const std::string& name) { return name; });
  for (const RowTexts& row : rows) {
    text += csvLine(columns, separator, [&](const std::string& name) {
      const std::string cell = textOf(row, name);
      return is_for_excel ? excelCell(name, cell, samples.at(name)) : csvQuoted(cell);
    });
  }
  return text;
}

/// Values keep their types and digits.
std::string jsonTable(const std::string& rows_path, const std::vector<std::string>& columns) {
  std::string text;
  std::istringstream lines(readRows(rows_path));
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json row = nlohmann::json::parse(line);
    RowFields fields;
    for (const std::string& name : columns) {
      if (row.contains(name)) fields.emplace_back(name, row[name]);
    }
    text += rowText(fields, RowFormat::kJsonLines, {});
  }
  return text;
}

}  // namespace

std::string rowsPathOf(const std::string& table) {
  return table + (rowFormatOf(table) == RowFormat::kCsv ? ".rows.csv" : ".rows.jsonl");
}

std::string rowsBehind(const std::string& path) {
  const bool is_table = !isThere(settingsPathOf(path)) && isThere(rowsPathOf(path));
  return is_table ? rowsPathOf(path) : path;
}

void checkTable(const std::string& table, const TableForm& form,
                const std::vector<std::string>& names) {
  if (form.is_for_excel && rowFormatOf(table) != RowFormat::kCsv)
    throw OptionsError({"--excel: " + table + " is no CSV"});
  chosenColumns(names, names, form.columns);
  if (isThere(settingsPathOf(table))) {
    throw FileError(table +
                    ": has whole rows, which a table of --columns or --excel would replace: write "
                    "another file, or make the table by export_predictions");
  }
  if (hasRows(table) && !isThere(rowsPathOf(table))) {
    throw FileError(table + ": exists, and no earlier call has written it, since there is no " +
                    rowsPathOf(table) + ": write another file");
  }
}

std::size_t writeTable(const std::string& table, const TableForm& form, const RowFields& sample) {
  const std::string rows_path = rowsPathOf(table);
  const std::vector<RowTexts> rows = rowTextsOf(rows_path);
  const std::vector<std::string> names = columnsOf(sample);
  const std::vector<std::string> columns =
      chosenColumns(names, knownNames(names, rows), form.columns);
  writeFile(table, rowFormatOf(table) == RowFormat::kCsv
                       ? csvTable(rows, columns, sample, form.is_for_excel)
                       : jsonTable(rows_path, columns));
  return columns.size();
}

}  // namespace mems_stiction
