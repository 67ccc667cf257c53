#include "source/folder_watch.hpp"

#include <dirent.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "errors/one_line.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kToldChanges = IN_CREATE | IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB |
                                       IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_ONLYDIR;

/// Who leaves a file open for so long without writing has forgotten it [s].
constexpr std::chrono::seconds kLongestOpen(30);

/// Changes come in bursts: looks are so far apart [s], and so many times what one takes.
constexpr double kBurst = 0.02;
constexpr double kLookShare = 4.0;

std::chrono::steady_clock::duration durationOf(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds));
}

std::int64_t nanosecondsOf(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1000000000 + time.tv_nsec;
}

/// @return false where there is no file
bool readStamp(const std::string& path, FileStamp& stamp) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  stamp.size = static_cast<std::uint64_t>(status.st_size);
  stamp.modified = nanosecondsOf(status.st_mtim);
  stamp.changed = nanosecondsOf(status.st_ctim);
  return true;
}

std::string stateOf(const FoundFile& file) {
  return file.name + ":" + std::to_string(file.stamp.size) + ":" +
         std::to_string(file.stamp.modified) + ";";
}

/// "scan.001", "scan.002": each is a scan, none belongs to another.
bool isNumbered(const std::string& name) {
  const std::string extension = fs::path(name).extension().string();
  return extension.size() > 1 &&
         std::all_of(extension.begin() + 1, extension.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

std::string withoutExtension(const std::string& name) {
  return name.substr(0, name.size() - fs::path(name).extension().string().size());
}

/// The part of a name that the files of one measurement share, as makers name them.
std::string commonPartOf(const std::string& name) {
  const std::size_t own = name.rfind('/') == std::string::npos ? 0 : name.rfind('/') + 1;
  return lowered(name.substr(0, std::min(name.find('.', own), name.find("--", own))));
}

/// Files that may belong to others, by what they share.
struct Neighbours {
  std::map<std::string, std::vector<const FoundFile*>> by_stem, by_common_part;

  explicit Neighbours(const std::vector<FoundFile>& files) {
    for (const FoundFile& file : files) {
      if (isNumbered(file.name)) continue;
      by_stem[withoutExtension(file.name)].push_back(&file);
      by_common_part[commonPartOf(file.name)].push_back(&file);
    }
  }

  /// "a.tiff.yaml" and "a.yaml" of "a.tiff".
  std::string beside(const FoundFile& file) const {
    return statesIn(by_stem, file.name, file) +
           statesIn(by_stem, withoutExtension(file.name), file);
  }
  std::string related(const FoundFile& file) const {
    return isNumbered(file.name) ? beside(file)
                                 : statesIn(by_common_part, commonPartOf(file.name), file);
  }

 private:
  static std::string statesIn(const std::map<std::string, std::vector<const FoundFile*>>& groups,
                              const std::string& key, const FoundFile& own) {
    std::string states;
    const auto found = groups.find(key);
    if (found == groups.end()) return states;
    for (const FoundFile* file : found->second) {
      if (file->name != own.name) states += stateOf(*file);
    }
    return states;
  }
};

}  // namespace

FolderWatch::FolderWatch(std::string folder, bool is_recursive, double settle_time,
                         double poll_period, std::function<bool(const std::string&)> is_scan)
    : folder_(std::move(folder)),
      is_recursive_(is_recursive),
      settle_time_(durationOf(settle_time)),
      poll_period_(poll_period),
      is_scan_(std::move(is_scan)),
      events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      stop_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (stop_ < 0) {
    const int reason = errno;
    if (events_ >= 0) close(events_);
    throw Error(std::string("no event descriptor: ") + std::strerror(reason));
  }
}

FolderWatch::~FolderWatch() {
  if (events_ >= 0) close(events_);
  close(stop_);
}

