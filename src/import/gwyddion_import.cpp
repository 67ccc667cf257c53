#include "mems_stiction/import/gwyddion_import.hpp"

#include <stdlib.h>
#include <string.h>

#include <filesystem>
#include <fstream>

#include "mems_stiction/base/child_process.hpp"
#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/interruption.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/import/file_bytes.hpp"
#include "mems_stiction/import/gwy_file.hpp"
#include "mems_stiction/import/import_cache.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// A folder of our own that goes with the object.
class PrivateFolder {
 public:
  PrivateFolder()
      : scratch_([] {
          std::string pattern = (fs::temp_directory_path() / "mems_stiction.XXXXXX").string();
          if (mkdtemp(pattern.data()) == nullptr) throw FileError(pattern + ": the temporary folder cannot be made");
          return pattern;
        }) {}
  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(scratch_.path(), ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  fs::path path() const { return scratch_.path(); }

 private:
  ScratchPath scratch_;
};

/// What gwyddion said first, without the file's name; empty if it said nothing.
std::string complaint(const fs::path& log, const std::string& scan_path) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    if (line.compare(0, scan_path.size() + 2, scan_path + ": ") == 0) line.erase(0, scan_path.size() + 2);
    if (!line.empty()) return line;
  }
  return "";
}

/// The .gwy container that the program makes of the file. @throw FileError naming the file
std::string converted(const std::string& path, const ImportOptions& options) {
  const PrivateFolder folder;
  const std::string scan_path = fs::absolute(path).string();
  const fs::path target = folder.path() / "scan.gwy";
  const fs::path log = folder.path() / "log";
  // No display is needed, and none may be touched. gwyddion reads modules from its HOME and writes settings to it. Its
  // threads take longer to start than a small file takes to read.
  const std::vector<std::string> environment = environmentWithout(
      {"DISPLAY", "WAYLAND_DISPLAY", "HOME", "XDG_CONFIG_HOME", "LC_ALL", "LANGUAGE", "OMP_NUM_THREADS"},
      {"HOME=" + folder.path().string(), "LC_ALL=C.UTF-8", "OMP_NUM_THREADS=1"});
  const ChildResult result =
      runChild({options.program, "--no-log-to-file", "--convert-to-gwy=" + target.string(), scan_path}, environment,
               log.string(), options.timeout);
  if (!result.started) {
    throw FileError(path + ": needs the program " + options.program +
                    " to be read, which is not installed (Debian package: gwyddion)");
  }
  if (result.timed_out) {
    throw FileError(path + ": gwyddion did not finish within " + numberText(options.timeout) + " s and was stopped");
  }
  if (result.signal != 0) {
    throw FileError(path + ": gwyddion crashed on this file (" + strsignal(result.signal) + "): it is damaged");
  }
  if (result.exit_code != 0 || !fs::exists(target)) {
    const std::string cause = complaint(log, scan_path);
    throw FileError(path + ": gwyddion cannot read it: " +
                    (cause.empty() ? "exit status " + std::to_string(result.exit_code) : cause));
  }
  return readFileBytes(target.string());
}

/// Masks are the program's way to mark what was not measured: nothing to be said.
std::vector<FileChannel> measured(std::vector<FileChannel> channels) {
  for (FileChannel& channel : channels) channel.notes.clear();
  return channels;
}

}  // namespace

std::vector<FileChannel> channelsByGwyddion(const std::string& path, const std::string& bytes,
                                            const ImportOptions& options) {
  std::string key;
  if (options.use_cache) {
    key = importCacheKey(bytes, fs::path(path).extension().string(), options.program);
    if (const auto kept = keptConversion(key)) return measured(parseGwy(*kept));
  }
  const std::string gwy = converted(path, options);
  try {
    std::vector<FileChannel> channels = measured(parseGwy(gwy));
    if (options.use_cache) keepConversion(key, gwy);
    return channels;
  } catch (const FileError& error) {
    throw FileError(path + ": what gwyddion made of it cannot be read: " + error.what());
  }
}

}  // namespace mems_stiction
