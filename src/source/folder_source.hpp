#pragma once

/// @file
/// The door `folder`: publishes each content that an instrument's program writes into a folder
/// once, also after a restart.

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <thread>

#include "mems_stiction/import/scan_file.hpp"
#include "source/folder_watch.hpp"
#include "source/name_rules.hpp"
#include "source/scan_publisher.hpp"
#include "source/seen_contents.hpp"
#include "source/source_accounting.hpp"
#include "source/source_options.hpp"

namespace mems_stiction {

/// Works on a thread of its own.
class FolderSource {
 public:
  /// - @p node the full name, for the default state file
  /// - @p publisher, @p accounting must outlive this
  /// @throw OptionsError for a folder or state file that is missing or not allowed, or a bad name
  /// pattern.
  /// @throw FileError for a state file that cannot be used.
  FolderSource(const SourceOptions& options, const std::string& node, ScanPublisher& publisher,
               SourceAccounting& accounting);
  /// Finishes the file at hand.
  ~FolderSource();
  FolderSource(const FolderSource&) = delete;
  FolderSource& operator=(const FolderSource&) = delete;

 private:
  void loop();
  /// One look at the folder, and what is whole. @return whether files wait for the node
  bool work();
  void countWaiting();
  void passOver();
  void take(const FoundFile& file);
  /// @throw Error, with a reason to refuse the file
  void read(const FoundFile& file);
  void refuse(const FoundFile& file, const std::string& reason);
  void publish(const FoundFile& file, const std::string& key, ScanFile scan);

  const SourceOptions options_;
  const NameRules rules_;
  ScanPublisher& publisher_;
  SourceAccounting& accounting_;
  SeenContents seen_;
  FolderWatch watch_;
  std::map<std::string, std::string>
      refused_;  ///< why, by name: the same reason again is no other refusal
  std::map<std::string, std::string>
      keys_;                             ///< of the contents that files of this run had, by name
  std::map<std::string, int> attempts_;  ///< of files that cannot be read, by name
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace mems_stiction
