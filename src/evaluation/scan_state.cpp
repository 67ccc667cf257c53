#include "evaluation/scan_state.hpp"

#include <type_traits>

#include "files/content_hash.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/words.hpp"
#include "settings/option_values.hpp"

namespace mems_stiction {

std::vector<std::pair<std::string, std::string>> filesNamedBy(const Configuration& configuration) {
  std::vector<std::pair<std::string, std::string>> files;
  visitValues(configuration, [&](const std::string& key, const auto& value) {
    if constexpr (std::is_same_v<decltype(value), const std::string&>) {
      if (endsWith(key, "file") && !value.empty()) files.emplace_back(key, value);
    }
  });
  return files;
}

std::string settingsFilesChecksum(const Configuration& configuration) {
  std::string states;
  for (const auto& [key, path] : filesNamedBy(configuration)) {
    const std::string sidecar = sidecarOf(path);
    states += key + " " + fileState(path).checksum + " " + (sidecar.empty() ? "" : fileState(sidecar).checksum) + "\n";
  }
  return states.empty() ? "" : contentHash(states);
}

ScanState scanState(const std::string& path, bool has_sidecar, const std::string& settings_file_checksum) {
  const std::string sidecar = has_sidecar ? sidecarOf(path) : "";
  return {fileState(path), sidecar.empty() ? "" : fileState(sidecar).checksum, settings_file_checksum};
}

}  // namespace mems_stiction
