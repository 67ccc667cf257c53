#include "configuration/named_files.hpp"

#include <algorithm>
#include <type_traits>

#include "files/content_hash.hpp"
#include "files/input_file.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/words.hpp"
#include "settings/option_values.hpp"

namespace mems_stiction {

bool namesFile(const std::string& key) { return endsWith(key, "file"); }

std::vector<std::pair<std::string, std::string>> filesNamedBy(const Configuration& configuration) {
  const bool has_counter_surface = configuration.counter_surface.type == CounterSurfaceType::kFile;
  std::vector<std::pair<std::string, std::string>> files;
  visitValues(configuration, [&](const std::string& key, const auto& value) {
    if constexpr (std::is_same_v<decltype(value), const std::string&>) {
      if (!namesFile(key) || value.empty() ||
          (key == "counter_surface/file" && !has_counter_surface))
        return;
      files.emplace_back(key, value);
    }
  });
  return files;
}

void placeNamedFiles(const std::vector<std::string>& keys, const std::filesystem::path& folder,
                     Configuration& configuration) {
  ValueVisitor visitor([&](const std::string& key, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
      if (!namesFile(key) || value.empty() ||
          std::find(keys.begin(), keys.end(), key) == keys.end())
        return;
      value = (folder / value).string();  // a whole one stays as it is
    }
  });
  configuration.describe(visitor);
}

std::string settingsFilesChecksum(const Configuration& configuration) {
  if (!configuration.files_checksum.empty()) return configuration.files_checksum;
  std::string states;
  for (const auto& [key, path] : filesNamedBy(configuration)) {
    const std::string sidecar = sidecarOf(path);
    states += key + " " + fileState(path).checksum + " " +
              (sidecar.empty() ? "" : fileState(sidecar).checksum) + "\n";
  }
  return states.empty() ? "" : contentHash(states);
}

Configuration withFilesOfNow(Configuration configuration) {
  configuration.files_checksum.clear();
  configuration.files_checksum = settingsFilesChecksum(configuration);
  return configuration;
}

}  // namespace mems_stiction
