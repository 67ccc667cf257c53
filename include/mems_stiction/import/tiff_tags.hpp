#pragma once

/// @file
/// Park Systems' AFM files are TIFF files too: their pixels are a colour picture of the scan, the heights are in tags.

#include <string>

namespace mems_stiction {

/// True if the first directory of the TIFF file has Park's tag 50432 with its magic number 0x0E031301. False for every
/// other file, also for one that is damaged.
bool hasParkTags(const std::string& bytes);

}  // namespace mems_stiction
