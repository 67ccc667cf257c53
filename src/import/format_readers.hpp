#pragma once

/// @file
/// The readers of scan files, one for each format, and which one a file needs. Each takes the bytes
/// of a whole file. What they throw names the cause, not the file: its name is the caller's.

#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// All channels of a file, by the reader of its format: told by its first bytes where the format
/// has a signature, else by its name.
/// @throw FileError with or without the file's name
std::vector<FileChannel> readChannels(const std::string& path, const ImportOptions& options);

/// Digits that change with the code of this room: rows of older readers must not pass for those of
/// these.
std::string readerVersion();

/// TIFF files of heights, by libtiff: each full-size page is a channel. OpenCV knows neither pages
/// nor tags, and scales pixels of fewer than 8 or 16 bits. Pages that are thumbnails or overviews
/// by their tag, or masks, are left out. Integers of 1 to 32 bits are counts as they stand;
/// float16, float32, float64. GDAL's missing value becomes NaN. The scale of ImageJ, OME, or else
/// the resolution, is the pitch.
/// @return channels that take settings; a page of several values per pixel (a picture) has a matrix
/// of as many channels.
/// @throw FileError damaged, of a kind that is no scan, too many pixels.
std::vector<FileChannel> parseTiff(const std::string& bytes);

/// PNG images, by libpng: OpenCV scales counts of few bits, and loads a hundred libraries before
/// main() begins. Integers are counts as they stand, also of fewer than 8 bits.
/// @return a channel that takes settings; several values per pixel (a picture) give a matrix of as
/// many channels.
/// @throw FileError damaged, too many pixels.
FileChannel parsePng(const std::string& bytes);

/// OpenEXR images, by OpenEXR: OpenCV reads other channels than those there are. The file's single
/// channel, whatever its name.
/// @throw FileError several channels, damaged, too many pixels.
FileChannel parseExr(const std::string& bytes);

/// NumPy's .npy files (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html): two
/// dimensions, rows first; integers, float16, float32 and float64 of either byte order, in C or
/// Fortran order.
/// @return a channel that takes settings
/// @throw FileError another shape or type, cut off, too many numbers.
FileChannel parseNpy(const std::string& bytes);

/// Channels of a Gwyddion .gwy file, by ascending id; none if it has no image. Values are CV_64FC1.
/// Pixels under a mask (mask > 0.5) are NaN, and a note of the channel counts them.
///
/// The container is a tree of named, type-tagged, little-endian components
/// (https://gwyddion.net/documentation/ user-guide-en/gwyfile-format.html). Channel N is "/N/data"
/// (a GwyDataField) with "/N/data/title" and, where data is missing, "/N/mask". Every length is
/// checked against what is left of the file before it is used.
/// - @p ignore_mask pixels under masks keep their values
/// @throw FileError the bytes are not a .gwy container.
std::vector<FileChannel> parseGwy(const std::string& bytes, bool ignore_mask = false);

/// Gwyddion Simple Field, .gsf (https://gwyddion.net/documentation/user-guide-en/gsf.html): a
/// header in text, then float32.
/// @throw FileError cut off, sizes or units that are stated twice, units with a prefix, which are
/// beyond the format.
FileChannel parseGsf(const std::string& bytes);

/// TrueMap's .tmd, version 2.0: sides and heights in mm. Read here, since SurfaceTopography
/// before 1.27 took mm for um.
/// @throw FileError cut off, sides that are not > 0.
FileChannel parseTmd(const std::string& bytes);

/// Digital Surf's .sur surfaces: read here, since Gwyddion makes heights of points that were not
/// measured. Uncompressed and compressed. A surface with colour or intensity images behind it gives
/// the surface; several layers give as many channels. Points of the value "smallest - 2" are
/// missing where the header says that there are any.
/// @throw FileError a profile or another object, cut off, a unit that is no length in x or y.
std::vector<FileChannel> parseSur(const std::string& bytes);

/// True for a WSxM image of heights or another signal; false for WSxM's curves, movies and text
/// exports.
bool isWsxmImage(const std::string& start);

/// WSxM images (.stp, .top, .tom): read here, since Gwyddion reads past the end of files that are
/// cut off and takes a Latin-1 micro sign for nothing. Integers span the stated z amplitude;
/// floating-point numbers are in its unit. The image stands upside down and mirrored in the file.
/// @throw FileError cut off, without size or unit.
FileChannel parseWsxm(const std::string& bytes);

