#include "import/format_readers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "import/file_bytes.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "import/text_cells.hpp"
#include "import/text_header.hpp"
#include "import/xyz_grid.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr int kListLines =
    3;  // this many times as long as wide with 2 or 3 columns: a list or a profile
constexpr int kProfileNumbers = 18;  // on 2 lines
constexpr int kLeastPoints = 4;
constexpr int kMostListColumns = 8;
constexpr double kSameSize = 0.01;    // relative: sizes in headings are rounded
constexpr int kLeastIndices = 3;      // fewer are in equal steps by chance
constexpr int kLeastSteady = 5;       // the same for steps of any size
constexpr double kEqualStep = 0.05;   // of the step: printed coordinates are rounded
constexpr double kExactStep = 0.001;  // of the step: few numbers must fit better
constexpr const char* kAreaNeeded =
    ": export a scan of an area, as a matrix or as a list of x, y and z; the program "
    "profile_surface makes a surface of a profile";

/// Numbers from `first` on in equal steps that are not zero.
bool isSteady(const cv::Mat& line, int first, double tolerance) {
  const int count = line.cols - first;
  const double* number = line.ptr<double>(0) + first;
  const double step = (number[count - 1] - number[0]) / (count - 1);
  if (!std::isfinite(step) || step == 0.0) return false;
  for (int i = 0; i < count; ++i) {
    if (!(std::abs(number[i] - number[0] - i * step) <= tolerance * std::abs(step))) return false;
  }
  return true;
}

/// 0, 1, 2, ... or 1, 2, 3, ..., or numbers in equal steps if there are more of them.
bool looksLikeIndices(const cv::Mat& line, int first) {
  const int count = line.cols - first;
  if (count < kLeastIndices) return false;
  const double* number = line.ptr<double>(0) + first;
  const bool counts = (number[0] == 0.0 || number[0] == 1.0) && number[1] == number[0] + 1.0;
  if (counts) return isSteady(line, first, 0.0);
  return count >= kLeastSteady - 1 &&
         isSteady(line, first, count >= kLeastSteady ? kEqualStep : kExactStep);
}

/// The row, or the row less its corner, looks like indices and most others do not.
bool isIndexRow(const cv::Mat& grid, int row) {
  for (const int first : {0, 1}) {
    if (!looksLikeIndices(grid.row(row), first)) continue;
    int alike = 0;
    for (int other = 0; other < grid.rows; ++other) {
      if (other != row && isSteady(grid.row(other), first, kEqualStep)) ++alike;
    }
    if (2 * alike < grid.rows - 1) return true;
  }
  return false;
}

/// Which row or column at the border of the grid counts, or goes in equal steps, though the others
/// do not: it numbers the others, or holds coordinates. In words that end with what to do; empty if
/// there is none. - @p grid CV_64FC1
std::string indexLine(const cv::Mat& grid) {
  const cv::Mat columns = grid.t();
  const std::string advice = ": indices or coordinates, not heights; remove ";
  if (isIndexRow(grid, 0)) return "numbers in equal steps, column 1 on" + advice + "them";
  if (isIndexRow(grid, grid.rows - 1))
    return "the last line holds numbers in equal steps" + advice + "it";
  if (isIndexRow(columns, 0)) return "column 1 holds numbers in equal steps" + advice + "it";
  if (isIndexRow(columns, grid.cols - 1)) {
    return "column " + std::to_string(grid.cols) + " holds numbers in equal steps" + advice + "it";
  }
  return "";
}

std::string lineOf(const TextLines& text, std::size_t row) {
  return "line " + std::to_string(text.data[row].number) + ": ";
}

/// A second grid begins where data go on after a gap. Gaps between all lines are only a wide style.
void checkBlocks(const TextLines& text) {
  if (text.blocks.size() < 2 || text.blocks.size() == text.data.size()) return;
  throw FileError(
      lineOf(text, text.blocks[1]) +
      "a second grid begins here, column 1: give each grid a file of its own, without empty lines");
}

void checkIndices(const TextLines& text, const cv::Mat& grid) {
  const std::string indices = indexLine(grid);
  if (!indices.empty()) throw FileError(lineOf(text, 0) + indices);
}

/// A last number without line end is either the end of the file or the beginning of a number.
void checkEnd(const TextLines& text, const TextCells& cells, FileChannel& channel) {
  if (text.ends_with_line_end) return;
  const std::string where =
      lineOf(text, cells.rows - 1) + "the last number, column " + std::to_string(cells.cols) + ", ";
  if (cells.is_last_shorter) {
    throw FileError(where + "is shorter than all others and has no line end: the file is cut off");
  }
  channel.notes.push_back(where + "has no line end: if the file is cut off, it is wrong");
}

void checkStatedSize(const TextHeader& header, const cv::Mat& values) {
  const bool differs = (header.cols != 0 && header.cols != static_cast<std::size_t>(values.cols)) ||
                       (header.rows != 0 && header.rows != static_cast<std::size_t>(values.rows));
  if (!differs) return;
  throw FileError("the heading states " + std::to_string(header.cols) + " x " +
                  std::to_string(header.rows) + " numbers, the file has " +
                  std::to_string(values.cols) + " x " + std::to_string(values.rows));
}

