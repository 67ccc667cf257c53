#pragma once

/// @file
/// The header of a NanoScope file: lists of lines "\key: value", each list under a line "\*Name".

#include <cstdint>
#include <string>
#include <vector>

#include "import/header_lines.hpp"

namespace mems_stiction::nanoscope {

constexpr std::size_t kMostHeader = 1 << 20;  // [bytes]

/// A part of the header between two lines "\*Name".
struct List {
  std::string name;
  HeaderLines lines;
};

bool isNanoscope(const std::string& bytes);

std::vector<List> listsOf(const std::string& bytes);

/// Not an array of force curves.
bool isImage(const List& list);

/// By the version in the first list. @return 2 or 4
std::uint64_t bytesOfNumber(const std::vector<List>& lists);

/// Of the scanned area.
struct Size {
  double x = 0.0, y = 0.0;  ///< [m]; 0 = not stated
};

/// "10 10 ~m", or "10000 nm" for both
Size scanSize(const HeaderLines& lines);

/// "V [Sens. Zsens] (0.0067 V/LSB) 330.0000 V": the number behind the bracket, in its unit; 0 = not
/// stated
double hardValue(const std::string& text);

/// "V 34.55678 nm/V" [m/V]; 0 = not stated
double metresPerVolt(const std::string& text);

}  // namespace mems_stiction::nanoscope
