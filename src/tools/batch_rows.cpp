#include "batch_rows.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

#include "csv_text.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr auto kReplaceBadBytes = nlohmann::json::error_handler_t::replace;
/// What each row of JSON begins with.
constexpr std::string_view kJsonStart = "{\"number\":";
constexpr InputKind kRows = {"a table of rows", std::uint64_t{4} << 30};
constexpr InputKind kSettings = {"the settings of rows", std::uint64_t{1} << 28};

std::string jsonText(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, kReplaceBadBytes);
}

std::string csvCell(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    const double number = value.get<double>();
    return std::isnan(number) ? "nan" : number > 0.0 ? "inf" : "-inf";
  }
  if (!value.is_string()) return jsonText(value);
  return csvText(value.get<std::string>());
}

/// The number that a row begins with; 0 if it does not.
std::size_t numberOf(const std::string& line, RowFormat format) {
  if (format == RowFormat::kJsonLines && !startsWith(line, kJsonStart)) return 0;
  const char* start = line.c_str() + (format == RowFormat::kJsonLines ? kJsonStart.size() : 0);
  return std::strtoull(start, nullptr, 10);
}

/// Lines without their ends; what follows the last end goes to `torn`.
std::vector<std::string> linesOf(const std::string& text, std::string& torn) {
  std::vector<std::string> lines;
  std::size_t start = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  torn = text.substr(start);
  return lines;
}

/// The rows of an earlier call. What begins otherwise is refused before all of it is read.
std::string rowsFrom(const std::string& path, RowFormat format, const std::string& heading) {
  const bool is_json = format == RowFormat::kJsonLines;
  const std::string begin(is_json ? kJsonStart : heading);
  const std::string found = readInputStart(path, kRows, begin.size());
  if (!startsWith(begin, found)) {
    throw FileError(path + (is_json ? ": line 1 is no row"
                                    : ": line 1 has other columns than this run writes: rows of "
                                      "another version or with other "
                                      "options; write another file"));
  }
  return readRows(path);
}

[[noreturn]] void failWithSystemsReason(const std::string& path) {
  throw FileError(path + ": " + std::strerror(errno));
}

}  // namespace

RowFormat rowFormatOf(const std::string& path, const std::string& option) {
  if (endsWith(path, ".csv")) return RowFormat::kCsv;
  if (endsWith(path, ".jsonl") || endsWith(path, ".ndjson")) return RowFormat::kJsonLines;
  throw OptionsError({option + ": '" + path + "' is not allowed, must end in .csv or .jsonl"});
}

std::vector<std::string> columnsOf(const RowFields& fields) {
  std::vector<std::string> columns;
  for (const auto& field : fields) columns.push_back(field.first);
  return columns;
}

std::string rowText(const RowFields& fields, RowFormat format,
                    const std::vector<std::string>& columns) {
  if (format == RowFormat::kJsonLines) {
    std::string line;
    for (const auto& [name, value] : fields)
      line += (line.empty() ? "{\"" : ",\"") + name + "\":" + jsonText(value);
    return line + "}\n";
  }
  return csvLine(columns, ',', [&](const std::string& column) {
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const auto& candidate) {
      return candidate.first == column;
    });
    return field != fields.end() ? csvCell(field->second) : "";
  });
}

std::string headingText(RowFormat format, const std::vector<std::string>& columns) {
  if (format == RowFormat::kJsonLines) return "";
  return csvLine(columns, ',', [](const std::string& column) { return column; });
}

