#pragma once

/// @file
/// Which files in a folder are whole and new.
///
/// A file is whole when neither the file nor a sidecar of its name has changed for the settle time,
/// and nobody whom the system tells of (inotify) still writes to it. Each look lists the folder, so
/// that network shares, of whose changes the system tells nothing, work alike, only later.

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "source/seen_contents.hpp"

namespace mems_stiction {

/// A file of the folder.
struct FoundFile {
  std::string path;
  std::string name;  ///< relative to the folder
  FileStamp stamp;
  std::string
      beside;  ///< names, sizes and times of the files that may belong to it, as its sidecar
};

/// For one thread, but for stop().
class FolderWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// - @p settle_time, @p poll_period [s]
  /// - @p is_scan of a relative name
  FolderWatch(std::string folder, bool is_recursive, double settle_time, double poll_period,
              std::function<bool(const std::string&)> is_scan);
  ~FolderWatch();
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// Lists the folder. @return an empty text, or why it cannot be listed: then nothing changes.
  std::string look();
  /// Those that were never settled as they are, the oldest first.
  std::vector<FoundFile> waiting() const;
  /// Those of them that are whole.
  std::vector<FoundFile> whole() const;
  /// Nothing more is to be done with the file as it is.
  /// - @p is_refused it comes back when files of a like name come or change, which it may need
  void settle(const FoundFile& file, bool is_refused);
  /// The file is to be settled anew: it comes back after the settle time.
  void putBack(const FoundFile& file);
  /// Whether the file is as it was when it was found.
  static bool isUnchanged(const FoundFile& file);

  /// Returns when the folder may have changed, a file may have become whole, or the time is over.
  /// - @p longest [s]
  void wait(double longest);
  /// wait() returns at once, from now on. May be called from every thread.
  void stop();

  /// Files that were removed before they were settled.
  std::size_t gone() const { return gone_; }

  /// Whether the system tells of changes.
  bool isTold() const { return !watched_.empty(); }

 private:
  struct Entry {
    FoundFile file;
    std::string related;  ///< state of the files of a like name
    Clock::time_point last_change;
    bool is_open = false;  ///< somebody writes to it
    bool is_settled = false;
    bool is_refused = false;
  };

  bool list(const std::string& folder, const std::string& prefix, std::vector<FoundFile>& files);
  void update(const FoundFile& file, const std::string& related);
  void readEvents();
  Clock::time_point wholeAt(const Entry& entry) const;

  const std::string folder_;
  const bool is_recursive_;
  const Clock::duration settle_time_;
  const double poll_period_;
  const std::function<bool(const std::string&)> is_scan_;
  int events_ = -1;  ///< of inotify
  int stop_ = -1;
  std::map<int, std::string> watched_;    ///< folders by inotify's numbers, relative, "" or "a/b/"
  std::map<std::string, Entry> entries_;  ///< by relative name
  std::vector<std::string> unread_;       ///< sub-folders at the last look: what was there stays
  std::set<std::string> open_;  ///< files that were written to and not closed since, relative
  std::size_t gone_ = 0;
  Clock::time_point looked_;
  double last_look_ = 0.0;  ///< what it took [s]
};

}  // namespace mems_stiction
