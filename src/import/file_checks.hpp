#pragma once

/// @file
/// Is a file whole, and as it was sent? The programs that read makers' files ask for enough bytes
/// only, and compare no checksums.

#include <cstdint>
#include <optional>
#include <string>

namespace mems_stiction {

/// - @p maker of the format, for the message
/// @throw FileError without a file name if the two differ
void demandLength(const std::string& maker, std::uint64_t length, std::uint64_t stated);

/// Is a maker's file as long as its header says? One with too many bytes, from a conversion of line
/// ends or with the header of another file, would come out as noise. MetroPro, Alicona, Agilent,
/// Aarhus, Createc, Surfstand's text, Omicron MATRIX, Nanosurf and Wyko; nothing for all others.
/// @throw FileError without a file name if the file's length is not what its header states, or a
/// last number was cut off
void checkStatedLength(const std::string& bytes);

/// Newer programs of Createc write the compressed data right behind the text of the header;
/// gwyddion looks for them at byte 16384.
/// @return the file with its header filled up to there; none for every other file
std::optional<std::string> withWholeCreatecHeader(const std::string& bytes);

/// Programs that take every file for text change bytes all over it. For files of binary data, of
/// any format.
/// @throw FileError without a file name if every line end was made CR LF, if bytes were replaced as
/// no UTF-8, or if this is a web page or a pointer of Git LFS in place of the file.
void checkTransfer(const std::string& bytes);

}  // namespace mems_stiction
