#include "mems_stiction/import/scan_formats.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/channel_choice.hpp"
#include "mems_stiction/import/file_bytes.hpp"
#include "mems_stiction/import/gwy_file.hpp"
#include "mems_stiction/import/gwyddion_import.hpp"
#include "mems_stiction/import/image_file.hpp"
#include "mems_stiction/import/netcdf_file.hpp"
#include "mems_stiction/import/npy_file.hpp"
#include "mems_stiction/import/sur_file.hpp"
#include "mems_stiction/import/text_grid.hpp"
#include "mems_stiction/import/tiff_file.hpp"
#include "mems_stiction/import/tiff_tags.hpp"
#include "mems_stiction/import/wsxm_file.hpp"
#include "mems_stiction/import/zip_check.hpp"

namespace mems_stiction {
namespace {

using Channels = std::vector<FileChannel>;

bool beginsWithOneOf(const std::string& bytes, std::initializer_list<std::string> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&bytes](const std::string& start) { return bytes.compare(0, start.size(), start) == 0; });
}

std::string extension(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Some instruments write a picture of the scan, with the heights in tags of their own.
Channels readTiff(const std::string& path, const std::string& bytes, const ImportOptions& options) {
  if (hasInstrumentTags(bytes)) return channelsByGwyddion(path, bytes, options);
  Channels channels = parseTiff(bytes);
  const bool is_picture = std::all_of(channels.begin(), channels.end(),
                                      [](const FileChannel& channel) { return channel.values.channels() > 2; });
  if (!is_picture) return channels;
  try {
    Channels inside = channelsByGwyddion(path, bytes, options);
    chooseHeightChannel(inside, options.channel);
    return inside;
  } catch (const FileError&) {
    return channels;  // the choice of the channel says that it is a picture
  }
}

Channels readNetcdf(const std::string& path, const std::string& bytes, const ImportOptions& options) {
  if (auto heights = parseNetcdfHeights(bytes)) return {*heights};
  const std::string unit = gxsmOtherUnit(bytes);
  Channels channels = channelsByGwyddion(path, bytes, options);
  if (unit.empty()) return channels;
  for (FileChannel& channel : channels) channel.unit_z = unit;
  return channels;
}

/// HDF5 holds arrays of any meaning under any names: some instruments' layouts are known to gwyddion, no other is guessed.
Channels readHdf5(const std::string& path, const std::string& bytes, const ImportOptions& options) {
  try {
    return channelsByGwyddion(path, bytes, options);
  } catch (const FileError& error) {
    throw FileError(std::string(error.what()) + " (an HDF5 file: write its array of heights as .npy and give --pitch)");
  }
}

/// OpenCV's and the project's own formats with a signature. @return false if it is none of them
bool readKnown(const std::string& path, const std::string& bytes, const ImportOptions& options, Channels& channels) {
  if (beginsWithOneOf(bytes, {std::string("II*\0", 4), std::string("MM\0*", 4), std::string("II+\0", 4),
                              std::string("MM\0+", 4)})) {
    channels = readTiff(path, bytes, options);
  } else if (beginsWithOneOf(bytes, {"\x89PNG"})) {
    channels = {parsePng(bytes)};
  } else if (beginsWithOneOf(bytes, {"\x76\x2f\x31\x01"})) {
    channels = {parseExr(bytes)};
  } else if (beginsWithOneOf(bytes, {"GWYP"})) {
    channels = parseGwy(bytes, options.ignore_mask);
  } else if (beginsWithOneOf(bytes, {"\x93NUMPY"})) {
    channels = {parseNpy(bytes)};
  } else if (beginsWithOneOf(bytes, {"DIGITAL SURF", "DSCOMPRESSED"})) {
    channels = parseSur(bytes);
  } else if (isWsxmImage(bytes.substr(0, 200))) {
    channels = {parseWsxm(bytes)};
  } else if (beginsWithOneOf(bytes, {"\x89HDF\r\n"})) {
    channels = readHdf5(path, bytes, options);
  } else if (beginsWithOneOf(bytes, {std::string("CDF\1", 4), std::string("CDF\2", 4)})) {
    channels = readNetcdf(path, bytes, options);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::vector<FileChannel> readChannels(const std::string& path, const ImportOptions& options) {
  const std::string bytes = readFileBytes(path);
  Channels channels;
  if (readKnown(path, bytes, options, channels)) return channels;
  const std::string name_end = extension(path);
  for (const char* text : {".txt", ".asc", ".csv", ".xyz"}) {
    if (name_end == text) return {parseTextGrid(bytes)};
  }
  for (const char* image : {".tif", ".tiff", ".png", ".exr", ".npy", ".gwy"}) {
    if (name_end == image) throw FileError("is not a " + name_end.substr(1) + " image: damaged, or misnamed");
  }
  if (beginsWithOneOf(bytes, {"PK\3\4"})) checkZip(bytes);
  return channelsByGwyddion(path, bytes, options);
}

}  // namespace mems_stiction
