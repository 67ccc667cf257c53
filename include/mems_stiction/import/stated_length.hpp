#pragma once

/// @file
/// Is a maker's file as long as its header says? The program that reads it asks for enough bytes only. A file with too
/// many, from a conversion of line ends or with the header of another file, would come out as noise.

#include <cstdint>
#include <string>

namespace mems_stiction {

/// - @p maker of the format, for the message
/// @throw FileError without a file name if the two differ
void demandLength(const std::string& maker, std::uint64_t length, std::uint64_t stated);

/// MetroPro, Alicona, Agilent, Aarhus, Createc, Surfstand's text, Omicron MATRIX, Nanosurf and Wyko; nothing for all
/// others.
/// @throw FileError without a file name if the file's length is not what its header states, or a last number was cut off
void checkStatedLength(const std::string& bytes);

}  // namespace mems_stiction
