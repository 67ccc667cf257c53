#include "mems_stiction/import/transfer_check.hpp"

#include <algorithm>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

/// By chance, one line feed of 256 stands behind a carriage return, and one high byte of thousands begins such a group.
constexpr std::size_t kTooManyForChance = 64;
constexpr const char* kReplaced = "\xEF\xBF\xBD";  // U+FFFD

/// Every line feed of the binary part stands behind a carriage return.
bool hasLineEndsOnly(const std::string& bytes, std::size_t binary) {
  std::size_t count = 0;
  for (std::size_t at = bytes.find('\n', binary); at != std::string::npos; at = bytes.find('\n', at + 1)) {
    if (at == 0 || bytes[at - 1] != '\r') return false;
    ++count;
  }
  return count >= kTooManyForChance;
}

/// No high byte but those of the sign that replaces what is no UTF-8.
bool hasReplacedBytes(const std::string& bytes) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (static_cast<unsigned char>(bytes[at]) < 0x80) continue;
    if (bytes.compare(at, 3, kReplaced) != 0) return false;
    at += 2;
    ++count;
  }
  return count >= kTooManyForChance;
}

}  // namespace

void checkTransfer(const std::string& bytes) {
  if (bytes.compare(0, 24, "version https://git-lfs.") == 0) {
    throw FileError("is a pointer of Git LFS, not the file itself: get it by 'git lfs pull'");
  }
  std::string start = bytes.substr(0, 15);
  std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) { return std::tolower(c); });
  if (start.compare(0, 14, "<!doctype html") == 0 || start.compare(0, 5, "<html") == 0) {
    throw FileError("is a web page, not a scan: what it was loaded from did not give the file itself");
  }
  const std::size_t binary = bytes.find('\0');
  if (binary == std::string::npos) return;  // text, where line ends may be of any kind
  if (hasLineEndsOnly(bytes, binary)) {
    throw FileError(
        "was transferred as text: every line feed in its data stands behind a carriage return; copy it anew, as "
        "binary");
  }
  if (hasReplacedBytes(bytes)) {
    throw FileError("was transferred as text: bytes of its data were replaced by U+FFFD; copy it anew, as binary");
  }
}

}  // namespace mems_stiction
