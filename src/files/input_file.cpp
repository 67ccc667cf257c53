#include "files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>

#include "files/content_hash.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// What has no size is read in pieces of so many bytes.
constexpr std::uint64_t kPiece = 65536;
/// What may be larger than memory, in pieces of so many.
constexpr std::uint64_t kLargePiece = 1 << 20;
constexpr InputKind kAnyFile = {"a file", std::numeric_limits<std::uint64_t>::max()};

/// A file open for reading, closed with the object.
class OpenFile {
 public:
  OpenFile(const std::string& path, const InputKind& kind) : path_(path) {
    // A pipe without a writer would wait for one.
    descriptor_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0) {
      const int cause = errno;
      const bool is_missing = cause == ENOENT || cause == ENOTDIR;
      struct stat link {};
      if (is_missing && lstat(path.c_str(), &link) == 0)
        throw FileError(path + ": is a link that leads nowhere");
      throw FileError(path + (is_missing
                                  ? ": there is no such file"
                                  : std::string(": cannot be opened: ") + std::strerror(cause)));
    }
    struct stat status {};
    const bool is_known = fstat(descriptor_, &status) == 0;
    size_ = static_cast<std::uint64_t>(status.st_size);
    is_stream_ = kind.takes_open_streams && !S_ISREG(status.st_mode) &&
                 (isOpenStream(path) || path == "/dev/null");
    std::string fault;
    if (!is_known) {
      fault = "cannot be read";
    } else if (S_ISDIR(status.st_mode)) {
      fault = std::string("is a folder, not ") + kind.name;
    } else if (is_stream_) {
      // Its writer is there, and may take its time.
      if (fcntl(descriptor_, F_SETFL, O_RDONLY) != 0)
        fault = std::string("cannot be read: ") + std::strerror(errno);
    } else if (!S_ISREG(status.st_mode)) {
      fault = "is a pipe, a socket or a device, not a file";
    } else if (size_ > kind.max_bytes) {
      fault = "has " + std::to_string(size_) + " bytes, more than the " +
              std::to_string(kind.max_bytes) + " of " + kind.name;
    }
    if (fault.empty()) return;
    close(descriptor_);
    throw FileError(path + ": " + fault);
  }
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  FileState state() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) return {};
    char day[32];
    char time[48];
    struct tm parts {};
    strftime(day, sizeof day, "%Y-%m-%dT%H:%M:%S", gmtime_r(&status.st_mtim.tv_sec, &parts));
    std::snprintf(time, sizeof time, "%s.%09ldZ", day, status.st_mtim.tv_nsec);
    ContentHash hash;
    for (std::string piece = bytes(kLargePiece); !piece.empty(); piece = bytes(kLargePiece))
      hash.add(piece);
    return {size_, time, hash.text()};
  }

  /// The next of them.
  std::string bytes(std::uint64_t count) const {
    const std::uint64_t end = is_stream_ ? count : std::min(count, size_);
    std::string text;
    while (text.size() < end) {
      const std::size_t done = text.size();
      text.resize(is_stream_ ? std::min(end, done + kPiece) : end);
      const ssize_t got = ::read(descriptor_, text.data() + done, text.size() - done);
      const int cause = errno;
      text.resize(done + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
      if (got < 0 && cause == EINTR) continue;
      if (got < 0) throw FileError(path_ + ": cannot be read: " + std::strerror(cause));
      if (got == 0) break;  // the end, or the file became shorter meanwhile
    }
    return text;
  }

 private:
  const std::string& path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  bool is_stream_ = false;
};

}  // namespace

bool isOpenStream(const std::string& path) {
  const auto begins = [&path](const char* start) { return startsWith(path, start); };
  return begins("/dev/std") || begins("/dev/fd/") || begins("/proc/self/fd/");
}

std::string readInput(const std::string& path, const InputKind& kind) {
  std::string text = OpenFile(path, kind).bytes(kind.max_bytes + 1);
  if (text.size() <= kind.max_bytes) return text;
  throw FileError(path + ": has more than the " + std::to_string(kind.max_bytes) + " bytes of " +
                  kind.name);
}

std::string readInputStart(const std::string& path, const InputKind& kind, std::uint64_t count) {
  return OpenFile(path, kind).bytes(count);
}

FileState fileState(const std::string& path) {
  try {
    return OpenFile(path, kAnyFile).state();
  } catch (const FileError&) {
    return {};
  }
}

}  // namespace mems_stiction
