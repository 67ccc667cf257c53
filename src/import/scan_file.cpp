#include "mems_stiction/import/scan_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "errors/one_line.hpp"
#include "files/input_file.hpp"
#include "height_map/unmeasured.hpp"
#include "height_map/validity.hpp"
#include "import/channel_choice.hpp"
#include "import/file_bytes.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "settings/option_values.hpp"
#include "settings/option_yaml.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// Settings, and what the sidecar says of them.
struct Settings {
  ScanOptions options;
  ScanIdentity identity;
  bool has_scale = false;                ///< the sidecar says what a pixel is worth
  std::vector<std::string> empty_parts;  ///< of the sidecar, in words
};

/// Where the sidecar of a scan may be, the one that goes before first.
std::array<std::string, 2> sidecarsOf(const std::string& path) {
  return {path + ".yaml", fs::path(path).replace_extension(".yaml").string()};
}

/// Whatever has the name: a file, a folder, a link that leads nowhere.
bool isThere(const std::string& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// Whether a file states something of a scan and nothing else. "scan.yaml" may be the configuration
/// of anything.
bool looksLikeSidecar(const std::string& path) {
  std::set<std::string> known;
  const auto learn = [&known](const std::string& key, const auto&) { known.insert(key); };
  visitValues(ScanOptions(), learn);
  visitValues(ScanIdentity(), learn);
  try {
    bool has_known = false;
    for (const std::string& key : keysOf(parseYaml(readInput(path, kSettingsInput), path))) {
      const bool is_bare = key.find('/') == std::string::npos;
      if (!is_bare && !startsWith(key, "scan/")) return false;
      has_known = has_known || known.count(is_bare ? "scan/" + key : key) > 0;
    }
    return has_known;
  } catch (const FileError&) {
    return false;
  }
}

/// The sidecar's settings over those given. Both spellings, "pitch_x" and "scan/pitch_x", are the
/// same key.
Settings withSidecar(const std::string& path, const ScanOptions& given,
                     const ScanIdentity& stated = {}) {
  const std::string sidecar = sidecarOf(path);
  Settings settings{given, stated, false, {}};
  if (sidecar.empty()) return settings;
  ScanOptions& options = settings.options;
  std::vector<std::string> lines;
  const YAML::Node tree = parseYaml(readInput(sidecar, kSettingsInput), sidecar);
  settings.empty_parts = emptyPartsOf(tree);
  for (std::string& line : settings.empty_parts) line.insert(0, sidecar + ": ");
  try {
    YAML::Node scan(YAML::NodeType::Map);
    if (tree.IsMap()) {
      for (const auto& entry : tree) {
        const std::string key = entry.first.Scalar();
        const bool is_bare = key != "scan" && key.find('/') == std::string::npos;
        scan.force_insert(is_bare ? "scan/" + key : key, entry.second);
      }
    } else if (!tree.IsNull()) {
      scan = tree;
    }
    const YAML::Node nested = scan["scan"];
    settings.has_scale =
        scan["scan/height_scale"].IsDefined() ||
        (nested.IsDefined() && nested.IsMap() && nested["height_scale"].IsDefined());
    lines = readYaml(scan, [&settings](OptionVisitor& visitor) {
      settings.options.describe(visitor);
      settings.identity.describe(visitor);
    });
  } catch (const YAML::Exception& error) {
    throw FileError(sidecar + ": not a file of settings: " + error.what());
  }
  if (options.height_scale == 0.0)
    lines.emplace_back("scan/height_scale: 0 is not allowed, must not be 0");
  for (std::string& line : identityComplaints(settings.identity, "scan/"))
    lines.push_back(std::move(line));
  for (std::string& line : lines) line.insert(0, sidecar + ": ");
  if (!lines.empty()) throw OptionsError(std::move(lines));
  return settings;
}

/// What a file states goes before the settings, its sidecar before the file.
/// @throw FileError without a file name where file and sidecar both state the unit of the heights
Settings settingsFor(const std::string& path, const FileChannel& channel,
                     const ScanOptions& given) {
  ScanOptions stated = given;
  if (channel.unit_z == "m") {
    stated.height_scale = 1.0;
    stated.height_offset = 0.0;
  }
  const bool has_pitch = channel.unit_xy == "m";
  const bool is_pitch_given = given.pitch_x > 0.0 && given.pitch_y > 0.0;
  if (has_pitch && !(channel.is_pitch_a_guess && is_pitch_given)) {
    stated.pitch_x = channel.width / channel.values.cols;
    stated.pitch_y = channel.height / channel.values.rows;
  }
  Settings settings = withSidecar(path, stated);
  ScanOptions& options = settings.options;
  if (channel.unit_z == "m" && options.height_scale != 1.0) {
    throw FileError("the file states the unit of its heights, its sidecar a height_scale of " +
                    numberText(options.height_scale) +
                    ": heights are in metres already, remove it");
  }
  if (!has_pitch && channel.width > 0.0) {  // in the unit of the values
    const double unit = std::abs(options.height_scale);
    if (!(options.pitch_x > 0.0)) options.pitch_x = channel.width / channel.values.cols * unit;
    if (!(options.pitch_y > 0.0)) options.pitch_y = channel.height / channel.values.rows * unit;
  }
  return settings;
}

/// - @p option with which the user can state it; empty = none
void checkPitchStated(const std::string& path, const ScanOptions& settings,
                      const std::string& option) {
  if (settings.pitch_x != 0.0 && settings.pitch_y != 0.0) return;
  const std::string advice = option.empty() ? "give " : "give " + option + ", or ";
  if (settings.pitch_x != 0.0 || settings.pitch_y != 0.0) {
    const std::string missing = settings.pitch_x != 0.0 ? "pitch_y" : "pitch_x";
    throw FileError(path + ": its " + missing + " is not stated, only the other pitch: " + advice +
                    "scan/" + missing + " where the other is given");
  }
  throw FileError(path + ": its pixel pitch is not stated: " + advice +
                  "scan/pitch_x and scan/pitch_y in the configuration or in " +
                  fs::path(path).filename().string() + ".yaml");
}

/// A pitch that is given by hand and one in the file that differ by more than a hundredth: perhaps
/// a slip.
void notePitch(const FileChannel& channel, const HeightMap& surface,
               std::vector<std::string>& notes) {
  if (channel.unit_xy != "m" || channel.is_pitch_a_guess) return;
  const double stated_x = channel.width / channel.values.cols;
  const double stated_y = channel.height / channel.values.rows;
  const auto differs = [](double taken, double stated) {
    return std::abs(taken - stated) > 0.01 * stated;
  };
  if (!differs(surface.pitchX(), stated_x) && !differs(surface.pitchY(), stated_y)) return;
  notes.push_back("the file states a pitch of " + numberText(stated_x) + " x " +
                  numberText(stated_y) + " m, " + numberText(surface.pitchX()) + " x " +
                  numberText(surface.pitchY()) + " m is given and taken");
}

/// Whether a pitch that is stated (not 0) is another one, by more than a hundredth.
bool isOther(double stated, double taken) {
  return stated > 0.0 && std::abs(stated - taken) > 0.01 * taken;
}

/// What configuration and sidecar state and the file's own statements go before, and what else is
/// odd beside the file.
/// - @p given by the configuration
/// - @p options that go before all of them
void noteUnused(const std::string& path, const FileChannel& channel, const ScanOptions& given,
                const ScanFileOptions& options, const HeightMap& surface,
                std::vector<std::string>& notes) {
  const std::string sidecar = sidecarOf(path);
  const std::string of_stem = sidecarsOf(path)[1];
  if (sidecar.empty() && of_stem != path && isThere(of_stem)) {
    notes.push_back(
        of_stem +
        " is not read as its sidecar: it cannot be read, or has other keys than those of a scan; " +
        fs::path(path).filename().string() + ".yaml is the name of one");
  }
  const Settings beside = withSidecar(path, given);
  notes.insert(notes.end(), beside.empty_parts.begin(), beside.empty_parts.end());
  const ScanOptions& stated = beside.options;
  const auto sourceOf = [&](bool is_of_sidecar) {
    return is_of_sidecar ? sidecar : "the configuration";
  };
  const std::string before =
      options.pitch_option.empty() ? "" : "; " + options.pitch_option + " goes before both";
  if (!(options.pitch_x > 0.0) &&
      (isOther(stated.pitch_x, surface.pitchX()) || isOther(stated.pitch_y, surface.pitchY()))) {
    const bool is_of_sidecar = stated.pitch_x != given.pitch_x || stated.pitch_y != given.pitch_y;
    notes.push_back("the file states a pitch of " + numberText(surface.pitchX()) + " x " +
                    numberText(surface.pitchY()) + " m, which is taken, " +
                    numberText(stated.pitch_x) + " x " + numberText(stated.pitch_y) + " m of " +
                    sourceOf(is_of_sidecar) + " is not" + before);
  }
  const bool is_sidecar_applied = channel.takes_settings;
  if (is_sidecar_applied && channel.unit_z != "m") return;
  const ScanOptions& ignored = is_sidecar_applied ? given : stated;
  const auto note = [&](const char* key, double value, double of_configuration) {
    notes.push_back(std::string(key) + " " + numberText(value) + " of " +
                    sourceOf(value != of_configuration) +
                    " is not applied: the file states the unit of its heights");
  };
  if (ignored.height_scale != 1.0)
    note("scan/height_scale", ignored.height_scale, given.height_scale);
  if (ignored.height_offset != 0.0)
    note("scan/height_offset", ignored.height_offset, given.height_offset);
  if (is_sidecar_applied || std::isnan(ignored.invalid_value)) return;
  notes.push_back("scan/invalid_value " + numberText(ignored.invalid_value) + " of " +
                  sourceOf(ignored.invalid_value != given.invalid_value) +
                  " is not applied: the file's format marks what is missing itself");
}

/// @throw FileError where the file says something of the unit that is not understood, and no
/// setting says more
void checkUnitTold(const FileChannel& channel, const Settings& settings) {
  if (channel.unit_doubt.empty() || settings.has_scale || settings.options.height_scale != 1.0)
    return;
  throw FileError(channel.unit_doubt + ". Or state the unit as scan/height_scale, 1e-9 for nm");
}

HeightMap surfaceOf(const std::string& path, const FileChannel& channel, const ScanOptions& given,
                    const ScanFileOptions& options) {
  if (!channel.takes_settings) {
    const HeightMap surface = surfaceOfChannel(channel);
    return {surface.heights(), options.pitch_x > 0.0 ? options.pitch_x : surface.pitchX(),
            options.pitch_y > 0.0 ? options.pitch_y : surface.pitchY()};
  }
  const Settings stated = settingsFor(path, channel, given);
  checkUnitTold(channel, stated);
  ScanOptions settings = stated.options;
  if (options.pitch_x > 0.0) settings.pitch_x = options.pitch_x;
  if (options.pitch_y > 0.0) settings.pitch_y = options.pitch_y;
  checkPitchStated(path, settings, options.pitch_option);
  return heightMapFromPixels(channel.values, settings);
}

/// @return the surface without what was not measured, and says how many numbers stood for none
HeightMap measuredOnly(const HeightMap& surface, std::vector<std::string>& notes) {
  HeightMap measured = measuredPart(surface);
  if (measured.heights().data == surface.heights().data) return measured;
  const int count = cv::countNonZero(sentinelMask(surface.heights()));
  if (count > 0) notes.push_back(std::to_string(count) + " heights beyond 1e20 m count as missing");
  return measured;
}

/// What a text file does not say of itself, its sidecar or the settings may.
ImportOptions withTextOptions(const std::string& path, const ScanOptions& given,
                              ImportOptions options) {
  options.text = withSidecar(path, given).options.text;
  return options;
}

/// What the file says of itself, and before it what its sidecar says.
ScanIdentity identityOf(const std::string& path, const FileChannel& channel) {
  ScanIdentity stated = channel.identity;
  stated.scan_name = oneLine(fs::path(path).stem().string());
  return withSidecar(path, {}, stated).identity;
}

/// A single channel without a title needs no name.
std::string nameOf(const FileChannel& channel, std::size_t count) {
  return channel.takes_settings && count == 1 && channel.title.empty() ? "" : channelName(channel);
}

/// Adds the name of the file to what is said without it.
template <typename Function>
auto naming(const std::string& path, Function&& function) {
  try {
    return function();
  } catch (const FileError& error) {
    const std::string text = error.what();
    throw FileError(startsWith(text, path) ? text : path + ": " + text);
  } catch (const SurfaceError& error) {
    throw FileError(path + ": " + error.what());
  }
}

}  // namespace