/// Heights above, a map of what was measured below: 0 is a void. @throw FileError for other numbers
/// than 0 and 1
cv::Mat withoutVoids(const cv::Mat& both) {
  if (both.rows % 2 != 0)
    throw FileError("the heading states voids, and their map is not as large as the heights");
  cv::Mat heights = both.rowRange(0, both.rows / 2).clone();
  const cv::Mat map = both.rowRange(both.rows / 2, both.rows);
  const cv::Mat is_void = map == 0.0;
  if (cv::countNonZero(is_void | (map == 1.0)) != heights.rows * heights.cols) {
    throw FileError(
        "the heading states voids, and their map behind the heights has other numbers than 0 and "
        "1");
  }
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), is_void);
  return heights;
}

void applyUnits(const TextHeader& header, FileChannel& channel) {
  if (header.missing_value) {
    channel.values.setTo(std::numeric_limits<double>::quiet_NaN(),
                         channel.values == *header.missing_value);
  }
  if (header.scale != 1.0) channel.values *= header.scale;
  if (header.unit_z.empty()) return;
  channel.unit_z = header.unit_z;
  const auto unit = heightUnit(header.unit_z);
  if (!unit) return;  // no height: the choice of the channel says so
  channel.unit_z = "m";
  if (*unit != 1.0) channel.values *= *unit;
  if (channel.width == 0.0 || !channel.unit_xy.empty()) return;
  channel.width *= *unit;
  channel.height *= *unit;
  channel.unit_xy = "m";
}

/// The size that the heading states, by which the pitch is known. @throw FileError for two that
/// differ
double statedSide(double side, double pitch, int count, const char* what) {
  if (side > 0.0 && pitch > 0.0 && std::abs(side - pitch * count) > kSameSize * side) {
    throw FileError("the heading states the " + std::string(what) + " as " + numberText(side) +
                    " m and " + std::to_string(count) + " pixels of " + numberText(pitch) +
                    " m: remove one");
  }
  return side > 0.0 ? side : pitch * count;
}

void applySize(const TextHeader& header, FileChannel& channel) {
  const double width = statedSide(header.width, header.pitch_x, channel.values.cols, "width");
  const double height = statedSide(header.height, header.pitch_y, channel.values.rows, "height");
  if (width > 0.0 && height > 0.0) {
    channel.width = width;
    channel.height = height;
    channel.unit_xy = "m";
  } else if (width > 0.0 || height > 0.0) {
    channel.notes.push_back(std::string("the heading states the ") +
                            (width > 0.0 ? "width" : "height") +
                            " alone, which does not count: state width and height");
  }
}

/// A list with columns beside x, y and z (numbers of points, their quality), or with these in
/// another order.
void checkListColumns(const cv::Mat& cells) {
  if (cells.rows < kLeastPoints || cells.cols < 3 || cells.cols > kMostListColumns) return;
  std::vector<int> axes;
  for (int col = 0; col < cells.cols; ++col) {
    if (mayBeAxis(cells.col(col))) axes.push_back(col);
  }
  for (const int x : axes) {
    for (const int y : axes) {
      if (y <= x || !areOnGrid(cells.col(x), cells.col(y))) continue;
      throw FileError("columns " + std::to_string(x + 1) + " and " + std::to_string(y + 1) +
                      " of " + std::to_string(cells.cols) +
                      " are x and y of a list of points: keep three columns, x, y and z");
    }
  }
}

/// Row 0 is the top: the largest y where y grows upward.
void orientList(const TextHeader& header, YAxis stated, const cv::Mat& points,
                FileChannel& channel) {
  const bool is_up = stated != YAxis::kAuto ? stated == YAxis::kUp
                                            : header.is_y_up.value_or(runsFromTheTop(points));
  if (is_up) {
    cv::flip(channel.values, channel.values, 0);
  } else if (stated == YAxis::kAuto && !header.is_y_up) {
    channel.notes.emplace_back(
        "the list does not say which way y grows, its lowest y is the upper row: state y_axis: up "
        "or down in the "
        "sidecar (SCAN.yaml), or as scan/y_axis");
  }
}

