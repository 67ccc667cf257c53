#include "row_texts.hpp"

#include <algorithm>
#include <sstream>

namespace mems_stiction {
namespace {

RowTexts textsOfJson(const std::string& line) {
  RowTexts texts;
  const nlohmann::json fields = nlohmann::json::parse(line);
  for (const auto& [name, value] : fields.items()) {
    if (!value.is_null()) texts[name] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return texts;
}

}  // namespace

std::string textOf(const RowTexts& row, const std::string& name) {
  const auto found = row.find(name);
  return found == row.end() ? "" : found->second;
}

RowTexts rowTextsOf(const std::string& line, RowFormat format,
                    const std::vector<std::string>& columns) {
  if (format == RowFormat::kJsonLines) return textsOfJson(line);
  RowTexts texts;
  const std::vector<std::string> cells = cellsOf(line);
  for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i)
    texts[columns[i]] = cells[i];
  return texts;
}

std::vector<RowTexts> rowTextsOf(const std::string& path) {
  const RowFormat format = rowFormatOf(path);
  std::istringstream stream(readRows(path));
  std::vector<RowTexts> rows;
  std::vector<std::string> columns;
  for (std::string line; std::getline(stream, line);) {
    if (format == RowFormat::kCsv && columns.empty()) {
      columns = cellsOf(line);
    } else {
      rows.push_back(rowTextsOf(line, format, columns));
    }
  }
  return rows;
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_mark = line[i] == '"';
    if (is_mark && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[i++];
    } else if (is_mark) {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

}  // namespace mems_stiction
