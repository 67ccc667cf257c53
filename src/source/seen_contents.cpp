#include "source/seen_contents.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "errors/one_line.hpp"
#include "files/content_hash.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr char kHeading[] = "mems_stiction scan_source 1\n";
constexpr char kSending[] = "sending";
constexpr char kPublished[] = "published";
constexpr char kPassed[] = "passed";
constexpr char kBegun[] = "begun";

/// After which a scan that was published has left this process: subscribers take milliseconds.
constexpr std::chrono::milliseconds kLeaves{1000};

[[noreturn]] void failOnState(const std::string& path, const std::string& reason) {
  throw FileError("state_file: " + path + ": " + reason);
}

std::vector<std::string> wordsOf(const std::string& line, std::size_t most) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  while (words.size() + 1 < most && line.find(' ', begin) != std::string::npos) {
    const std::size_t end = line.find(' ', begin);
    words.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  words.push_back(line.substr(begin));
  return words;
}

template <typename Number>
bool readInteger(const std::string& word, Number& number) {
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && rest == end && !word.empty();
}

/// - @p begins what the content begins with, or is the beginning of
std::string wholeContent(int descriptor, const std::string& path, const std::string& begins) {
  std::string content;
  char piece[1 << 16];
  for (;;) {
    const ssize_t count = read(descriptor, piece, sizeof piece);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failOnState(path, std::string("cannot be read: ") + std::strerror(errno));
    if (count == 0) return content;
    content.append(piece, static_cast<std::size_t>(count));
    const std::size_t compared = std::min(content.size(), begins.size());
    if (content.compare(0, compared, begins, 0, compared) != 0)
      failOnState(path, "is not a file of scan_source");
  }
}

}  // namespace

SeenContents::SeenContents(const std::string& path) : path_(path) {
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor_ < 0 && errno == EEXIST)
    descriptor_ = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor_ < 0) failOnState(path, std::string("cannot be written: ") + std::strerror(errno));
  try {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      failOnState(path, "another scan_source uses it; give each a file or folder of its own");
    }
    readAll();
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

SeenContents::~SeenContents() {
  for (auto& line : on_their_way_) waiting_ += line.second;
  write();
  close(descriptor_);
}

void SeenContents::readAll() {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode))
    failOnState(path_, "must be a file");
  const std::string heading = kHeading;
  const std::string content = wholeContent(descriptor_, path_, heading);
  if (content.size() < heading.size()) {
    waiting_ = heading;  // a new file, or one whose first line a kill has cut off
    return;
  }
  for (std::size_t begin = heading.size(); begin < content.size();) {
    const std::size_t end = content.find('\n', begin);
    if (end == std::string::npos) break;
    noteLine(content.substr(begin, end - begin));
    begin = end + 1;
  }
  size_ = content.rfind('\n') + 1;
  if (ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) {
    failOnState(path_, std::string("cannot be written: ") + std::strerror(errno));
  }
}

void SeenContents::noteLine(const std::string& line) {
  const std::vector<std::string> words = wordsOf(line, 8);
  std::uint64_t scan_stamp = 0;
  FileStamp stamp;
  const bool is_known =
      words[0] == kSending || words[0] == kPublished || words[0] == kPassed || words[0] == kBegun;
  const bool is_whole = words.size() == 8 && is_known && readInteger(words[2], scan_stamp) &&
                        readInteger(words[4], stamp.size) &&
                        readInteger(words[5], stamp.modified) &&
                        readInteger(words[6], stamp.changed);
  if (!is_whole) {
    failOnState(path_, "has a line that is not scan_source's: " +
                           shortened(oneLine(line), kLongestQuotation));
  }
  if (words[0] == kSending) {
    sending_[words[1]] = scan_stamp;
    stamps_.push_back(scan_stamp);
    return;
  }
  if (words[0] == kBegun) is_first_start_ = false;
  files_[words[3]] = stamp;
  if (words[0] != kPublished) return;
  keys_.insert(words[1]);
  sending_.erase(words[1]);
  stamps_.push_back(scan_stamp);
}

bool SeenContents::knowsFile(const std::string& name, const FileStamp& stamp) const {
  const auto found = files_.find(contentHash(name));
  return found != files_.end() && found->second == stamp;
}

void SeenContents::notePublished(const std::string& key, std::uint64_t scan_stamp,
                                 const std::string& name, const FileStamp& stamp) {
  keys_.insert(key);
  sending_.erase(key);
  stamps_.push_back(scan_stamp);
  on_their_way_.emplace_back(std::chrono::steady_clock::now() + kLeaves,
                             lineOf(kPublished, key, scan_stamp, name, stamp));
}

std::uint64_t SeenContents::stampOf(const std::string& key) const {
  const auto found = sending_.find(key);
  return found == sending_.end() ? 0 : found->second;
}

std::string SeenContents::noteSending(const std::string& key, std::uint64_t scan_stamp) {
  if (stampOf(key) != scan_stamp) {
    sending_[key] = scan_stamp;
    waiting_ +=
        std::string(kSending) + " " + key + " " + std::to_string(scan_stamp) + " - 0 0 0 -\n";
  }
  return writeWaiting();
}

void SeenContents::notePassed(const std::string& name, const FileStamp& stamp) {
  waiting_ += lineOf(kPassed, "-", 0, name, stamp);
}

void SeenContents::noteBegun() {
  is_first_start_ = false;
  waiting_ += lineOf(kBegun, "-", 0, "", {});
}

std::string SeenContents::lineOf(const std::string& word, const std::string& key,
                                 std::uint64_t scan_stamp, const std::string& name,
                                 const FileStamp& stamp) {
  const std::string place = contentHash(name);
  files_[place] = stamp;
  return word + " " + key + " " + std::to_string(scan_stamp) + " " + place + " " +
         std::to_string(stamp.size) + " " + std::to_string(stamp.modified) + " " +
         std::to_string(stamp.changed) + " " + oneLine(name) + "\n";
}

std::string SeenContents::writeWaiting() {
  const auto now = std::chrono::steady_clock::now();
  for (; !on_their_way_.empty() && on_their_way_.front().first <= now; on_their_way_.pop_front()) {
    waiting_ += on_their_way_.front().second;
  }
  return write();
}

std::string SeenContents::write() {
  if (waiting_.empty()) return "";
  // What a full disk has taken of these lines is written over.
  const bool is_written = lseek(descriptor_, static_cast<off_t>(size_), SEEK_SET) >= 0 &&
                          writeAll(descriptor_, waiting_) && fdatasync(descriptor_) == 0;
  if (!is_written) return "state_file: " + path_ + ": cannot be written: " + std::strerror(errno);
  size_ += waiting_.size();
  waiting_.clear();
  return "";
}

}  // namespace mems_stiction
