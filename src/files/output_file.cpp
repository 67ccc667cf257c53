#include "files/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "files/input_file.hpp"
#include "files/interruption.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw FileError(path + ": cannot be written: " + std::strerror(errno));
}

void writeDirectly(const std::string& path, const std::string& bytes) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) fail(path);
  int state = writeAll(descriptor, bytes) ? 0 : -1;
  const int cause = errno;
  if (close(descriptor) != 0 && state == 0) fail(path);
  errno = cause;
  if (state != 0) fail(path);
}

}  // namespace

bool writeAll(int descriptor, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

bool isLonelyPipe(const std::string& path) {
  struct stat status {};
  if (isOpenStream(path) || stat(path.c_str(), &status) != 0) return false;
  return S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode);
}

void writeFile(const std::string& path, const std::string& bytes, OutputSafety safety) {
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (isLonelyPipe(path)) throw FileError(path + ": " + kLonelyPipe);
  if (exists && !S_ISREG(status.st_mode)) {
    writeDirectly(path, bytes);
    return;
  }
  // A link stays a link: the file behind it is replaced.
  std::error_code ignored;
  const std::string target = exists ? std::filesystem::canonical(path, ignored).string() : path;
  int descriptor = -1;
  const ScratchPath scratch([&] {
    // Not mkostemp(): the file is to have the mode that the process's mask gives.
    std::string name;
    for (int attempt = 0; descriptor < 0 && (attempt == 0 || errno == EEXIST); ++attempt) {
      name = (ignored ? path : target) + "." + std::to_string(getpid()) + "." +
             std::to_string(attempt);
      descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (descriptor < 0) fail(path);
    return name;
  });
  const std::string& partial = scratch.path();
  int state = writeAll(descriptor, bytes) ? 0 : -1;
  if (state == 0 && exists) state = fchmod(descriptor, status.st_mode & 07777);
  if (state == 0 && safety == OutputSafety::kOnDisk) state = fsync(descriptor);
  int cause = errno;
  if (close(descriptor) != 0 && state == 0) {
    state = -1;
    cause = errno;
  }
  if (state == 0) {
    state = std::rename(partial.c_str(), (ignored ? path : target).c_str());
    cause = errno;
  }
  if (state == 0) return;
  unlink(partial.c_str());
  errno = cause;
  fail(path);
}

}  // namespace mems_stiction
