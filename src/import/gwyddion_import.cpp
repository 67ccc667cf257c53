#include "import/format_readers.hpp"

#include <dlfcn.h>
#include <string.h>

#include <filesystem>
#include <fstream>

#include "files/child_process.hpp"
#include "files/interruption.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReader = "read_by_gwyddion";
constexpr int kHasNoReaders = 127;  ///< exit status, also where its libraries are missing

/// The program beside this library, or in the package's folder there; empty where it was not built.
std::string builtReader() {
  Dl_info place{};
  if (dladdr(reinterpret_cast<const void*>(&channelsByGwyddion), &place) == 0 ||
      place.dli_fname == nullptr)
    return "";
  const fs::path folder = fs::absolute(place.dli_fname).parent_path();
  for (const fs::path& reader : {folder / kReader, folder / "mems_stiction" / kReader}) {
    std::error_code error;
    if (fs::is_regular_file(reader, error)) return reader.string();
  }
  return "";
}

/// The last line: what was said before is of Gwyddion's libraries.
std::string lastLine(const fs::path& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// No display, one thread (threads take longer to start than a small file takes to read), and a
/// home without plugins.
std::vector<std::string> readerEnvironment(const std::string& home) {
  return environmentWithout({"DISPLAY", "WAYLAND_DISPLAY", "XDG_CONFIG_HOME", "LANGUAGE", "HOME",
                             "LC_ALL", "OMP_NUM_THREADS"},
                            {"HOME=" + home, "LC_ALL=C.UTF-8", "OMP_NUM_THREADS=1"});
}

/// The .gwy container that Gwyddion's libraries make of the file. @throw FileError naming the file
std::string containerOf(const std::string& path, const ImportOptions& options) {
  const std::string reader =
      options.gwyddion_reader.empty() ? builtReader() : options.gwyddion_reader;
  if (reader.empty()) {
    throw NoFormatOfGwyddion(
        path +
        ": needs Gwyddion's libraries to be read, which this build was made without (Debian "
        "packages: gwyddion libgwyddion20-dev libgtk2.0-dev libgtkglext1-dev; then build again)");
  }
  const PrivateFolder folder;
  const fs::path target = folder.path() / "scan.gwy";
  const fs::path log = folder.path() / "log";
  const ChildResult result =
      runChild({reader, fs::absolute(path).string(), target.string()},
               readerEnvironment(folder.path().string()), log.string(), options.timeout);
  if (!result.started || result.exit_code == kHasNoReaders) {
    throw NoFormatOfGwyddion(
        path +
        ": needs Gwyddion's readers to be read, which are not installed (Debian package: "
        "gwyddion)");
  }
  if (result.timed_out) {
    throw FileError(path + ": gwyddion did not finish within " + numberText(options.timeout) +
                    " s and was stopped");
  }
  if (result.signal != 0) {
    throw FileError(path + ": gwyddion crashed on this file (" + strsignal(result.signal) +
                    "): it is damaged");
  }
  if (result.exit_code != 0 || !fs::exists(target)) {
    std::string cause = lastLine(log);
    if (cause.find("failed to report error") != std::string::npos) {
      cause =
          "it is of a known format, but cut off, damaged, or without an image; gwyddion does not "
          "say which";
    }
    const std::string text =
        path + ": gwyddion cannot read it: " +
        (cause.empty() ? "exit status " + std::to_string(result.exit_code) : cause);
    if (cause.find("No module can load this file type") != std::string::npos)
      throw NoFormatOfGwyddion(text);
    throw FileError(text);
  }
  return readFileBytes(target.string());
}

}  // namespace

std::vector<FileChannel> channelsByGwyddion(const std::string& path, const ImportOptions& options) {
  const std::string container = containerOf(path, options);
  try {
    std::vector<FileChannel> channels = parseGwy(container);
    // Masks are Gwyddion's way to mark what was not measured: nothing to be said.
    for (FileChannel& channel : channels) channel.notes.clear();
    return channels;
  } catch (const FileError& error) {
    throw FileError(path + ": what gwyddion made of it cannot be read: " + error.what());
  }
}

}  // namespace mems_stiction
