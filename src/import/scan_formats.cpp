
#include <algorithm>

#include <filesystem>

#include "files/content_hash.hpp"
#include "files/interruption.hpp"
#include "files/output_file.hpp"
#include "import/channel_choice.hpp"
#include "import/file_bytes.hpp"
#include "import/file_checks.hpp"
#include "import/file_statements.hpp"
#include "import/format_readers.hpp"
#include "import/nanoscope_check.hpp"
#include "import/plain_number.hpp"
#include "import/stated_twice.hpp"
#include "import/tiff_tags.hpp"
#include "import/zip_check.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

using Channels = std::vector<FileChannel>;

bool beginsWithOneOf(const std::string& bytes, std::initializer_list<std::string> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&bytes](const std::string& start) { return startsWith(bytes, start); });
}

/// Some instruments write a picture of the scan, with the heights in tags of their own.
Channels readTiff(const std::string& path, const std::string& bytes, const ImportOptions& options) {
  if (hasInstrumentTags(bytes)) return channelsByGwyddion(path, options);
  Channels channels = parseTiff(bytes);
  const bool is_picture =
      std::all_of(channels.begin(), channels.end(),
                  [](const FileChannel& channel) { return channel.values.channels() > 2; });
  if (!is_picture) return channels;
  try {
    Channels inside = channelsByGwyddion(path, options);
    chooseHeightChannel(inside, options.channel);
    return inside;
  } catch (const FileError&) {
    return channels;  // the choice of the channel says that it is a picture
  }
}

Channels readNetcdf(const std::string& path, const std::string& bytes,
                    const ImportOptions& options) {
  if (auto heights = parseNetcdfHeights(bytes)) return {*heights};
  const GxsmStatements stated = gxsmStatements(bytes);
  Channels channels = channelsByGwyddion(path, options);
  for (FileChannel& channel : channels) {
    if (!stated.other_unit.empty()) channel.unit_z = stated.other_unit;
    if (stated.pitch_x > 0.0 && channel.unit_xy == "m")
      channel.width = stated.pitch_x * channel.values.cols;
    if (stated.pitch_y > 0.0 && channel.unit_xy == "m")
      channel.height = stated.pitch_y * channel.values.rows;
  }
  return channels;
}

/// Gwyddion's container of another version than the one that is read here: if at all, Gwyddion
/// reads it.
Channels readOtherGwy(const std::string& path, const std::string& bytes,
                      const ImportOptions& options) {
  try {
    Channels channels = channelsByGwyddion(path, options);
    if (channels.empty()) throw FileError("gwyddion finds no image in it");
    return channels;
  } catch (const FileError& error) {
    throw FileError(
        std::string(error.what()) + " (a Gwyddion file of the kind " + bytes.substr(0, 4) +
        ": open it in the Gwyddion that wrote it, and save it as one of version 2, GWYP)");
  }
}

/// Other bytes in place of the file's, which gwyddion can read.
Channels readRewritten(const std::string& path, const std::string& bytes,
                       const ImportOptions& options) {
  checkStatedLength(bytes);
  const PrivateFolder folder;
  const std::string copy =
      (folder.path() / ("copy" + std::filesystem::path(path).extension().string())).string();
  writeFile(copy, bytes);
  try {
    return channelsByGwyddion(copy, options);
  } catch (const FileError& error) {
    const std::string text = error.what();
    throw FileError(startsWith(text, copy) ? path + text.substr(copy.size()) : text);
  }
}

/// Which package of Python reads files of this name; empty if none is known to.
std::string packageFor(const std::string& path) {
  const std::string name_end = lowered(std::filesystem::path(path).extension().string());
  if (name_end == ".asd") return "AFMReader";
  for (const char* known : {".mnt", ".zmg", ".zon", ".os3d", ".qep", ".vk3", ".vk4", ".vk6", ".vk7",
                            ".plux", ".poir", ".oir", ".lext", ".frt", ".opdx", ".mdt"}) {
    if (name_end == known) return "SurfaceTopography";
  }
  return "";
}

