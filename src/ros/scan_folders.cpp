#include "ros/scan_folders.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <sstream>
#include <utility>

#include "configuration/named_files.hpp"
#include "errors/one_line.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

bool isBelow(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

std::string unusable(const std::string& key, const std::string& path) {
  return key + ": " + oneLine(path) +
         " cannot be used; predict_scan with the same configuration says why (the node says nothing about what stands "
         "in "
         "a file)";
}

}  // namespace

std::vector<fs::path> scanFolders() {
  std::vector<std::string> names;
  if (const char* stated = std::getenv(kScanFoldersVariable)) {
    std::istringstream stream(stated);
    for (std::string name; std::getline(stream, name, ':');) names.push_back(name);
  } else {
    if (const char* home = std::getenv("HOME")) names.emplace_back(home);
    std::error_code none;
    names.push_back(fs::temp_directory_path(none).string());
  }
  std::vector<fs::path> folders;
  for (const std::string& name : names) {
    std::error_code missing;
    const fs::path folder = fs::canonical(name, missing);
    if (!missing && folder.is_absolute()) folders.push_back(folder);
  }
  return folders;
}

std::vector<std::string> filesElsewhere(const Configuration& configuration, const std::vector<fs::path>& folders) {
  std::vector<std::string> lines;
  for (const auto& [key, path] : filesNamedBy(configuration)) {
    std::error_code failed;
    const fs::path target = fs::weakly_canonical(fs::absolute(path, failed), failed);
    const auto contains = [&target = target](const fs::path& folder) { return isBelow(target, folder); };
    if (!failed && std::any_of(folders.begin(), folders.end(), contains)) continue;
    std::string line = key + ": " + oneLine(path) + " is not allowed, must lie below";
    for (const fs::path& folder : folders) line += " " + folder.string();
    lines.push_back(line + " (the environment variable " + kScanFoldersVariable + " of the node states these folders)");
  }
  return lines;
}

LivePredictor predictorFromFolders(const Configuration& configuration, bool accumulate_deformation) {
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
    const auto named =
        std::find_if(files.begin(), files.end(), [&](const auto& file) { return startsWith(text, file.first + ":"); });
    if (named != files.end()) throw OptionsError({unusable(named->first, named->second)});
    for (const auto& [key, path] : files) lines.push_back(unusable(key, path));
    throw OptionsError(std::move(lines));
  }
}

}  // namespace mems_stiction
