#include "source/folder_source.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "files/content_hash.hpp"
#include "files/input_file.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/own_log.hpp"
#include "ros/scan_folders.hpp"
#include "source/acquisition_stamp.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// How often a file is tried that cannot be read at all: shares are busy, programs lock their
/// files.
constexpr int kMostAttempts = 5;

/// While nobody listens [s].
constexpr double kListenerPeriod = 0.1;

/// Parameters come from anybody in the network: only below these folders is anything read or
/// written.
std::string allowedPath(const std::string& key, const std::string& path) {
  std::error_code failed;
  std::string absolute = fs::weakly_canonical(fs::absolute(path, failed), failed).string();
  const std::string elsewhere = whyOutside(absolute, scanFolders());
  if (!elsewhere.empty()) throw OptionsError({key + ": " + elsewhere});
  return absolute;
}

std::string folderOf(const FolderOptions& options) {
  std::string folder = allowedPath("folder", options.folder);
  std::error_code unknown;
  if (fs::is_directory(folder, unknown)) return folder;
  throw OptionsError(
      {"folder: " + oneLine(options.folder) + " is not allowed, must be a folder that is there"});
}

/// ROS's own folder for what programs leave behind.
std::string rosHome() {
  if (const char* stated = std::getenv("ROS_HOME")) return stated;
  const char* home = std::getenv("HOME");
  return home == nullptr ? "." : std::string(home) + "/.ros";
}

std::string stateFileOf(const FolderOptions& options, const std::string& node) {
  if (!options.state_file.empty()) return allowedPath("state_file", options.state_file);
  std::string name = node;
  std::replace(name.begin(), name.end(), '/', '_');
  const std::string folder = contentHash(folderOf(options)).substr(0, 16);
  return rosHome() + "/scan_source/" + name.substr(std::min<std::size_t>(1, name.size())) + "-" +
         folder + ".seen";
}

/// By which the state file knows a file: another sidecar makes another scan of it.
std::string placeOf(const FoundFile& file) { return file.name + "\n" + file.beside; }

/// What neither the file nor its name states, the parameters do.
void fillUnstated(const ScanIdentity& otherwise, ScanIdentity& identity) {
  for (std::string ScanIdentity::*text :
       {&ScanIdentity::part_id, &ScanIdentity::serial_id, &ScanIdentity::lot_id,
        &ScanIdentity::wafer_id, &ScanIdentity::instrument, &ScanIdentity::operator_name}) {
    if (!isStated(identity.*text)) identity.*text = otherwise.*text;
  }
}

}  // namespace

FolderSource::FolderSource(const SourceOptions& options, const std::string& node,
                           ScanPublisher& publisher, SourceAccounting& accounting)
    : options_(options),
      rules_(options.folder.patterns, options.folder.name_pattern, options.folder.site_scale),
      publisher_(publisher),
      accounting_(accounting),
      seen_(stateFileOf(options.folder, node)),
      watch_(folderOf(options.folder), options.folder.recursive, options.folder.settle_time,
             options.folder.poll_period,
             [this](const std::string& name) { return rules_.isScan(name); }) {
  for (const std::uint64_t stamp : seen_.stamps()) publisher_.reserve(stamp);
  accounting_.show("folder", oneLine(folderOf(options.folder)));
  accounting_.show("state_file", oneLine(stateFileOf(options.folder, node)));
  thread_ = std::thread([this] { loop(); });
}

FolderSource::~FolderSource() {
  stopping_ = true;
  watch_.stop();
  thread_.join();
}

void FolderSource::loop() {
  while (!stopping_) {
    bool is_ahead = false;
    try {
      is_ahead = work();
    } catch (const std::exception& error) {  // whatever it is, the next look may do
      accounting_.hindered(reasonOf(error));
    }
    watch_.wait(is_ahead ? kListenerPeriod : options_.folder.poll_period);
  }
}

