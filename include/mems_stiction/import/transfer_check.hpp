#pragma once

/// @file
/// Did a file arrive as it was sent? Programs that take every file for text change bytes all over it.

#include <string>

namespace mems_stiction {

/// For files that hold binary data, whatever their format.
/// @throw FileError without a file name if every line end was made CR LF, if bytes were replaced as no UTF-8, or if this is
/// a web page or a pointer of Git LFS in place of the file.
void checkTransfer(const std::string& bytes);

}  // namespace mems_stiction