ScanFile openScanFile(const std::string& path, const ScanOptions& scan,
                      const ScanFileOptions& options) {
  return naming(path, [&] {
    const fs::path extension = fs::path(path).extension();
    if (extension == ".yaml" || extension == ".yml")
      throw FileError("is a file of settings, not a scan");
    const std::vector<FileChannel> channels =
        readChannels(path, withTextOptions(path, scan, options.import));
    const std::size_t chosen = chooseHeightChannel(channels, options.import.channel);
    const FileChannel& channel = channels[chosen];
    ScanFile file{surfaceOf(path, channel, scan, options), nameOf(channel, channels.size()),
                  channel.notes, identityOf(path, channel)};
    file.surface = measuredOnly(file.surface, file.notes);
    if (cv::countNonZero(validMask(file.surface.heights())) == 0) {
      throw FileError("has no measured pixel: all of its " + std::to_string(file.surface.cols()) +
                      " x " + std::to_string(file.surface.rows()) + " heights are missing");
    }
    const std::string passed_over =
        options.import.channel.empty() ? passedOver(channels, chosen) : "";
    if (!passed_over.empty()) file.notes.push_back(passed_over);
    const std::string others =
        options.import.channel.empty() ? othersOfOtherSize(channels, chosen) : "";
    if (!others.empty()) file.notes.push_back(others);
    notePitch(channel, file.surface, file.notes);
    noteUnused(path, channel, scan, options, file.surface, file.notes);
    return file;
  });
}