bool FolderWatch::list(const std::string& folder, const std::string& prefix,
                       std::vector<FoundFile>& files) {
  if (events_ >= 0) {  // before the list: what comes in between is told
    const int number = inotify_add_watch(events_, folder.c_str(), kToldChanges);
    if (number >= 0) watched_[number] = prefix;
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> opened(opendir(folder.c_str()), closedir);
  if (!opened) return false;
  std::vector<std::string> folders;
  for (;;) {
    errno = 0;
    const dirent* entry = readdir(opened.get());
    if (entry == nullptr && errno != 0) return false;
    if (entry == nullptr) break;
    const std::string own = entry->d_name;
    FoundFile file{folder + "/" + own, prefix + own, {}, {}};
    if (readStamp(file.path, file.stamp)) {
      files.push_back(std::move(file));
    } else if (is_recursive_ && own.front() != '.' && entry->d_type != DT_LNK) {
      folders.push_back(own);
    }
  }
  for (const std::string& own : folders) {
    std::error_code unknown;
    const fs::path below = folder + "/" + own;
    if (!fs::is_directory(fs::symlink_status(below, unknown))) continue;
    if (!list(below.string(), prefix + own + "/", files) && errno != ENOENT)
      unread_.push_back(prefix + own + "/");
  }
  return true;
}

std::string FolderWatch::look() {
  const Clock::time_point begin = Clock::now();
  std::vector<FoundFile> files;
  unread_.clear();
  errno = 0;
  if (!list(folder_, "", files))
    return oneLine(folder_) + ": cannot be read: " + std::strerror(errno);
  std::sort(files.begin(), files.end(),
            [](const auto& one, const auto& other) { return one.name < other.name; });
  const Neighbours neighbours(files);
  std::map<std::string, Entry> before;
  std::swap(before, entries_);
  for (const FoundFile& file : files) {
    if (!is_scan_(file.name)) continue;
    const auto known = before.find(file.name);
    if (known != before.end()) entries_.insert(before.extract(known));
    FoundFile scan = file;
    scan.beside = neighbours.beside(file);
    update(scan, neighbours.related(file));
  }
  for (auto& one : before) {
    const bool is_unread =
        std::any_of(unread_.begin(), unread_.end(),
                    [&](const std::string& folder) { return one.first.rfind(folder, 0) == 0; });
    if (is_unread && one.second.is_settled) {
      entries_.insert(std::move(one));
    } else if (!is_unread && !one.second.is_settled) {
      ++gone_;
    }
  }
  looked_ = Clock::now();
  last_look_ = std::chrono::duration<double>(looked_ - begin).count();
  return "";
}

void FolderWatch::update(const FoundFile& file, const std::string& related) {
  const auto [place, is_new] = entries_.try_emplace(file.name);
  Entry& entry = place->second;
  const bool is_changed =
      is_new || entry.file.stamp != file.stamp || entry.file.beside != file.beside;
  const bool may_be_complete = entry.is_settled && entry.is_refused && entry.related != related;
  if (is_changed || may_be_complete) {
    entry.last_change = Clock::now();
    entry.is_settled = false;
  }
  entry.file = file;
  entry.related = related;
  entry.is_open = open_.count(file.name) != 0;
}

FolderWatch::Clock::time_point FolderWatch::wholeAt(const Entry& entry) const {
  return entry.last_change +
         (entry.is_open ? std::max<Clock::duration>(settle_time_, kLongestOpen) : settle_time_);
}

std::vector<FoundFile> FolderWatch::waiting() const {
  std::vector<FoundFile> files;
  for (const auto& [name, entry] : entries_) {
    if (!entry.is_settled) files.push_back(entry.file);
  }
  std::stable_sort(files.begin(), files.end(), [](const auto& one, const auto& other) {
    return one.stamp.modified < other.stamp.modified;
  });
  return files;
}

std::vector<FoundFile> FolderWatch::whole() const {
  const Clock::time_point now = Clock::now();
  std::vector<FoundFile> files = waiting();
  files.erase(
      std::remove_if(files.begin(), files.end(),
                     [&](const FoundFile& file) { return wholeAt(entries_.at(file.name)) > now; }),
      files.end());
  return files;
}

void FolderWatch::settle(const FoundFile& file, bool is_refused) {
  Entry& entry = entries_.at(file.name);
  entry.is_settled = true;
  entry.is_refused = is_refused;
}

void FolderWatch::putBack(const FoundFile& file) {
  entries_.at(file.name).last_change = Clock::now();
}

bool FolderWatch::isUnchanged(const FoundFile& file) {
  FileStamp stamp;
  return readStamp(file.path, stamp) && stamp == file.stamp;
}

void FolderWatch::readEvents() {
  alignas(inotify_event) std::array<char, 1 << 16> bytes;
  for (;;) {
    const ssize_t count = read(events_, bytes.data(), bytes.size());
    if (count <= 0) return;
    for (ssize_t at = 0; at < count;) {
      inotify_event event;
      std::memcpy(&event, bytes.data() + at, sizeof event);
      const char* own = bytes.data() + at + sizeof event;
      at += static_cast<ssize_t>(sizeof event + event.len);
      if ((event.mask & IN_Q_OVERFLOW) != 0) open_.clear();
      if ((event.mask & IN_IGNORED) != 0) watched_.erase(event.wd);
      const auto folder = watched_.find(event.wd);
      if (folder == watched_.end() || event.len == 0) continue;
      const std::string name = folder->second + own;
      if ((event.mask & IN_MODIFY) != 0) open_.insert(name);
      if ((event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE)) != 0)
        open_.erase(name);
    }
  }
}

void FolderWatch::wait(double longest) {
  const Clock::time_point now = Clock::now();
  Clock::time_point until = now + durationOf(std::min(longest, poll_period_));
  for (const auto& [name, entry] : entries_) {
    if (!entry.is_settled && wholeAt(entry) > now) until = std::min(until, wholeAt(entry));
  }
  const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(until - now).count();
  std::array<pollfd, 2> sources = {{{stop_, POLLIN, 0}, {events_, POLLIN, 0}}};
  if (poll(sources.data(), sources.size(), static_cast<int>(milliseconds)) <= 0 ||
      sources[0].revents != 0)
    return;
  const auto rest = looked_ + durationOf(std::max(kBurst, kLookShare * last_look_)) - Clock::now();
  const auto rest_milliseconds = std::chrono::ceil<std::chrono::milliseconds>(rest).count();
  if (rest_milliseconds > 0) poll(sources.data(), 1, static_cast<int>(rest_milliseconds));
  readEvents();
}

void FolderWatch::stop() {
  const std::uint64_t one = 1;
  const ssize_t written = write(stop_, &one, sizeof one);
  static_cast<void>(written);
}

}  // namespace mems_stiction
