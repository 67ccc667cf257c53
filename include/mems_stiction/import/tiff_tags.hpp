#pragma once

/// @file
/// Some instruments write TIFF files whose pages are pictures or bare counts, with what makes them heights in tags or texts
/// of their own: Park Systems, JPK and Olympus LEXT. And how many pages there are.

#include <string>

namespace mems_stiction {

/// True if the first directory of the TIFF file has Park's tag 50432 with its magic number 0x0E031301, JPK's tags 32768 and
/// 32769 (versions of file and program), or LEXT's description. False for every other file, also for one that is damaged.
bool hasInstrumentTags(const std::string& bytes);

/// Pages by the list of them alone, whatever they hold; `most` if there are as many or more. libtiff takes a list that is
/// damaged for one that ends.
/// @throw FileError without a file name where the list leaves the file
int pageCount(const std::string& bytes, int most);

}  // namespace mems_stiction