/// @return true if the cells were a list of points
bool readPoints(const TextHeader& header, YAxis y_axis, const cv::Mat& cells,
                FileChannel& channel) {
  const bool is_stated = header.unit_of_points > 0.0;
  const bool is_list = cells.cols <= 3 && cells.rows > kListLines * cells.cols;
  if (!is_stated && !is_list && !(cells.cols == 3 && cells.rows > 3)) return false;
  XyzGrid grid;
  try {
    if (cells.cols != 3) {
      throw FileError(std::to_string(cells.cols) + " columns of " + std::to_string(cells.rows) +
                      " lines are a profile or a list, not a surface" + kAreaNeeded);
    }
    grid = gridOfPoints(cells);
  } catch (const FileError&) {
    if (is_stated || is_list) throw;
    return false;
  }
  channel.values = grid.heights;
  orientList(header, y_axis, cells, channel);
  applySize(header, channel);
  const double width = grid.pitch_x * grid.heights.cols;
  const double height = grid.pitch_y * grid.heights.rows;
  if (!is_stated) {
    if (channel.unit_xy.empty()) {
      channel.width = width;
      channel.height = height;
    }
    return true;
  }
  // The heading's size may be that from the first point to the last.
  const double across = width * header.unit_of_points;
  if (channel.width > 0.0 &&
      std::abs(channel.width - across) > (kSameSize + 1.0 / grid.heights.cols) * across) {
    throw FileError("the heading states a width of " + numberText(channel.width) +
                    " m, the points lie on " + numberText(across) + " m: remove one");
  }
  channel.width = across;
  channel.height = height * header.unit_of_points;
  channel.unit_xy = "m";
  return true;
}

/// Positions and heights along one line, perhaps behind an index, and columns without any number. -
/// @p cells CV_64FC1
bool isProfile(const cv::Mat& cells) {
  std::vector<int> filled;
  for (int col = 0; col < cells.cols; ++col) {
    const cv::Mat numbers = cells.col(col) == cells.col(col);
    if (cv::countNonZero(numbers) > 0) filled.push_back(col);
  }
  if (cells.rows <= kListLines * static_cast<int>(filled.size())) return false;
  return filled.size() == 2 ||
         (filled.size() == 3 && looksLikeIndices(cells.col(filled[0]).t(), 0) &&
          isSteady(cells.col(filled[1]).t(), 0, kEqualStep));
}

/// @return the columns of a profile in words; empty if the data are none, or cannot be read
std::string profileIn(const TextLines& text, const TextStyle& style) {
  try {
    TextCells cells = textCells(text.data, style);
    const cv::Mat grid(static_cast<int>(cells.rows), static_cast<int>(cells.cols), CV_64FC1,
                       cells.values.data());
    if (!isProfile(grid)) return "";
    return std::to_string(grid.cols) + " columns of " + std::to_string(grid.rows) + " lines";
  } catch (const FileError&) {
    return "";
  }
}

/// A heading that is not known does not matter to a profile, which nothing stated above it makes a
/// surface.
TextHeader headerOf(const TextLines& text, const TextStyle& style, char hint) {
  try {
    return textHeader(text.heading, hint, style.decimal);
  } catch (const FileError&) {
    const std::string profile = text.data.empty() ? "" : profileIn(text, style);
    if (profile.empty()) throw;
    throw FileError(profile + " are a profile, not a surface" + kAreaNeeded);
  }
}

char signOf(DecimalMark mark) {
  return mark == DecimalMark::kAuto ? '\0' : mark == DecimalMark::kPoint ? '.' : ',';
}

}  // namespace

FileChannel parseTextGrid(const std::string& bytes, const TextOptions& options) {
  TextLines text = textLines(bytes);
  FileChannel channel;
  channel.takes_settings = true;
  const char stated = signOf(options.decimal_mark);
  const char hint = stated != '\0' ? stated : headingMark(text.heading);
  joinThousands(text.data);
  const TextStyle style = text.data.empty() ? TextStyle() : textStyle(text.data, stated, hint);
  const TextHeader header = headerOf(text, style, hint);
  channel.title = header.title;
  channel.unit_doubt = header.unit_doubt;
  channel.notes = header.notes;
  if (!style.guess.empty()) {
    channel.notes.push_back(
        "'" + shownPiece(style.guess) +
        "' and all others have three digits after the point, which counts as decimal: state "
        "decimal_mark: comma in the sidecar (SCAN.yaml) if it groups thousands");
  }
  TextCells cells;
  if (!text.data.empty()) cells = textCells(text.data, style);
  if (cells.rows < 2 || cells.cols < 2) {
    throw FileError("a grid needs at least 2 x 2 numbers, found " + std::to_string(cells.cols) +
                    " x " + std::to_string(cells.rows));
  }
  checkPixelCount(cells.cols, cells.rows);
  const cv::Mat grid(static_cast<int>(cells.rows), static_cast<int>(cells.cols), CV_64FC1,
                     cells.values.data());
  checkEnd(text, cells, channel);
  if (header.has_void_map) {
    channel.values = withoutVoids(grid);
    checkStatedSize(header, channel.values);
    applySize(header, channel);
    applyUnits(header, channel);
    return channel;
  }
  if (readPoints(header, options.y_axis, grid, channel)) {
    applyUnits(header, channel);
    return channel;
  }
  checkListColumns(grid);
  checkBlocks(text);
  if (grid.rows == 2 && grid.cols >= kProfileNumbers) {
    throw FileError("2 lines of " + std::to_string(grid.cols) +
                    " numbers are a profile, not a surface" + kAreaNeeded);
  }
  checkStatedSize(header, grid);
  checkIndices(text, grid);
  channel.values = grid.clone();
  applySize(header, channel);
  applyUnits(header, channel);
  return channel;
}

}  // namespace mems_stiction
