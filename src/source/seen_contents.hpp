#pragma once

/// @file
/// Which contents were published, also by earlier runs: a text file that grows by a line for each,
/// and that a kill at any moment leaves readable. One process has it at a time.
///
///     SeenContents seen(path);
///     if (!seen.knows(key)) { publish(); seen.note(...); }
///
/// A line is written after its scan was published: a kill between both repeats a scan and loses
/// none.

#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace mems_stiction {

/// By which a file shows that it was written to.
struct FileStamp {
  std::uint64_t size = 0;     ///< [bytes]
  std::int64_t modified = 0;  ///< [ns since 1970]
  std::int64_t changed = 0;   ///< of the name or rights, too [ns since 1970]

  bool operator==(const FileStamp& other) const {
    return size == other.size && modified == other.modified && changed == other.changed;
  }
  bool operator!=(const FileStamp& other) const { return !(*this == other); }
};

/// For one thread.
class SeenContents {
 public:
  /// Makes the file if there is none.
  /// @throw FileError naming it: of another kind, in use by another process, not to be written.
  explicit SeenContents(const std::string& path);
  ~SeenContents();
  SeenContents(const SeenContents&) = delete;
  SeenContents& operator=(const SeenContents&) = delete;

  /// Whether noteBegun() was never called, in whatever run.
  bool isFirstStart() const { return is_first_start_; }
  /// - @p key of a content
  bool knows(const std::string& key) const { return keys_.count(key) != 0; }
  /// Whether the file of this name was noted as it is.
  bool knowsFile(const std::string& name, const FileStamp& stamp) const;
  /// Stamps of all scans that were published [ns].
  const std::vector<std::uint64_t>& stamps() const { return stamps_; }

  /// - @p key of the content
  /// - @p scan_stamp that it was published with [ns]
  void notePublished(const std::string& key, std::uint64_t scan_stamp, const std::string& name,
                     const FileStamp& stamp);
  /// A file that is not to be published.
  void notePassed(const std::string& name, const FileStamp& stamp);
  /// All that lies there at the first start has been passed over or is to be published.
  void noteBegun();
  /// Writes what was noted, and what a full disk has kept before. @return an empty text, or why it
  /// cannot be
  std::string writeWaiting();

 private:
  void readAll();
  void noteLine(const std::string& line);
  void add(const std::string& word, const std::string& key, std::uint64_t scan_stamp,
           const std::string& name, const FileStamp& stamp);

  std::string path_;
  int descriptor_ = -1;
  bool is_first_start_ = true;
  std::uint64_t size_ = 0;  ///< of whole lines [bytes]
  std::string waiting_;     ///< lines that are not written yet
  std::unordered_set<std::string> keys_;
  std::unordered_map<std::string, FileStamp> files_;  ///< by contentHash() of the name
  std::vector<std::uint64_t> stamps_;
};

}  // namespace mems_stiction
