#include "evaluation/scan_state.hpp"

#include "files/content_hash.hpp"
#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {
namespace {

/// Every setting whose name ends in "file" names one that is read.
class NamedFiles : public OptionVisitor {
 public:
  void number(const std::string&, double&, const std::string&, const Range&, const std::string&) override {}
  void integer(const std::string&, int&, const Range&, const std::string&) override {}
  void flag(const std::string&, bool&, const std::string&) override {}
  void choice(const std::string&, std::string&, const std::vector<std::string>&, const std::string&) override {}
  void text(const std::string& key, std::string& value, const std::string&) override {
    const std::string ending = "file";
    if (value.empty() || key.size() < ending.size()) return;
    if (key.compare(key.size() - ending.size(), ending.size(), ending) != 0) return;
    const std::string sidecar = sidecarOf(value);
    states_ +=
        key + " " + fileState(value).checksum + " " + (sidecar.empty() ? "" : fileState(sidecar).checksum) + "\n";
  }

  std::string checksum() const { return states_.empty() ? "" : contentHash(states_); }

 private:
  std::string states_;
};

}  // namespace

std::string settingsFilesChecksum(const Configuration& configuration) {
  NamedFiles files;
  describeConst(configuration, files);
  return files.checksum();
}

ScanState scanState(const std::string& path, bool has_sidecar, const std::string& settings_file_checksum) {
  const std::string sidecar = has_sidecar ? sidecarOf(path) : "";
  return {fileState(path), sidecar.empty() ? "" : fileState(sidecar).checksum, settings_file_checksum};
}

}  // namespace mems_stiction