RowFile::RowFile(const std::string& path, RowFormat format, const std::string& heading,
                 const std::vector<std::size_t>& numbers)
    : path_(path), format_(format), heading_(heading) {
  openLocked();
  try {
    const std::string text = hasRows(path) ? rowsFrom(path, format, heading) : "";
    std::string torn;
    std::vector<std::string> lines = linesOf(text, torn);
    if (!torn.empty() &&
        ::ftruncate(descriptor_, static_cast<off_t>(text.size() - torn.size())) != 0) {
      failWithSystemsReason(path);
    }
    if (lines.empty()) {
      write(heading);
    } else if (!heading.empty()) {
      lines.erase(lines.begin());
    }
    takeUp(std::move(lines), numbers);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

RowFile::~RowFile() { ::close(descriptor_); }

void RowFile::openLocked() {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) failWithSystemsReason(path_);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw FileError(path_ + ": another program is writing it");
}

void RowFile::takeUp(std::vector<std::string> lines, const std::vector<std::size_t>& numbers) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t number = numberOf(lines[i], format_);
    const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(earlier_.size());
    const auto found = std::lower_bound(numbers.begin(), end, number);
    if (found != end && *found == number) {
      earlier_[static_cast<std::size_t>(found - numbers.begin())] = std::move(lines[i]);
      is_replaced_ = true;
    } else if (end != numbers.end() && *end == number) {
      earlier_.push_back(std::move(lines[i]));
    } else {
      throw FileError(
          path_ + ": line " + std::to_string(i + (heading_.empty() ? 1 : 2)) +
          " is not a row of this shard: continue with the same --shard, or write another file");
    }
  }
  done_ = earlier_.size();
}

void RowFile::write(const std::string& text) const {
  if (!writeAll(descriptor_, text)) failWithSystemsReason(path_);
}

void RowFile::append(const std::string& line) {
  write(line);
  ++done_;
}

void RowFile::replace(std::size_t place, const std::string& line) {
  write(line);
  earlier_[place] = line.substr(0, line.size() - 1);
  is_replaced_ = true;
}

void RowFile::settle() {
  const std::vector<std::string> rows = std::move(earlier_);
  earlier_.clear();
  if (!is_replaced_) return;
  std::string text = heading_;
  for (const std::string& row : rows) text += row + "\n";
  writeFile(path_, text);
  ::close(descriptor_);  // of the file that was there before
  openLocked();
  is_replaced_ = false;
}

std::string settingsPathOf(const std::string& rows_path) { return rows_path + ".settings.yaml"; }

bool hasRows(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw FileError(path + ": is a folder, must be a file");
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return !error && size > 0;
}

std::string readRows(const std::string& path) { return readInput(path, kRows); }

std::string readSettings(const std::string& rows_path) {
  return readInput(settingsPathOf(rows_path), kSettings);
}

void mergeRows(const std::vector<std::string>& shards, const std::string& path, std::size_t total) {
  const RowFormat format = rowFormatOf(path);
  std::string heading;
  std::map<std::size_t, std::string> rows;
  for (const std::string& shard : shards) {
    if (rowFormatOf(shard) != format) throw FileError(shard + ": not of the kind of " + path);
    std::string torn;
    std::vector<std::string> lines = linesOf(readRows(shard), torn);
    if (!torn.empty()) {
      throw FileError(shard +
                      ": the last line is torn: run this shard again, it goes on from there");
    }
    if (format == RowFormat::kCsv && !lines.empty()) {
      if (!heading.empty() && heading != lines.front())
        throw FileError(shard + ": other columns than " + shards.front());
      heading = lines.front();
      lines.erase(lines.begin());
    }
    for (std::string& line : lines) {
      const std::size_t number = numberOf(line, format);
      if (number < 1 || number > total)
        throw FileError(shard + ": a line is not a row: " + line.substr(0, 60));
      if (!rows.emplace(number, std::move(line)).second) {
        throw FileError(shard + ": row " + std::to_string(number) + " is in another shard too");
      }
    }
  }
  if (rows.size() != total) {
    std::size_t missing = 1;
    while (rows.count(missing) != 0) ++missing;
    throw FileError(path + ": not written, " + std::to_string(total - rows.size()) + " of " +
                    std::to_string(total) + " rows are missing, the first of them number " +
                    std::to_string(missing) + ": a shard is not given, or not finished");
  }
  std::string text = heading.empty() ? "" : heading + "\n";
  for (const auto& row : rows) text += row.second + "\n";
  writeFile(path, text);
}

}  // namespace mems_stiction
