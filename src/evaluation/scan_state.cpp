#include "evaluation/scan_state.hpp"

#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {

ScanState scanState(const std::string& path, bool has_sidecar,
                    const std::string& settings_file_checksum) {
  const std::string sidecar = has_sidecar ? sidecarOf(path) : "";
  return {fileState(path), sidecar.empty() ? "" : fileState(sidecar).checksum,
          settings_file_checksum};
}

}  // namespace mems_stiction
