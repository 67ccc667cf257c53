#include "mems_stiction/import/text_grid.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/file_bytes.hpp"
#include "mems_stiction/import/length_unit.hpp"
#include "mems_stiction/import/text_cells.hpp"
#include "mems_stiction/import/text_header.hpp"
#include "mems_stiction/import/xyz_grid.hpp"

namespace mems_stiction {
namespace {

constexpr int kListLines = 3;        // this many times as long as wide with 2 or 3 columns: a list or a profile
constexpr int kProfileNumbers = 18;  // on 2 lines
constexpr int kLeastIndices = 4;     // fewer numbers are in equal steps by chance
constexpr double kEqualStep = 0.05;  // of the step: printed coordinates are rounded

std::string lineOf(const TextLines& text, std::size_t row) {
  return "line " + std::to_string(text.data[row].number) + ": ";
}

/// A second grid begins where data go on after a gap. Gaps between all lines are only a wide style.
void checkBlocks(const TextLines& text) {
  if (text.blocks.size() < 2 || text.blocks.size() == text.data.size()) return;
  throw FileError(lineOf(text, text.blocks[1]) +
                  "a second grid begins here, column 1: give each grid a file of its own, without empty lines");
}

/// Numbers in equal steps that are not zero.
bool isProgression(int count, const std::function<double(int)>& number) {
  if (count < kLeastIndices) return false;
  const double step = (number(count - 1) - number(0)) / (count - 1);
  if (!std::isfinite(step) || step == 0.0) return false;
  for (int i = 0; i < count; ++i) {
    if (!(std::abs(number(i) - number(0) - i * step) <= kEqualStep * std::abs(step))) return false;
  }
  return true;
}

/// True if the first line, less its corner, goes in equal steps and most others do not.
bool hasIndexLine(const cv::Mat& grid) {
  const auto is_steady = [&grid](int row) {
    const double* line = grid.ptr<double>(row);
    return isProgression(grid.cols - 1, [line](int i) { return line[i + 1]; });
  };
  if (grid.rows < 3 || !is_steady(0)) return false;
  int steady = 0;
  for (int row = 1; row < grid.rows; ++row) steady += is_steady(row) ? 1 : 0;
  return 2 * steady < grid.rows - 1;
}

void checkIndices(const TextLines& text, const cv::Mat& grid) {
  if (hasIndexLine(grid)) {
    throw FileError(lineOf(text, 0) +
                    "numbers in equal steps, column 1 on: indices or coordinates, not heights; remove them");
  }
  if (hasIndexLine(grid.t())) {
    throw FileError(lineOf(text, 0) +
                    "column 1 holds numbers in equal steps: indices or coordinates, not heights; remove it");
  }
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
  throw FileError("the heading states " + std::to_string(header.cols) + " x " + std::to_string(header.rows) +
                  " numbers, the file has " + std::to_string(values.cols) + " x " + std::to_string(values.rows));
}

void applyUnits(const TextHeader& header, FileChannel& channel) {
  if (header.missing_value)
    channel.values.setTo(std::numeric_limits<double>::quiet_NaN(), channel.values == *header.missing_value);
  if (header.unit_z.empty()) return;
  channel.unit_z = header.unit_z;
  const auto unit = lengthUnit(header.unit_z);
  if (!unit) return;  // no height: the choice of the channel says so
  channel.unit_z = "m";
  if (*unit != 1.0) channel.values *= *unit;
  if (channel.width == 0.0 || !channel.unit_xy.empty()) return;
  channel.width *= *unit;
  channel.height *= *unit;
  channel.unit_xy = "m";
}

/// @return true if the cells were a list of points
bool readPoints(const TextHeader& header, const cv::Mat& cells, FileChannel& channel) {
  const bool is_stated = header.unit_of_points > 0.0;
  const bool is_list = cells.cols <= 3 && cells.rows > kListLines * cells.cols;
  if (!is_stated && !is_list && !(cells.cols == 3 && cells.rows > 3)) return false;
  XyzGrid grid;
  try {
    if (cells.cols != 3) {
      throw FileError(std::to_string(cells.cols) + " columns of " + std::to_string(cells.rows) +
                      " lines are a profile or a list, not a surface");
    }
    grid = gridOfPoints(cells);
  } catch (const FileError&) {
    if (is_stated || is_list) throw;
    return false;
  }
  channel.values = grid.heights;
  channel.width = grid.pitch_x * grid.heights.cols;
  channel.height = grid.pitch_y * grid.heights.rows;
  if (!is_stated) return true;
  channel.width *= header.unit_of_points;
  channel.height *= header.unit_of_points;
  channel.unit_xy = "m";
  return true;
}

}  // namespace

FileChannel parseTextGrid(const std::string& bytes) {
  const TextLines text = textLines(bytes);
  const TextHeader header = textHeader(text.heading);
  FileChannel channel;
  channel.takes_settings = true;
  channel.title = header.title;
  channel.notes = header.notes;
  TextCells cells;
  if (!text.data.empty()) cells = textCells(text.data, textStyle(text.data));
  if (cells.rows < 2 || cells.cols < 2) {
    throw FileError("a grid needs at least 2 x 2 numbers, found " + std::to_string(cells.cols) + " x " +
                    std::to_string(cells.rows));
  }
  checkPixelCount(cells.cols, cells.rows);
  const cv::Mat grid(static_cast<int>(cells.rows), static_cast<int>(cells.cols), CV_64FC1, cells.values.data());
  checkEnd(text, cells, channel);
  if (readPoints(header, grid, channel)) {
    applyUnits(header, channel);
    return channel;
  }
  checkBlocks(text);
  if (grid.rows == 2 && grid.cols >= kProfileNumbers) {
    throw FileError("2 lines of " + std::to_string(grid.cols) + " numbers are a profile, not a surface");
  }
  checkStatedSize(header, grid);
  checkIndices(text, grid);
  channel.values = grid.clone();
  channel.width = header.width > 0.0 ? header.width : header.pitch_x * grid.cols;
  channel.height = header.height > 0.0 ? header.height : header.pitch_y * grid.rows;
  if (channel.width > 0.0 && channel.height > 0.0) channel.unit_xy = "m";
  applyUnits(header, channel);
  return channel;
}

}  // namespace mems_stiction
