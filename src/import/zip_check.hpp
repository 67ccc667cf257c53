#pragma once

/// @file
/// Is a zip archive whole, and is it no larger than a scan? The programs that read it unpack an
/// entry into memory, whatever its size.

#include <cstdint>
#include <string>
#include <vector>

namespace mems_stiction {

/// What the central directory states of one entry.
struct ZipEntry {
  std::string name;
  int method = 0;
  std::uint64_t packed = 0, size = 0, offset = 0;
  std::uint32_t checksum = 0;
};

/// The entries of an archive, of the 64-bit kind too.
/// @throw FileError without a file name if the directory is damaged, or all entries together unpack
/// to more than kMaxFileBytes
std::vector<ZipEntry> zipEntries(const std::string& bytes);

/// Is a zip archive (x3p, plux and others) whole? Unpacks every entry and compares size and CRC-32
/// with those that the archive states.
/// @throw FileError without a file name, naming the entry, if one differs; as zipEntries()
void checkZip(const std::string& bytes);

/// The same of an archive that may be x3p, whose entries are as large as the points that its
/// main.xml states need.
/// @throw FileError without a file name if one is larger, or main.xml stands in a folder
void checkX3p(const std::string& bytes);

}  // namespace mems_stiction