bool FolderSource::work() {
  std::string hindered = watch_.look();
  if (hindered.empty() && seen_.isFirstStart()) passOver();
  const std::string failure = seen_.writeWaiting();
  if (hindered.empty()) hindered = failure;
  for (const FoundFile& file : watch_.waiting()) {
    if (seen_.knowsFile(placeOf(file), file.stamp)) watch_.settle(file, false);
  }
  countWaiting();
  bool is_ahead = false;
  for (const FoundFile& file : watch_.whole()) {
    const std::string waits_for = publisher_.waitsFor();
    is_ahead = !waits_for.empty();
    if (is_ahead) hindered = waits_for;
    if (is_ahead || stopping_) break;
    take(file);
    countWaiting();
  }
  accounting_.show("told_by", watch_.isTold() ? "the system and by looks" : "looks");
  accounting_.hindered(hindered);
  return is_ahead;
}

void FolderSource::countWaiting() { accounting_.waits(watch_.waiting().size(), watch_.gone()); }

void FolderSource::passOver() {
  std::vector<FoundFile> old = watch_.waiting();
  if (options_.folder.old_files == OldFiles::kNewest && !old.empty()) old.pop_back();
  if (options_.folder.old_files == OldFiles::kAll) old.clear();
  for (const FoundFile& file : old) seen_.notePassed(placeOf(file), file.stamp);
  seen_.noteBegun();
}

void FolderSource::take(const FoundFile& file) {
  try {
    read(file);
  } catch (const OptionsError& error) {  // a sidecar's lines
    refuse(file, reasonOf(error));
  } catch (const std::exception& error) {
    if (FolderWatch::isUnchanged(file)) {
      refuse(file, reasonOf(error));
    } else {
      watch_.putBack(file);
    }
  }
}

void FolderSource::read(const FoundFile& file) {
  const std::string elsewhere = whyElsewhere(file.path, scanFolders());
  if (!elsewhere.empty()) throw FileError(elsewhere);
  std::string key;
  try {
    key = sha256Text(readFileBytes(file.path));
  } catch (const FileError&) {
    if (++attempts_[file.name] >= kMostAttempts) throw;
    watch_.putBack(file);
    return;
  }
  attempts_.erase(file.name);
  const std::string checksum = key;
  const std::string sidecar = sidecarOf(file.path);
  if (!sidecar.empty()) key += "+" + fileState(sidecar).checksum;
  if (seen_.knows(key)) {
    if (keys_[file.name] != key) accounting_.repeated();
    keys_[file.name] = key;
    watch_.settle(file, false);
    return;
  }
  ScanFileOptions file_options;
  file_options.import.channel = options_.folder.channel;
  ScanFile scan = openScanFile(file.path, options_.scan, file_options);
  if (!FolderWatch::isUnchanged(file) ||
      (!scan.identity.checksum.empty() && scan.identity.checksum != checksum)) {
    watch_.putBack(file);
    return;
  }
  publish(file, key, std::move(scan));
}

void FolderSource::publish(const FoundFile& file, const std::string& key, ScanFile scan) {
  for (const std::string& note : scan.notes) {
    logSoon(ros::console::levels::Info, oneLine(file.name) + ": " + oneLine(note));
  }
  const std::string nameless = rules_.identify(file.name, scan.identity);
  if (!nameless.empty()) {
    logSoon(ros::console::levels::Warn,
            oneLine(file.name) + " " + oneLine(nameless) + ": it is published without");
  }
  fillUnstated(options_.identity, scan.identity);
  const std::vector<std::string> complaints = identityComplaints(scan.identity, "");
  if (!complaints.empty()) throw FileError(complaints.front());
  std::uint64_t stamp = seen_.stampOf(key);
  if (stamp == 0) {
    stamp =
        publisher_.freeStamp(acquisitionStamp(scan.identity.acquisition_time, file.stamp.modified));
  }
  std::string frame = scan.identity.scan_name;
  std::replace(frame.begin(), frame.end(), '\n', ' ');
  accounting_.hindered(seen_.noteSending(key, stamp));
  publisher_.publish(scan.surface, scan.identity, frame, stamp);
  seen_.notePublished(key, stamp, placeOf(file), file.stamp);
  keys_[file.name] = key;
  watch_.settle(file, false);
  accounting_.published(file.name);
}

void FolderSource::refuse(const FoundFile& file, const std::string& reason) {
  watch_.settle(file, true);
  attempts_.erase(file.name);
  const std::string said =
      std::to_string(file.stamp.size) + " " + std::to_string(file.stamp.modified) + " " + reason;
  if (std::exchange(refused_[file.name], said) != said) accounting_.refused(file.name, reason);
}

}  // namespace mems_stiction