std::vector<ScanChannel> listScanChannels(const std::string& path, const ScanOptions& scan,
                                          const ScanFileOptions& options) {
  return naming(path, [&] {
    const std::vector<FileChannel> channels =
        readChannels(path, withTextOptions(path, scan, options.import));
    if (channels.empty()) throw FileError("the file has no image channel");
    std::vector<ScanChannel> list;
    for (const FileChannel& channel : channels) {
      ScanChannel entry;
      entry.name = nameOf(channel, channels.size());
      entry.rows = channel.values.rows;
      entry.cols = channel.values.cols;
      entry.pitch_x = entry.cols > 0 ? channel.width / entry.cols : 0.0;
      entry.pitch_y = entry.rows > 0 ? channel.height / entry.rows : 0.0;
      entry.unit_xy = channel.unit_xy;
      entry.unit_z = channel.unit_z;
      if (channel.takes_settings) {
        const Settings settings = settingsFor(path, channel, scan);
        const double scale = settings.options.height_scale;
        entry.pitch_x = options.pitch_x > 0.0 ? options.pitch_x : settings.options.pitch_x;
        entry.pitch_y = options.pitch_y > 0.0 ? options.pitch_y : settings.options.pitch_y;
        entry.unit_xy = "m";
        if (channel.unit_z.empty()) entry.unit_z = scale == 1.0 ? "m" : numberText(scale) + " m";
        entry.is_unit_assumed = channel.unit_z.empty() && scale == 1.0 && !settings.has_scale;
      }
      list.push_back(entry);
    }
    try {
      list[chooseHeightChannel(channels, options.import.channel)].is_chosen = true;
    } catch (const FileError&) {
      // None can be taken: the list shows why.
    }
    return list;
  });
}

std::string sidecarOf(const std::string& path) {
  const auto [beside, of_stem] = sidecarsOf(path);
  if (isThere(beside)) return beside;
  return of_stem != path && isThere(of_stem) && looksLikeSidecar(of_stem) ? of_stem : "";
}

std::vector<std::string> withoutSidecars(const std::vector<std::string>& paths) {
  std::set<std::string> sidecars;
  for (const std::string& path : paths) {
    for (const std::string& sidecar : sidecarsOf(path)) {
      if (sidecar != path) sidecars.insert(sidecar);
    }
  }
  std::vector<std::string> scans;
  for (const std::string& path : paths) {
    if (sidecars.count(path) == 0) scans.push_back(path);
  }
  return scans;
}

HeightMap readScanFile(const std::string& path, const ScanOptions& scan,
                       const ScanFileOptions& options) {
  return openScanFile(path, scan, options).surface;
}

}  // namespace mems_stiction
