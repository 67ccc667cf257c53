#pragma once

/// @file
/// Which contents were published, also by earlier runs: a text file that grows by a line for each,
/// and that a kill at any moment leaves readable. One process has it at a time.
///
///     SeenContents seen(path);
///     if (!seen.knows(key)) { seen.noteSending(...); publish(); seen.notePublished(...); }
///
/// A line with the stamp is written before a scan is published, and another one when the scan must
/// have left the process: publishing only queues it. A kill between both repeats the scan with its
/// stamp and loses none.

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
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
  /// With which an earlier run was about to publish this content [ns]; 0 if none was.
  std::uint64_t stampOf(const std::string& key) const;

  /// Writes that a content is about to be published, and what else is due.
  /// - @p scan_stamp that it is published with [ns]
  /// @return as of writeWaiting()
  std::string noteSending(const std::string& key, std::uint64_t scan_stamp);
  /// - @p key of the content
  /// - @p scan_stamp that it was published with [ns]
  void notePublished(const std::string& key, std::uint64_t scan_stamp, const std::string& name,
                     const FileStamp& stamp);
  /// A file that is not to be published.
  void notePassed(const std::string& name, const FileStamp& stamp);
  /// All that lies there at the first start has been passed over or is to be published.
  void noteBegun();
  /// Writes what was noted, and what a full disk has kept before; of scans that were published only
  /// those that have left. @return an empty text, or why it cannot be
  std::string writeWaiting();

 private:
  void readAll();
  void noteLine(const std::string& line);
  std::string lineOf(const std::string& word, const std::string& key, std::uint64_t scan_stamp,
                     const std::string& name, const FileStamp& stamp);
  std::string write();

  std::string path_;
  int descriptor_ = -1;
  bool is_first_start_ = true;
  std::uint64_t size_ = 0;  ///< of whole lines [bytes]
  std::string waiting_;     ///< lines that are not written yet
  /// Lines of scans that may still be on their way, with the time when they will have left.
  std::deque<std::pair<std::chrono::steady_clock::time_point, std::string>> on_their_way_;
  std::unordered_map<std::string, std::uint64_t> sending_;  ///< stamps of contents [ns]
  std::unordered_set<std::string> keys_;
  std::unordered_map<std::string, FileStamp> files_;  ///< by contentHash() of the name
  std::vector<std::uint64_t> stamps_;
};

}  // namespace mems_stiction
