#include "row_states.hpp"

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kChecksum = "file_checksum";

std::string sizeAndTime(const std::string& size, const std::string& time) {
  return size + " bytes of " + time;
}

/// None of a file with a damaged line: who joins it says so.
std::vector<RowTexts> soundRows(const std::string& path) {
  try {
    return rowTextsOf(path);
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

/// Where the first row of a key stands, and its checksums.
struct Seen {
  std::string shard, row, checksums;
};

/// @throw FileError if an earlier row of the same key has other checksums
void requireSame(std::map<std::string, Seen>& seen, const std::string& key, const Seen& now,
                 const std::string& what) {
  const auto [place, is_first] = seen.emplace(key, now);
  const Seen& before = place->second;
  if (is_first || before.checksums == now.checksums) return;
  throw FileError(now.shard + ": row " + now.row + " is of another state of " + what +
                  " than row " + before.row + " of " + before.shard +
                  ": run both shards again, they predict anew what has changed");
}

}  // namespace

RowFields stateFields(const ScanState& state) {
  RowFields fields;
  visitScanStateFields(state, [&](const Figure& figure, const auto& value) {
    fields.emplace_back(figure.name, value);
  });
  return fields;
}

std::map<std::string, std::string> stateUnits() {
  std::map<std::string, std::string> units;
  const ScanState none;
  visitScanStateFields(none, [&](const Figure& figure, const auto&) {
    if (*figure.unit != '\0') units[figure.name] = figure.unit;
  });
  return units;
}

std::string changeSince(const RowTexts& row, const ScanState& now) {
  if (row.count(kChecksum) == 0) {
    throw FileError("row " + textOf(row, "number") +
                    " does not say which state of its file it is of (no " + kChecksum +
                    "): rows of an earlier version; write another file");
  }
  const std::string before = textOf(row, kChecksum);
  if (now.file.checksum.empty()) return "";
  if (before.empty()) return "there is such a file now";
  if (before != now.file.checksum) {
    return "it was " + sizeAndTime(textOf(row, "file_size"), textOf(row, "file_time")) +
           ", now it is " + sizeAndTime(std::to_string(now.file.size), now.file.time);
  }
  if (textOf(row, "sidecar_checksum") != now.sidecar_checksum)
    return "the settings beside it are others";
  if (textOf(row, "settings_file_checksum") != now.settings_file_checksum) {
    return "a file that the settings name is another (counter_surface/file, or a mask or polygon)";
  }
  return "";
}

bool isGone(const RowTexts& row, const ScanState& now) {
  return now.file.checksum.empty() && !textOf(row, kChecksum).empty();
}

std::vector<std::string> requireOneState(const std::vector<std::string>& shards) {
  std::vector<std::string> gone;
  std::map<std::string, Seen> files;
  std::map<std::string, Seen> settings_files;
  for (const std::string& shard : shards) {
    for (const RowTexts& row : soundRows(shard)) {
      if (row.count(kChecksum) == 0) continue;
      const std::string file = textOf(row, "file");
      const std::string number = textOf(row, "number");
      const std::string sidecar = textOf(row, "sidecar_checksum");
      const std::string of_settings = textOf(row, "settings_file_checksum");
      requireSame(settings_files, "", {shard, number, of_settings},
                  "the files that the settings name");
      const bool is_new = files.count(file) == 0;
      requireSame(files, file, {shard, number, textOf(row, kChecksum) + sidecar}, file);
      if (!is_new) continue;
      const ScanState now = scanState(file, textOf(row, "scan").empty(), of_settings);
      if (isGone(row, now))
        gone.push_back(file + ": is no longer there; its rows stay as they were");
      const std::string change = changeSince(row, now);
      if (change.empty()) continue;
      throw FileError(shard + ": " + file + " has changed since its row " + number +
                      " was written (" + change +
                      "): run this shard again, it predicts anew what has changed");
    }
  }
  return gone;
}

}  // namespace mems_stiction
