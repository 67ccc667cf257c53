#include "mems_stiction/configuration/provenance.hpp"

#include <cstdint>
#include <cstdio>

#include "configuration/named_files.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "numeric/words.hpp"
#include "settings/option_values.hpp"

namespace mems_stiction {
namespace {

bool counts(const std::string& key) {
  for (const char* without : {"part/", "limits/", "output/", "half_space/threads"}) {
    if (startsWith(key, without)) return false;
  }
  return true;
}

}  // namespace

void PartOptions::describe(OptionVisitor& visitor) {
  visitor.text("part/id", id,
               "part that scans belong to, where they do not say so; goes into every prediction");
  visitor.text("part/serial", serial, "serial number of the part, where the scan does not say so");
  visitor.text("part/lot", lot, "lot that the wafer is of, where the scan does not say so");
  visitor.text("part/wafer", wafer, "wafer that the part is of, where the scan does not say so");
}

const char* packageVersion() { return MEMS_STICTION_VERSION; }

std::string settingsHash(const Configuration& configuration) {
  std::uint64_t state =
      0xcbf29ce484222325ULL;  // FNV-1a over "key=value" of each setting that counts
  const auto add = [&state](const std::string& line) {
    for (const char character : line)
      state = (state ^ static_cast<unsigned char>(character)) * 0x100000001b3ULL;
  };
  visitValues(configuration, [&add](const std::string& key, const auto& value) {
    if (counts(key)) add(key + "=" + (namesFile(key) ? "" : valueText(value)) + "\n");
  });
  const std::string files = settingsFilesChecksum(configuration);
  if (!files.empty()) add("files=" + files + "\n");
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state));
  return digits;
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
