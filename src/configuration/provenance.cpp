#include "mems_stiction/configuration/provenance.hpp"

#include <cstdint>
#include <cstdio>

#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {
namespace {

/// FNV-1a over "key=value" of each setting that counts.
class SettingsDigest : public OptionVisitor {
 public:
  void number(const std::string& key, double& value, const std::string&, const Range&, const std::string&) override {
    add(key, numberText(value));
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    add(key, std::to_string(value));
  }
  void flag(const std::string& key, bool& value, const std::string&) override { add(key, value ? "true" : "false"); }
  void text(const std::string& key, std::string& value, const std::string&) override { add(key, value); }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>&,
              const std::string&) override {
    add(key, value);
  }

  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state_));
    return digits;
  }

 private:
  static bool counts(const std::string& key) {
    for (const char* without : {"part/", "limits/", "output/", "half_space/threads"}) {
      if (key.rfind(without, 0) == 0) return false;
    }
    return true;
  }

  void add(const std::string& key, const std::string& value) {
    if (!counts(key)) return;
    for (const char character : key + "=" + value + "\n") {
      state_ = (state_ ^ static_cast<unsigned char>(character)) * 0x100000001b3ULL;
    }
  }

  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace

void PartOptions::describe(OptionVisitor& visitor) {
  visitor.text("part/id", id, "part that scans belong to, where they do not say so; goes into every prediction");
  visitor.text("part/serial", serial, "serial number of the part, where the scan does not say so");
  visitor.text("part/lot", lot, "lot that the wafer is of, where the scan does not say so");
  visitor.text("part/wafer", wafer, "wafer that the part is of, where the scan does not say so");
}

const char* packageVersion() { return MEMS_STICTION_VERSION; }

std::string settingsHash(const Configuration& configuration) {
  SettingsDigest digest;
  describeConst(configuration, digest);
  return digest.text();
}

Provenance provenanceOf(const ScanIdentity& identity, const Configuration& configuration) {
  Provenance provenance;
  static_cast<ScanIdentity&>(provenance) = identity;
  const PartOptions& part = configuration.part;
  if (provenance.part_id.empty()) provenance.part_id = part.id;
  if (provenance.serial_id.empty()) provenance.serial_id = part.serial;
  if (provenance.lot_id.empty()) provenance.lot_id = part.lot;
  if (provenance.wafer_id.empty()) provenance.wafer_id = part.wafer;
  provenance.version = packageVersion();
  provenance.settings_hash = settingsHash(configuration);
  return provenance;
}

}  // namespace mems_stiction
