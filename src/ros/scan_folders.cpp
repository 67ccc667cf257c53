#include "ros/scan_folders.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <sstream>
#include <utility>

#include "configuration/named_files.hpp"
#include "errors/one_line.hpp"
#include "files/input_file.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

bool isBelow(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

bool isAllowed(const fs::path& path, const std::vector<fs::path>& folders) {
  std::error_code failed;
  const fs::path target = fs::weakly_canonical(fs::absolute(path, failed), failed);
  return !failed && std::any_of(folders.begin(), folders.end(), [&target](const fs::path& folder) {
    return isBelow(target, folder);
  });
}

/// The beginning of a file of text; empty for others, and for what cannot be read.
std::string textStart(const fs::path& path) {
  constexpr std::uint64_t kHeader = 1 << 16;  // [bytes]
  try {
    const std::string start = readInputStart(path.string(), {"a scan", kMaxFileBytes}, kHeader);
    return start.find('\0') == std::string::npos ? start : "";
  } catch (const FileError&) {
    return "";
  }
}

/// A link to elsewhere that may be read with the file: its name begins as the file's, as those of
/// sidecars and of makers' second files do, or stands in the file. Empty if there is none.
std::string linkBeside(const fs::path& path, const std::string& text,
                       const std::vector<fs::path>& folders) {
  const std::string own = path.filename().string();
  const std::string stem = lowered(own.substr(0, std::min(own.find('.'), own.find("--"))));
  std::error_code failed;
  for (fs::directory_iterator entry(path.parent_path(), failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code unknown;
    if (!entry->is_symlink(unknown)) continue;
    const std::string name = entry->path().filename().string();
    const bool may_be_named =
        text.find(entry->is_directory(unknown) ? name + "/" : name) != std::string::npos;
    if ((startsWith(lowered(name), stem) || may_be_named) && !isAllowed(entry->path(), folders))
      return name;
  }
  return "";
}

/// Why what is read with an allowed file may lie elsewhere; empty if nothing may.
std::string leadsElsewhere(const std::string& path, const std::vector<fs::path>& folders) {
  std::error_code failed;
  const fs::path stated = fs::absolute(path, failed);
  const fs::path target = fs::weakly_canonical(stated, failed);
  const std::string text = textStart(target);
  if (text.find("../") != std::string::npos ||
      (startsWith(text, "NRRD") && text.find("\ndata") != std::string::npos)) {
    return " names files of other folders";
  }
  for (const fs::path& file : {stated, target}) {
    const std::string link = linkBeside(file, text, folders);
    if (!link.empty())
      return " has the link " + oneLine(link) + " beside it, which leads elsewhere";
  }
  return "";
}

std::string listOf(const std::vector<fs::path>& folders) {
  std::string list;
  for (const fs::path& folder : folders) list += " " + folder.string();
  return list + " (the environment variable " + kScanFoldersVariable +
         " of the node states these folders)";
}

std::string unusable(const std::string& key, const std::string& path) {
  return key + ": " + oneLine(path) +
         " cannot be used; predict_scan with the same configuration says why (the node says "
         "nothing about what stands "
         "in "
         "a file)";
}

}  // namespace

std::vector<fs::path> scanFolders() {
  std::vector<std::string> names;
  if (const char* stated = std::getenv(kScanFoldersVariable)) {
    std::istringstream stream(stated);
    for (std::string name; std::getline(stream, name, ':');) names.push_back(name);
  } else if (const char* home = std::getenv("HOME")) {
    names.emplace_back(home);
  }
  std::vector<fs::path> folders;
  for (const std::string& name : names) {
    std::error_code missing;
    const fs::path folder = fs::canonical(name, missing);
    if (!missing && folder.is_absolute()) folders.push_back(folder);
  }
  return folders;
}

std::string whyOutside(const std::string& path, const std::vector<fs::path>& folders) {
  return isAllowed(path, folders)
             ? ""
             : oneLine(path) + " is not allowed, must lie below" + listOf(folders);
}

std::string whyElsewhere(const std::string& path, const std::vector<fs::path>& folders) {
  if (!isAllowed(path, folders)) return whyOutside(path, folders);
  const std::string beside = leadsElsewhere(path, folders);
  return beside.empty() ? ""
                        : oneLine(path) + beside + "; allowed is what lies below" + listOf(folders);
}

std::vector<std::string> filesElsewhere(const Configuration& configuration,
                                        const std::vector<fs::path>& folders) {
  std::vector<std::string> lines;
  for (const auto& [key, path] : filesNamedBy(configuration)) {
    const std::string elsewhere = whyElsewhere(path, folders);
    if (!elsewhere.empty()) lines.push_back(key + ": " + elsewhere);
  }
  return lines;
}

LivePredictor predictorFromFolders(const Configuration& configuration,
                                   bool accumulate_deformation) {
  std::vector<std::string> lines = filesElsewhere(configuration, scanFolders());
  if (!lines.empty()) throw OptionsError(std::move(lines));
  const std::vector<std::pair<std::string, std::string>> files = filesNamedBy(configuration);
  try {
    return LivePredictor(configuration, accumulate_deformation);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (files.empty()) throw;
    // The setting that it begins with, or, of a sidecar and the like, all of them.
    const std::string text = error.what();
    const auto named = std::find_if(files.begin(), files.end(), [&](const auto& file) {
      return startsWith(text, file.first + ":");
    });
    if (named != files.end()) throw OptionsError({unusable(named->first, named->second)});
    for (const auto& [key, path] : files) lines.push_back(unusable(key, path));
    throw OptionsError(std::move(lines));
  }
}

}  // namespace mems_stiction
