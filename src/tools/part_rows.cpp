#include "part_rows.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>
#include <type_traits>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/one_line.hpp"
#include "mems_stiction/base/output_file.hpp"
#include "mems_stiction/scan/part_scans.hpp"
#include "mems_stiction/verdict/part_verdict_fields.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr auto kNotStated = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

/// The texts of a row by the names of their columns, whatever the format; empty where there is nothing.
class Row {
 public:
  explicit Row(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}

  std::string text(const std::string& name) const {
    const auto found = texts_.find(name);
    return found == texts_.end() ? "" : found->second;
  }
  double number(const std::string& name) const {
    const std::string value = text(name);
    return value.empty() ? kNotStated : std::strtod(value.c_str(), nullptr);
  }
  std::uint32_t count(const std::string& name) const {
    return static_cast<std::uint32_t>(std::strtoul(text(name).c_str(), nullptr, 10));
  }
  JudgedRatio ratio(const std::string& name) const {
    return {number(name), number(name + "_lower"), number(name + "_upper")};
  }

 private:
  std::map<std::string, std::string> texts_;
};

Row rowOfJson(const std::string& line) {
  std::map<std::string, std::string> texts;
  const nlohmann::json fields = nlohmann::json::parse(line);
  for (const auto& [name, value] : fields.items()) {
    if (!value.is_null()) texts[name] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return Row(std::move(texts));
}

std::vector<Row> rowsOf(const std::string& path) {
  const RowFormat format = rowFormatOf(path);
  std::istringstream stream(readRows(path));
  std::string line;
  std::vector<Row> rows;
  std::vector<std::string> names;
  while (std::getline(stream, line)) {
    if (format == RowFormat::kJsonLines) {
      rows.push_back(rowOfJson(line));
    } else if (names.empty()) {
      names = cellsOf(line);
    } else {
      const std::vector<std::string> cells = cellsOf(line);
      std::map<std::string, std::string> texts;
      for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i) texts[names[i]] = cells[i];
      rows.emplace_back(std::move(texts));
    }
  }
  return rows;
}

Sticks sticksOf(const std::string& text) {
  for (const Sticks sticks : {Sticks::kNo, Sticks::kMarginal, Sticks::kYes}) {
    if (text == sticksText(sticks)) return sticks;
  }
  return Sticks::kUnknown;
}

/// The scans of a bag often have one name: the number of the row tells them apart.
std::string nameOf(const Row& row) { return row.text("scan_name") + " (" + row.text("number") + ")"; }

ScanStatement statementOf(const Row& row) {
  ScanStatement scan;
  scan.scan_name = nameOf(row);
  scan.sticks = sticksOf(row.text("sticks"));
  scan.reason = row.text("sticks").empty() ? "the device is not stated" : row.text("verdict_reason");
  scan.judge = row.text("verdict_by") == judgeText(Judge::kHalfSpace) ? Judge::kHalfSpace : Judge::kPrediction;
  scan.margin = row.ratio("margin");
  scan.peel_number = row.ratio("peel_number");
  scan.margin_transition = row.number("margin_transition");
  scan.place_deviation = row.number("place_deviation");
  scan.contacts = static_cast<int>(row.count("asperity_count"));
  scan.regime_flags = row.count("regime_flags");
  return scan;
}

template <typename Value>
nlohmann::json jsonOf(const Value& value) {
  if constexpr (std::is_same_v<Value, Sticks>) {
    return sticksText(value);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return oneLine(value);
  } else {
    return value;
  }
}

RowFields fieldsOf(std::size_t number, const PartKey& key, const PooledVerdict& part) {
  RowFields fields = {{"number", number},
                      {"part_id", oneLine(key.part_id)},
                      {"serial_id", oneLine(key.serial_id)},
                      {"settings_hash", key.settings_hash}};
  visitPartVerdictFields(
      part, [&](const std::string& name, const auto& value, const char*) { fields.emplace_back(name, jsonOf(value)); });
  fields.emplace_back("regime_flag_names", regimeFlagNames(part.regime_flags));
  std::string said;
  for (const std::string& warning : part.warnings) said += (said.empty() ? "" : "; ") + oneLine(warning);
  fields.emplace_back("warnings", said);
  return fields;
}

}  // namespace

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

std::size_t writeParts(const std::string& rows_path, const std::string& path) {
  const RowFormat format = rowFormatOf(path, "--parts");
  PartScans parts(kNoLimit, kNoLimit);
  for (const Row& row : rowsOf(rows_path)) {
    if (!row.text("reason").empty()) continue;
    parts.add({row.text("part_id"), row.text("serial_id"), row.text("settings_hash")}, row.count("number"),
              statementOf(row));
  }
  std::vector<std::string> columns;
  for (const auto& field : fieldsOf(0, {}, {})) columns.push_back(field.first);
  std::string text = headingText(format, columns);
  std::size_t count = 0;
  for (const auto& [key, verdict] : parts.verdicts()) {
    text += rowText(fieldsOf(++count, key, verdict), format, columns);
  }
  writeFile(path, text);
  return count;
}

}  // namespace mems_stiction
