#include "mems_stiction/height_map/gwyddion_import.hpp"

#include <stdlib.h>
#include <string.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "mems_stiction/base/child_process.hpp"
#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// A folder of our own that goes with the object.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string pattern = (fs::temp_directory_path() / "mems_stiction.XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw FileError(pattern + ": the temporary folder cannot be made");
    path_ = pattern;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What gwyddion said first, without the file's name; empty if it said nothing.
std::string complaint(const fs::path& log, const std::string& scan_path) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    if (line.compare(0, scan_path.size() + 2, scan_path + ": ") == 0) line.erase(0, scan_path.size() + 2);
    if (!line.empty()) return line;
  }
  return "";
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool containsAny(const std::string& text, const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(),
                     [&text](const std::string& entry) { return text.find(entry) != std::string::npos; });
}

bool isLength(const GwyChannel& channel) { return channel.unit_xy == "m" && channel.unit_z == "m"; }

/// Lower is likelier to be the height; kOtherSignal is never taken by itself.
enum Likelihood { kSensor, kHeight, kUnknown, kOtherSignal };

Likelihood likelihood(const GwyChannel& channel) {
  const std::string title = lowered(channel.title);
  if (containsAny(title, {"error", "deflection", "amplitude", "phase", "friction", "lateral", "current", "potential",
                          "adhesion", "stiffness", "modulus", "deformation", "dissipation", "indentation", "peak force",
                          "peakforce", "intensity"})) {
    return kOtherSignal;
  }
  if (containsAny(title, {"zsensor", "z sensor", "z-sensor", "height sensor", "heightsensor", "z height"})) {
    return kSensor;
  }
  if (title == "z" || containsAny(title, {"height", "topo", "depth", "surface", "z-axis", "z axis"})) return kHeight;
  return kUnknown;
}

std::string name(const GwyChannel& channel) {
  return std::to_string(channel.id) + ": " + (channel.title.empty() ? "(no title)" : channel.title);
}

/// "0: Height [m], 1: Phase [deg]"
std::string list(const std::vector<GwyChannel>& channels) {
  std::string text;
  for (const GwyChannel& channel : channels) {
    text +=
        (text.empty() ? "" : ", ") + name(channel) + " [" + (channel.unit_z.empty() ? "no unit" : channel.unit_z) + "]";
  }
  return text;
}

}  // namespace

std::vector<GwyChannel> channelsByGwyddion(const std::string& path, const ImportOptions& options) {
  const PrivateFolder folder;
  const std::string scan_path = fs::absolute(path).string();
  const fs::path converted = folder.path() / "scan.gwy";
  const fs::path log = folder.path() / "log";
  // No display is needed, and none may be touched. gwyddion reads modules from its HOME and writes settings to it.
  const std::vector<std::string> environment =
      environmentWithout({"DISPLAY", "WAYLAND_DISPLAY", "HOME", "XDG_CONFIG_HOME", "LC_ALL", "LANGUAGE"},
                         {"HOME=" + folder.path().string(), "LC_ALL=C.UTF-8"});
  const ChildResult result =
      runChild({options.program, "--no-log-to-file", "--convert-to-gwy=" + converted.string(), scan_path}, environment,
               log.string(), options.timeout);
  if (!result.started) {
    throw FileError(path + ": needs the program " + options.program +
                    " to be read, which is not installed (Debian package: gwyddion)");
  }
  if (result.timed_out) {
    throw FileError(path + ": gwyddion did not finish within " + numberText(options.timeout) + " s and was stopped");
  }
  if (result.signal != 0) {
    throw FileError(path + ": gwyddion crashed on this file (" + strsignal(result.signal) + "): it is damaged");
  }
  if (result.exit_code != 0 || !fs::exists(converted)) {
    const std::string cause = complaint(log, scan_path);
    throw FileError(path + ": gwyddion cannot read it: " +
                    (cause.empty() ? "exit status " + std::to_string(result.exit_code) : cause));
  }
  try {
    return readGwyFile(converted.string());
  } catch (const FileError& error) {
    const std::string text = error.what();
    throw FileError(path + ": what gwyddion made of it cannot be read: " + text.substr(text.find(": ") + 2));
  }
}

std::size_t chooseHeightChannel(const std::vector<GwyChannel>& channels, const std::string& wanted) {
  if (channels.empty()) throw FileError("the file has no image channel");
  if (!wanted.empty()) {
    for (const bool by_number : {true, false}) {
      for (std::size_t i = 0; i < channels.size(); ++i) {
        if (wanted != (by_number ? std::to_string(channels[i].id) : channels[i].title)) continue;
        if (isLength(channels[i])) return i;
        throw FileError("the channel " + name(channels[i]) +
                        " is not in metres along x, y and z; there are: " + list(channels));
      }
    }
    throw FileError("there is no channel '" + wanted + "'; there are: " + list(channels));
  }
  std::size_t best = channels.size();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!isLength(channels[i]) || likelihood(channels[i]) == kOtherSignal) continue;
    if (best == channels.size() || likelihood(channels[i]) < likelihood(channels[best])) best = i;
  }
  if (best == channels.size()) {
    throw FileError("the file has no channel of heights in metres over metres; there are: " + list(channels));
  }
  return best;
}

HeightMap surfaceOfChannel(const GwyChannel& channel) {
  if (channel.values.rows < 2 || channel.values.cols < 2) {
    throw FileError("the channel " + name(channel) + " has only " + std::to_string(channel.values.cols) + " x " +
                    std::to_string(channel.values.rows) + " pixels");
  }
  try {
    return {channel.values, channel.width / channel.values.cols, channel.height / channel.values.rows};
  } catch (const SurfaceError& error) {
    throw FileError("the channel " + name(channel) + ": " + error.what());
  }
}

ImportedScan importChannel(const std::string& path, const std::vector<GwyChannel>& channels,
                           const std::string& wanted) {
  try {
    const GwyChannel& channel = channels.at(chooseHeightChannel(channels, wanted));
    return {surfaceOfChannel(channel), name(channel)};
  } catch (const FileError& error) {
    throw FileError(path + ": " + error.what());
  }
}

ImportedScan importByGwyddion(const std::string& path, const ImportOptions& options) {
  return importChannel(path, channelsByGwyddion(path, options), options.channel);
}

}  // namespace mems_stiction
