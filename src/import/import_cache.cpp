#include "import/import_cache.hpp"

#include <stdlib.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "files/content_hash.hpp"
#include "files/output_file.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostCached = std::uintmax_t{1} << 30;  // [bytes]
constexpr const char* kEnding = ".gwy";

/// Path, size and time of the program in PATH: another version may read otherwise.
std::string installed(const std::string& program) {
  const char* path = getenv("PATH");
  std::string folders = program.find('/') == std::string::npos && path != nullptr ? path : "";
  for (std::size_t at = 0; at <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', at), folders.size());
    const std::string candidate = folders.empty() ? program : folders.substr(at, end - at) + "/" + program;
    struct stat status {};
    if (stat(candidate.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
      return candidate + " " + std::to_string(status.st_size) + " " + std::to_string(status.st_mtim.tv_sec) + "." +
             std::to_string(status.st_mtim.tv_nsec);
    }
    at = end + 1;
  }
  return program;
}

struct Cached {
  fs::path path;
  fs::file_time_type time;
  std::uintmax_t size = 0;
};

std::vector<Cached> allCached(const std::string& folder) {
  std::vector<Cached> all;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != kEnding || !entry.is_regular_file(error)) continue;
    all.push_back({entry.path(), entry.last_write_time(error), entry.file_size(error)});
  }
  return all;
}

void removeOldest(const std::string& folder) {
  std::vector<Cached> all = allCached(folder);
  std::uintmax_t total = 0;
  for (const Cached& cached : all) total += cached.size;
  if (total <= kMostCached) return;
  std::sort(all.begin(), all.end(), [](const Cached& a, const Cached& b) { return a.time < b.time; });
  for (const Cached& cached : all) {
    if (total <= kMostCached / 2) return;
    std::error_code ignored;
    fs::remove(cached.path, ignored);
    total -= cached.size;
  }
}

}  // namespace

std::optional<std::string> importCacheFolder() {
  const char* cache = getenv("XDG_CACHE_HOME");
  if (cache != nullptr && cache[0] == '/') return std::string(cache) + "/mems_stiction";
  const char* home = getenv("HOME");
  if (home == nullptr || home[0] != '/') return std::nullopt;
  return std::string(home) + "/.cache/mems_stiction";
}

std::string readerVersion() { return MEMS_STICTION_READERS; }

std::string importCacheKey(const std::string& bytes, const std::string& name_end, const std::string& program,
                           const std::string& readers) {
  return contentHash(contentHash(bytes) + " " + std::to_string(bytes.size()) + " " + name_end + " " +
                     installed(program) + " " + readers);
}

std::optional<std::string> cachedConversion(const std::string& key) {
  const auto folder = importCacheFolder();
  if (!folder) return std::nullopt;
  try {
    std::string text = readFileBytes(*folder + "/" + key + kEnding);
    const std::string stated = text.substr(0, key.size());
    text.erase(0, key.size());
    if (contentHash(text) == stated) return text;
  } catch (const FileError&) {
    // None is cached.
  }
  return std::nullopt;
}

void cacheConversion(const std::string& key, const std::string& gwy) {
  const auto folder = importCacheFolder();
  if (!folder) return;
  std::error_code error;
  fs::create_directories(*folder, error);
  try {
    writeFile(*folder + "/" + key + kEnding, contentHash(gwy) + gwy, OutputSafety::kWhole);
    removeOldest(*folder);
  } catch (const FileError&) {
    // Converted again next time.
  }
}

void clearImportCache() {
  const auto folder = importCacheFolder();
  if (!folder) return;
  for (const Cached& cached : allCached(*folder)) {
    std::error_code ignored;
    fs::remove(cached.path, ignored);
  }
}

}  // namespace mems_stiction
