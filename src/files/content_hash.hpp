#pragma once

/// @file
/// Is a content the one that was there before? And the checksum by which people and other programs
/// tell files apart.

#include <cstdint>
#include <string>
#include <string_view>

namespace mems_stiction {

/// Hash of 128 bits after FNV-1a (draft-eastlake-fnv), eight bytes at a time: content is told
/// apart, not protected against forgers.
class ContentHash {
 public:
  /// The next piece, in whatever pieces the content comes.
  void add(std::string_view bytes);
  /// 32 hexadecimal digits, of all pieces so far.
  std::string text() const;

 private:
  __extension__ using Wide = unsigned __int128;

  Wide state_ = Wide{0x6C62272E07BB0142} << 64 | Wide{0x62B821756295C58D};
  std::uint64_t size_ = 0;  ///< of all pieces [bytes]
  std::string rest_;        ///< of the last piece, less than a word
};

/// Of one piece.
std::string contentHash(std::string_view bytes);

/// "sha256:" and the 64 hexadecimal digits that the program sha256sum prints.
/// @throw FileError if this machine's OpenSSL does not offer it
std::string sha256Text(std::string_view bytes);

}  // namespace mems_stiction
