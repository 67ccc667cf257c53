#include "mems_stiction/import/file_bytes.hpp"

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/input_file.hpp"

namespace mems_stiction {
namespace {

constexpr InputKind kScan = {"a scan", kMaxFileBytes};

std::string notEmpty(const std::string& path, std::string bytes) {
  if (bytes.empty()) throw FileError(path + ": is empty");
  return bytes;
}

}  // namespace

std::string readFileBytes(const std::string& path) { return notEmpty(path, readInput(path, kScan)); }

std::string readFileStart(const std::string& path, std::size_t count) {
  return notEmpty(path, readInputStart(path, kScan, count));
}

void checkPixelCount(std::uint64_t cols, std::uint64_t rows) {
  const std::string size = std::to_string(cols) + " x " + std::to_string(rows) + " pixels";
  if (cols == 0 || rows == 0) throw FileError(size + " are no scan");
  if (cols > kMaxPixels / rows) {
    throw FileError(size + " are more than the " + std::to_string(kMaxPixels) + " that a scan may have");
  }
}

}  // namespace mems_stiction
