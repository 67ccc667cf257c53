#include "mems_stiction/import/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

/// A file open for reading, closed with the object.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : path_(path) {
    // A pipe without a writer would wait for one.
    descriptor_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0) {
      const bool is_missing = errno == ENOENT || errno == ENOTDIR;
      throw FileError(
          path + (is_missing ? ": there is no such file" : std::string(": cannot be opened: ") + std::strerror(errno)));
    }
    struct stat status {};
    const bool is_known = fstat(descriptor_, &status) == 0;
    size_ = static_cast<std::uint64_t>(status.st_size);
    std::string fault;
    if (!is_known) {
      fault = "cannot be read";
    } else if (S_ISDIR(status.st_mode)) {
      fault = "is a folder, not a scan";
    } else if (!S_ISREG(status.st_mode)) {
      fault = "is a pipe, a socket or a device, not a file";
    } else if (size_ == 0) {
      fault = "is empty";
    } else if (size_ > kMaxFileBytes) {
      fault = "has " + std::to_string(size_) + " bytes, more than the " + std::to_string(kMaxFileBytes) + " of a scan";
    }
    if (fault.empty()) return;
    close(descriptor_);
    throw FileError(path + ": " + fault);
  }
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::string bytes(std::uint64_t count) const {
    std::string text(static_cast<std::size_t>(std::min(count, size_)), '\0');
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t got = ::read(descriptor_, text.data() + done, text.size() - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw FileError(path_ + ": cannot be read: " + std::strerror(errno));
      if (got == 0) break;  // became shorter meanwhile
      done += static_cast<std::size_t>(got);
    }
    text.resize(done);
    return text;
  }

 private:
  const std::string& path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace

std::string readFileBytes(const std::string& path) { return OpenFile(path).bytes(kMaxFileBytes); }

std::string readFileStart(const std::string& path, std::size_t count) { return OpenFile(path).bytes(count); }

void checkPixelCount(std::uint64_t cols, std::uint64_t rows) {
  const std::string size = std::to_string(cols) + " x " + std::to_string(rows) + " pixels";
  if (cols == 0 || rows == 0) throw FileError(size + " are no scan");
  if (cols > kMaxPixels / rows) {
    throw FileError(size + " are more than the " + std::to_string(kMaxPixels) + " that a scan may have");
  }
}

}  // namespace mems_stiction
