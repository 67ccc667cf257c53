#pragma once

/// @file
/// The checksum by which people and other programs tell files apart.

#include <string>
#include <string_view>

namespace mems_stiction {

/// "sha256:" and the 64 hexadecimal digits that the program sha256sum prints.
/// @throw FileError if this machine's OpenSSL does not offer it
std::string sha256Text(std::string_view bytes);

}  // namespace mems_stiction