/// By gwyddion, and what it has no reader for by packages of Python.
Channels channelsByOthers(const std::string& path, const ImportOptions& options) {
  try {
    return channelsByGwyddion(path, options);
  } catch (const NoFormatOfGwyddion& error) {
    Channels channels = channelsByPackages(path, options.timeout);
    if (!channels.empty()) return channels;
    const std::string package = packageFor(path);
    throw FileError(error.what() + (package.empty()
                                        ? ""
                                        : " (such files are read by the Python package " + package +
                                              ", where the python3 of the PATH has it)"));
  }
}

/// MATRIX keeps what a scan's numbers mean in a file of its own.
void checkMatrixParameters(const std::string& path, const std::string& bytes) {
  if (!beginsWithOneOf(bytes, {"ONTMATRX0101"})) return;
  if (beginsWithOneOf(bytes, {"ONTMATRX0101ATEM"})) {
    throw FileError(
        "holds the parameters of MATRIX scans, none of their images: give one of those, "
        "NAME--1_1.Z_mtrx");
  }
  const std::string whole = std::filesystem::absolute(path).string();
  const std::size_t dashes = whole.find("--");
  if (dashes == std::string::npos) {
    throw FileError(
        "is a MATRIX scan under another name: its parameters are found by that, NAME_0001.mtrx "
        "beside "
        "NAME--1_1.Z_mtrx");
  }
  const std::string parameters = whole.substr(0, dashes) + "_0001.mtrx";
  if (std::filesystem::exists(parameters)) return;
  throw FileError("needs the file of its parameters, " + parameters +
                  ", which is not there: copy it, too");
}

/// What gwyddion reads, after the file's own statements have been held against each other and
/// against its bytes.
Channels readByGwyddion(const std::string& path, const std::string& bytes,
                        const ImportOptions& options) {
  if (beginsWithOneOf(bytes, {"PK\3\4"})) checkX3p(bytes);
  const NanoscopeStatements stated = checkedNanoscope(bytes);
  checkMatrixParameters(path, bytes);
  checkStatedTwice(bytes);
  if (const auto whole = withWholeCreatecHeader(bytes)) return readRewritten(path, *whole, options);
  checkStatedLength(bytes);
  Channels channels = parseNanoscope(bytes);
  if (channels.empty()) channels = channelsByOthers(path, options);
  for (FileChannel& channel : channels) {
    channel.reach = stated.reach;
    channel.identity = completed(stated.identity, channel.identity);
    channel.notes.insert(channel.notes.end(), stated.notes.begin(), stated.notes.end());
  }
  return channels;
}

/// True for HDF5, whose signature stands at the beginning or behind a block of 512, 1024, 2048 ...
/// bytes.
bool isHdf5(const std::string& bytes) {
  const std::string signature = "\x89HDF\r\n\x1a\n";
  for (std::size_t at = 0; at < bytes.size(); at = at == 0 ? 512 : 2 * at) {
    if (bytes.compare(at, signature.size(), signature) == 0) return true;
  }
  return false;
}

/// HDF5 has arrays of any meaning under any names: some layouts are read by h5py, some by gwyddion,
/// no other is guessed. Without h5py none is: nothing else tells whether links in the file lead to
/// others.
Channels readHdf5(const std::string& path, const ImportOptions& options) {
  const Hdf5Channels read = channelsByH5py(path, options.timeout);
  if (!read.channels.empty()) return read.channels;
  if (read.is_library_missing) {
    throw FileError(
        "needs h5py to be read (an HDF5 file: .h5-jpk, .topostats, NetCDF-4 and others), which is "
        "not "
        "installed (Debian package: python3-h5py)");
  }
  try {
    return channelsByGwyddion(path, options);
  } catch (const FileError& error) {
    const std::string arrays = read.arrays.empty() ? "" : "its arrays are " + read.arrays + "; ";
    throw FileError(std::string(error.what()) + " (an HDF5 file: " + arrays +
                    "write its array of heights as .npy and state its pitch)");
  }
}

