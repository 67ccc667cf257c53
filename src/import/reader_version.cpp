#include "mems_stiction/import/reader_version.hpp"

namespace mems_stiction {

std::string readerVersion() { return MEMS_STICTION_READERS; }

}  // namespace mems_stiction