/// SurfaceTopography's classic NetCDF files: the variable "heights(x, y)" with its unit, size and
/// mask; none if the file has no such variable.
/// @throw FileError damaged, cut off.
std::optional<FileChannel> parseNetcdfHeights(const std::string& bytes);

/// What a GXSM file (NetCDF too) states where Gwyddion does not look.
struct GxsmStatements {
  std::string other_unit;  ///< of the values where that is no length: "nA", "Hz"; empty if it is
                           ///< one, or not stated
  double pitch_x =
      0.0;  ///< [m]; GXSM's range reaches from the first pixel to the last; 0 = not stated
  double pitch_y = 0.0;  ///< [m]
};

/// @throw FileError damaged, a pitch that is not the range over the steps
GxsmStatements gxsmStatements(const std::string& bytes);

/// Heights as text: one row of the scan per line, row 0 first, or a list of x, y and z.
///
/// Numbers are separated by commas, semicolons, tabs or spaces, with a decimal point or, where
/// other characters separate, a decimal comma. "nan", infinities, words for none ("N/A", "BAD") and
/// an empty cell between two commas or semicolons are missing. '#' and '%' begin a comment. What a
/// heading states (sizes, "Value units", missing value) is read. Three columns of many lines are a
/// list of x, y and z on a regular grid.
/// - @p options what the file does not say of itself
/// @return one channel that takes settings; values in metres where the unit is stated, else in the
/// unit of the file.
/// @throw FileError with line and column where there are such, for text that is no such grid or can
/// be read in two ways: a second grid, a row or column of indices, columns beside x, y and z, marks
/// that may be decimal or group thousands, sizes and units that are stated twice, numbers that were
/// cut off.
FileChannel parseTextGrid(const std::string& bytes, const TextOptions& options = {});

/// NanoScope's text exports: its heading, whose lines begin with a backslash, then a line of names
/// "Height_Sensor(nm)" and a line of numbers for each point, row by row.
/// @return a channel for each column
/// @throw FileError cut off, without number of points or names.
std::vector<FileChannel> parseNanoscopeText(const std::string& bytes);

/// NanoScope's images of versions 4.3 and later, binary: each image with its scale over a
/// sensitivity of the scanner.
/// @return a channel for each image, in metres where its sensitivity is a length per volt; none
/// where one image states its scale in another way, which is left to gwyddion.
/// @throw FileError counts that are none, too many pixels.
std::vector<FileChannel> parseNanoscope(const std::string& bytes);

/// Surfer's text grids (DSAA): numbers of nodes, limits of x, y and z, then rows from the lowest y
/// on. Blank nodes are NaN.
/// @return a channel that takes settings; x and y are in the unit of z.
/// @throw FileError cut off, more numbers than stated, ranges that do not grow.
FileChannel parseSurferGrid(const std::string& bytes);

/// What h5py reads of an HDF5 file; no channels where its layout is none of those known.
struct Hdf5Channels {
  std::vector<FileChannel> channels;
  bool is_library_missing = false;  ///< there is no python3, or it has no h5py
  std::string arrays;  ///< of two dimensions, in words: what there is where no layout is known
};

/// HDF5 by h5py, in a python3 of its own, since there is no reader that a damaged file cannot
/// crash: Bruker's `.h5-jpk` (the first frame), `.topostats` and SurfaceTopography's NetCDF-4.
/// Optional, as gwyddion is.
/// @throw FileError crashed, timed out, damaged.
Hdf5Channels channelsByH5py(const std::string& path, double timeout);

/// What the Python packages SurfaceTopography and AFMReader make of a file that neither this
/// project nor gwyddion reads; both are optional. Formats without a signature are left out: they
/// would be guessed.
/// @return every channel of an area, with a note that names the package and its version; none if
/// they read none or are not installed.
/// @throw FileError crashed, timed out.
std::vector<FileChannel> channelsByPackages(const std::string& path, double timeout);

/// The file is of no format that Gwyddion knows, or Gwyddion's libraries are not there.
class NoFormatOfGwyddion : public FileError {
 public:
  using FileError::FileError;
};

/// Instrument makers' files. Gwyddion's libraries read them in a process of its own
/// (tools/read_by_gwyddion.cpp): a damaged file that crashes a reader ends that process and nothing
/// else. The libraries are optional.
/// @return every image channel of the file, whatever its unit.
/// @throw NoFormatOfGwyddion; FileError in one line with the file and the cause: crashed, failed,
/// timed out, unreadable.
std::vector<FileChannel> channelsByGwyddion(const std::string& path, const ImportOptions& options);

}  // namespace mems_stiction
