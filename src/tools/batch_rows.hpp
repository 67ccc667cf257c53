#pragma once

/// A file of rows that survives interruption: appended line by line, mended and continued after a
/// kill, joined from shards. Rows begin with their number; CSV has a line of names first.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace mems_stiction {

/// Names and values in the order of the columns. Numbers are written with as few digits as read
/// back to the same.
using RowFields = std::vector<std::pair<std::string, nlohmann::json>>;

enum class RowFormat { kCsv, kJsonLines };

/// By the end of the name: .csv, or .jsonl (.ndjson). @throw OptionsError for other names, naming
/// the option
RowFormat rowFormatOf(const std::string& path, const std::string& option = "--output");

/// The names of the fields.
std::vector<std::string> columnsOf(const RowFields& fields);

/// One line with its end. Numbers that are not finite: nan, inf, -inf in CSV; null in JSON. @param
/// columns CSV only: the cells, empty where the row has no such field
std::string rowText(const RowFields& fields, RowFormat format,
                    const std::vector<std::string>& columns);

/// The CSV line of names; empty for JSON lines.
std::string headingText(RowFormat format, const std::vector<std::string>& columns);

/// The one program that writes the rows of one shard.
class RowFile {
 public:
  /// Opens the file or makes it, locks it, takes off a torn last line and checks that what is there
  /// are the first of these rows, perhaps with others in place of some of them at the end. @param
  /// numbers of the rows of this shard, in order
  /// @throw FileError if it cannot be written, another program writes it, or it has other rows.
  RowFile(const std::string& path, RowFormat format, const std::string& heading,
          const std::vector<std::size_t>& numbers);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Rows that are in the file.
  std::size_t done() const { return done_; }
  /// The rows of earlier calls, by their places among the numbers, until settle().
  const std::vector<std::string>& earlier() const { return earlier_; }
  /// Hands the line to the system in one piece. @throw FileError
  void append(const std::string& line);
  /// Another row in the place of an earlier one: appended, so that an interruption costs nothing.
  /// @throw FileError
  void replace(std::size_t place, const std::string& line);
  /// Puts rows that were replaced into their places, before others are appended. @throw FileError
  void settle();

 private:
  void openLocked();
  void write(const std::string& text) const;
  void takeUp(std::vector<std::string> lines, const std::vector<std::size_t>& numbers);

  std::string path_;
  RowFormat format_;
  std::string heading_;
  int descriptor_ = -1;
  std::size_t done_ = 0;
  std::vector<std::string> earlier_;
  bool is_replaced_ = false;  ///< the file has rows that others stand for
};

/// Where the settings of a file of rows stand, so that rows of different settings never mix.
std::string settingsPathOf(const std::string& rows_path);

/// Whether rows of an earlier call may be there: nothing is read back from a device. @throw
/// FileError for a folder
bool hasRows(const std::string& path);

/// All of the file. @throw FileError
std::string readRows(const std::string& path);

/// All of the settings of these rows. @throw FileError
std::string readSettings(const std::string& rows_path);

/// Joins shards to the file that one run writes, byte for byte.
/// @param total rows that one run writes
/// @throw FileError if rows are torn, missing or there twice.
void mergeRows(const std::vector<std::string>& shards, const std::string& path, std::size_t total);

}  // namespace mems_stiction
