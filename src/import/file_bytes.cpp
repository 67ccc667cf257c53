#include "import/file_bytes.hpp"

#include "files/input_file.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

std::string readFileBytes(const std::string& path) {
  std::string bytes = readInput(path, {"a scan", kMaxFileBytes});
  if (bytes.empty()) throw FileError(path + ": is empty");
  return bytes;
}

void checkPixelCount(std::uint64_t cols, std::uint64_t rows) {
  const std::string size = std::to_string(cols) + " x " + std::to_string(rows) + " pixels";
  if (cols == 0 || rows == 0) throw FileError(size + " are no scan");
  if (cols > kMaxPixels / rows) {
    throw FileError(size + " are more than the " + std::to_string(kMaxPixels) +
                    " that a scan may have");
  }
}

}  // namespace mems_stiction
