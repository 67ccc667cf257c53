#include "part_rows.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "evaluation/part_scans.hpp"
#include "files/output_file.hpp"
#include "row_texts.hpp"
#include "verdict/part_verdict_fields.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr auto kNotStated = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

/// The figures of a row.
class Row {
 public:
  explicit Row(RowTexts texts) : texts_(std::move(texts)) {}

  std::string text(const std::string& name) const { return textOf(texts_, name); }
  double number(const std::string& name) const {
    const std::string value = text(name);
    return value.empty() ? kNotStated : plainStrtod(value.c_str());
  }
  std::uint32_t count(const std::string& name) const {
    return static_cast<std::uint32_t>(std::strtoul(text(name).c_str(), nullptr, 10));
  }
  JudgedRatio ratio(const std::string& name) const {
    return {number(name), number(name + "_lower"), number(name + "_upper")};
  }

 private:
  RowTexts texts_;
};

/// In the order of the rows.
struct ScansOfPart {
  std::vector<RowOfPart> rows;
  std::vector<ScanStatement> statements;
};

Sticks sticksOf(const std::string& text) {
  for (const Sticks sticks : {Sticks::kNo, Sticks::kMarginal, Sticks::kYes}) {
    if (text == sticksText(sticks)) return sticks;
  }
  return Sticks::kUnknown;
}

/// The scans of a bag often have one name: the number of the row tells them apart.
std::string nameOf(const Row& row) {
  return row.text("scan_name") + " (" + row.text("number") + ")";
}

ScanStatement statementOf(const Row& row) {
  ScanStatement scan;
  scan.scan_name = nameOf(row);
  scan.sticks = sticksOf(row.text("sticks"));
  scan.reason = row.text("sticks").empty() ? "the device is not stated" : row.text("reason");
  scan.judge = row.text("verdict_by") == judgeText(Judge::kHalfSpace) ? Judge::kHalfSpace
                                                                      : Judge::kPrediction;
  scan.margin = row.ratio("margin");
  scan.peel_number = row.ratio("peel_number");
  scan.governed_by = row.text("governed_by");
  scan.margin_transition = row.number("margin_transition");
  scan.place_deviation = row.number("place_deviation");
  scan.contacts = static_cast<int>(row.count("pull_off_contact_count"));
  scan.regime_flags = row.count("regime_flags");
  return scan;
}

/// By how much finer steps may exceed a pull-off force that judges, over it: rows do not say it.
constexpr double kStepUncertainty = 0.02;

RowOfPart rowOfPart(const Row& row) {
  RowOfPart of_part;
  of_part.number = row.count("number");
  of_part.flags = row.count("regime_flags");
  if (row.text("verdict_by") != judgeText(Judge::kHalfSpace)) return of_part;
  SolvedHalfSpace& solution = of_part.half_space.emplace();
  solution.status = HalfSpaceStatus::kSolved;
  solution.is_converged = solution.is_resolved = solution.is_step_converged = true;
  solution.pull_off_force = row.number("half_space_pull_off_force");
  solution.pull_off_uncertainty = kStepUncertainty * solution.pull_off_force;
  solution.work_of_adhesion = row.number("half_space_apparent_work_of_adhesion");
  return of_part;
}

RowFields fieldsOf(std::size_t number, const PartKey& key, const PooledVerdict& part) {
  RowFields fields = {{"number", number},
                      {"part_id", oneLine(key.part_id)},
                      {"serial_id", oneLine(key.serial_id)},
                      {"settings_hash", key.settings_hash}};
  visitPartVerdictFields(part, [&](const Figure& figure, const auto& value) {
    if constexpr (std::is_same_v<decltype(value), const std::string&>) {
      fields.emplace_back(figure.name, oneLine(value));
    } else {
      fields.emplace_back(figure.name, shown(value));
    }
  });
  fields.emplace_back("regime_flag_names", regimeFlagNames(part.regime_flags));
  std::string said;
  for (const std::string& warning : part.warnings)
    said += (said.empty() ? "" : "; ") + oneLine(warning);
  fields.emplace_back("warnings", said);
  return fields;
}

}  // namespace

std::size_t scansWithoutPart(const std::string& rows_path) {
  std::size_t count = 0;
  for (RowTexts& texts : rowTextsOf(rows_path)) {
    const Row row(std::move(texts));
    if (row.text("message").empty() && row.text("part_id").empty() && row.text("serial_id").empty())
      ++count;
  }
  return count;
}

std::size_t writeParts(const std::string& rows_path, const std::string& path,
                       const std::function<PartDevice(const std::vector<RowOfPart>&)>& device) {
  const RowFormat format = rowFormatOf(path, "--parts");
  PartScans parts(kNoLimit, kNoLimit);
  std::map<PartKey, ScansOfPart> scans_of;
  for (RowTexts& texts : rowTextsOf(rows_path)) {
    const Row row(std::move(texts));
    if (!row.text("message").empty()) continue;
    const PartKey key{row.text("part_id"), row.text("serial_id"), row.text("settings_hash")};
    if (!parts.add(key, row.count("number"), statementOf(row))) continue;
    scans_of[key].rows.push_back(rowOfPart(row));
    scans_of[key].statements.push_back(statementOf(row));
  }
  const std::vector<std::string> columns = columnsOf(fieldsOf(0, {}, {}));
  std::string text = headingText(format, columns);
  std::size_t count = 0;
  for (auto& [key, by_scans] : parts.verdicts()) {
    const ScansOfPart& scans = scans_of.at(key);
    const PartDevice found = device(scans.rows);
    PooledVerdict verdict =
        found.verdict ? pooledVerdictOf(scans.statements, *found.verdict) : by_scans;
    verdict.warnings.insert(verdict.warnings.end(), found.warnings.begin(), found.warnings.end());
    text += rowText(fieldsOf(++count, key, verdict), format, columns);
  }
  writeFile(path, text);
  return count;
}

}  // namespace mems_stiction
