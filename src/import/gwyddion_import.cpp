#include "import/format_readers.hpp"

#include <string.h>

#include <filesystem>
#include <fstream>

#include "files/child_process.hpp"
#include "files/interruption.hpp"
#include "import/file_bytes.hpp"
#include "import/import_cache.hpp"
#include "import/waiting_gwyddion.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTarget = "scan.gwy";
constexpr const char* kLog = "log";

/// What gwyddion said first, without the file's name and if possible no remark of its libraries; empty if it said nothing.
std::string complaint(const fs::path& log, const std::string& scan_path) {
  std::ifstream stream(log);
  std::string first;
  std::string remark;
  for (std::string line; std::getline(stream, line);) {
    for (const std::string& name : {scan_path + ": ", kWaitingFileName + std::string(": ")}) {
      if (startsWith(line, name)) return line.substr(name.size());
    }
    const bool is_of_library = line.find("-CRITICAL **") != std::string::npos ||
                               line.find("-WARNING **") != std::string::npos || startsWith(line, "(process:") ||
                               startsWith(line, "This indicates a bug") || startsWith(line, "The overwriting error") ||
                               startsWith(line, "Cannot write ");  // the target, after what went wrong before
    if (!line.empty() && !is_of_library && first.empty()) first = line;
    if (remark.empty()) remark = line;
  }
  return first.empty() ? remark : first;
}

/// By a gwyddion that waits, if there is one, else by one of its own.
ChildResult runGwyddion(const fs::path& folder, const std::string& scan_path, const ImportOptions& options) {
  if (options.waiting) {
    if (const auto result = options.waiting->read(folder.string(), scan_path, options.timeout)) return *result;
  }
  return runChild(gwyddionArguments(options.program, (folder / kTarget).string(), scan_path),
                  gwyddionEnvironment(folder.string()), (folder / kLog).string(), options.timeout);
}

/// The .gwy container that the program makes of the file. @throw FileError naming the file
std::string converted(const std::string& path, const ImportOptions& options) {
  const PrivateFolder folder;
  const std::string scan_path = fs::absolute(path).string();
  const ChildResult result = runGwyddion(folder.path(), scan_path, options);
  const fs::path target = folder.path() / kTarget;
  if (!result.started) {
    throw NoFormatOfGwyddion(path + ": needs the program " + options.program +
                             " to be read, which is not installed (Debian package: gwyddion)");
  }
  if (result.timed_out) {
    throw FileError(path + ": gwyddion did not finish within " + numberText(options.timeout) + " s and was stopped");
  }
  if (result.signal != 0) {
    throw FileError(path + ": gwyddion crashed on this file (" + strsignal(result.signal) + "): it is damaged");
  }
  if (result.exit_code != 0 || !fs::exists(target)) {
    std::string cause = complaint(folder.path() / kLog, scan_path);
    if (cause.find("failed to report error") != std::string::npos) {
      cause = "it is of a known format, but cut off, damaged, or without an image; gwyddion does not say which";
    }
    const std::string text = path + ": gwyddion cannot read it: " +
                             (cause.empty() ? "exit status " + std::to_string(result.exit_code) : cause);
    if (cause.find("No module can load this file type") != std::string::npos) throw NoFormatOfGwyddion(text);
    throw FileError(text);
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
    key = importCacheKey(bytes, fs::path(path).extension().string(), options.program, readerVersion());
    if (const auto cached = cachedConversion(key)) return measured(parseGwy(*cached));
  }
  const std::string gwy = converted(path, options);
  try {
    std::vector<FileChannel> channels = measured(parseGwy(gwy));
    if (options.use_cache) cacheConversion(key, gwy);
    return channels;
  } catch (const FileError& error) {
    throw FileError(path + ": what gwyddion made of it cannot be read: " + error.what());
  }
}

}  // namespace mems_stiction