/// OpenCV's and the project's own formats with a signature. @return false if it is none of them
bool readKnown(const std::string& path, const std::string& bytes, const ImportOptions& options,
               Channels& channels) {
  if (beginsWithOneOf(bytes, {std::string("II*\0", 4), std::string("MM\0*", 4),
                              std::string("II+\0", 4), std::string("MM\0+", 4)})) {
    channels = readTiff(path, bytes, options);
  } else if (beginsWithOneOf(bytes, {"\x89PNG"})) {
    channels = {parsePng(bytes)};
  } else if (beginsWithOneOf(bytes, {"\x76\x2f\x31\x01"})) {
    channels = {parseExr(bytes)};
  } else if (beginsWithOneOf(bytes, {"GWYP"})) {
    channels = parseGwy(bytes, options.ignore_mask);
  } else if (beginsWithOneOf(bytes, {"Binary TrueMap Data File v2.0"})) {
    channels = {parseTmd(bytes)};
  } else if (beginsWithOneOf(bytes, {"Gwyddion Simple Field 1."})) {
    channels = {parseGsf(bytes)};
  } else if (beginsWithOneOf(bytes, {"\x93NUMPY"})) {
    channels = {parseNpy(bytes)};
  } else if (beginsWithOneOf(bytes, {"DIGITAL SURF", "DSCOMPRESSED"})) {
    channels = parseSur(bytes);
  } else if (beginsWithOneOf(bytes, {"DSAA\n", "DSAA\r", "DSAA "})) {
    channels = {parseSurferGrid(bytes)};
  } else if (isWsxmImage(bytes.substr(0, 200))) {
    channels = {parseWsxm(bytes)};
  } else if (isHdf5(bytes)) {
    channels = readHdf5(path, options);
  } else if (beginsWithOneOf(bytes, {std::string("CDF\1", 4), std::string("CDF\2", 4)})) {
    channels = readNetcdf(path, bytes, options);
  } else {
    return false;
  }
  return true;
}

/// Of the file with these bytes.
Channels channelsOf(const std::string& path, const std::string& bytes,
                    const ImportOptions& options) {
  Channels channels;
  if (readKnown(path, bytes, options, channels)) return channels;
  const std::string name_end = lowered(std::filesystem::path(path).extension().string());
  if (beginsWithOneOf(bytes, {":NANONIS_VERSION:", "[Parameter]", "[Paramet32]", "[Paramco32]",
                              "ONTMATRX0101"})) {
    return readByGwyddion(path, bytes, options);  // under whatever name
  }
  for (const char* text : {".txt", ".asc", ".csv", ".xyz"}) {
    const bool is_nanoscope = beginsWithOneOf(bytes, {"\\*File list", "\"\\*File list"});
    if (name_end == text && is_nanoscope) {
      const bool is_image = bytes.find('\0') != std::string::npos;  // under a name of text
      return is_image ? readByGwyddion(path, bytes, options) : parseNanoscopeText(bytes);
    }
    if (name_end == text) return {parseTextGrid(bytes, options.text)};
  }
  if (beginsWithOneOf(bytes, {"GWYO", "GWYQ"})) return readOtherGwy(path, bytes, options);
  for (const char* image : {".tif", ".tiff", ".png", ".exr", ".npy", ".gwy"}) {
    if (name_end == image)
      throw FileError("is not a " + name_end.substr(1) + " image: damaged, or misnamed");
  }
  return readByGwyddion(path, bytes, options);
}

}  // namespace

std::vector<FileChannel> readChannels(const std::string& path, const ImportOptions& options) {
  const std::string bytes = readFileBytes(path);
  checkTransfer(bytes);
  Channels channels = channelsOf(path, bytes, options);
  const std::string checksum = sha256Text(bytes);
  for (FileChannel& channel : channels) channel.identity.checksum = checksum;
  return channels;
}

std::string readerVersion() { return MEMS_STICTION_READERS; }

}  // namespace mems_stiction
