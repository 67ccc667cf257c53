/// Loaded into the program gwyddion before its own libraries (LD_PRELOAD), so that one start serves many files: where
/// gwyddion would read its first file, it stays, and at the next request makes a copy of itself that reads files. The copy
/// reads on until one fails or crashes, or it has grown large; then the next copy begins as fresh as the first.
///
/// Request, one message: the folder to work in, NUL, the path of the scan, NUL. Answer: the end of the process that read it,
/// as of waitpid().

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace {

constexpr std::size_t kLongestRequest = 16384;
constexpr long kLargestCopy = 512 * 1024;  // [KiB]
char request[kLongestRequest];             // static: the copy's file name must outlive the function

template <typename Function>
Function nextFunction(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// @param flags MSG_PEEK: it stays in the queue, for another process if this one ends now
/// @return false if there will be none
bool nextRequest(int socket, int flags = 0) {
  ssize_t size = -1;
  do {
    size = recv(socket, request, kLongestRequest - 2, flags);
  } while (size < 0 && errno == EINTR);
  if (size <= 0) return false;
  request[size] = request[size + 1] = '\0';
  return true;
}

void dropRequest(int socket) { recv(socket, nullptr, 0, MSG_DONTWAIT); }

bool answer(int socket, int status) { return send(socket, &status, sizeof status, MSG_NOSIGNAL) == sizeof status; }

/// That this process has held [KiB].
long mostMemory() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? usage.ru_maxrss : 0;
}

/// What is said from here on is about this request. @return the file; null if it cannot begin
const char* beginRequest() {
  const char* folder = request;
  const int log = chdir(folder) == 0 ? open("log", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600) : -1;
  if (log < 0) return nullptr;
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  close(log);
  return request + std::strlen(folder) + 1;
}

/// What gwyddion does with a file that it has read, and what it needs to forget it.
class Converter {
 public:
  bool isComplete() const {
    return load_ != nullptr && add_ != nullptr && save_ != nullptr && remove_ != nullptr && unref_ != nullptr;
  }

  void* load(const char* path, int mode, void** error) const { return load_(path, mode, error); }

  /// @return false if it cannot be written
  bool write(void* data, int mode) const {
    add_(data);
    const bool is_written = save_("gwyfile", data, "scan.gwy", mode, nullptr) != 0;
    remove_(data);
    unref_(data);
    return is_written;
  }

 private:
  void* (*load_)(const char*, int, void**) = nextFunction<void* (*)(const char*, int, void**)>("gwy_file_load");
  void (*add_)(void*) = nextFunction<void (*)(void*)>("gwy_app_data_browser_add");
  int (*save_)(const char*, void*, const char*, int,
               void**) = nextFunction<int (*)(const char*, void*, const char*, int, void**)>("gwy_file_func_run_save");
  void (*remove_)(void*) = nextFunction<void (*)(void*)>("gwy_app_data_browser_remove");
  void (*unref_)(void*) = nextFunction<void (*)(void*)>("g_object_unref");
};

/// Shared with the copies: is an answer owed? One that ends between two requests owes none.
bool* sharedDebt() {
  void* page = mmap(nullptr, sizeof(bool), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return page == MAP_FAILED ? nullptr : static_cast<bool*>(page);
}

/// The copy's life. @return what gwyddion makes an error message of: nothing, with `error`
void* readFiles(const Converter& converter, int mode, void** error, volatile bool& is_owed) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int socket = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (socket < 0 || nothing < 0) _exit(127);
  dup2(nothing, STDIN_FILENO);
  is_owed = true;
  for (;;) {
    const char* path = beginRequest();
    if (path == nullptr) _exit(127);
    void* data = converter.load(path, mode, error);
    if (data == nullptr) return nullptr;
    if (!converter.write(data, mode)) _exit(1);
    is_owed = false;
    if (!answer(socket, 0) || mostMemory() > kLargestCopy || !nextRequest(socket, MSG_PEEK)) _exit(0);
    is_owed = true;
    dropRequest(socket);
  }
}

}  // namespace

/// Stands before the function of libgwymodule with this name.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" void* gwy_file_load(const char*, int mode, void** error) {
  const Converter converter;
  volatile bool* is_owed = sharedDebt();
  if (!converter.isComplete() || is_owed == nullptr) _exit(127);
  while (nextRequest(STDIN_FILENO)) {
    *is_owed = true;
    const pid_t copy = fork();
    if (copy == 0) return readFiles(converter, mode, error, *is_owed);
    int status = 127 << 8;
    while (copy > 0 && waitpid(copy, &status, 0) < 0 && errno == EINTR) {
    }
    if (!*is_owed) continue;
    dropRequest(STDIN_FILENO);  // where the copy ended before it did
    if (!answer(STDIN_FILENO, status)) break;
  }
  _exit(0);
}
