#include "files/content_hash.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr Wide kPrime = (Wide{1} << 88) + 0x13B;
constexpr std::size_t kWord = sizeof(std::uint64_t);

/// Bytes beyond the end count as zeros; the content's size goes in at its end.
Wide withWord(Wide hash, std::string_view bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data(), std::min(kWord, bytes.size()));
  hash = (hash ^ word) * kPrime;
  return hash ^ hash >> 64;  // products carry upwards alone
}

}  // namespace

void ContentHash::add(std::string_view bytes) {
  size_ += bytes.size();
  if (!rest_.empty()) {
    const std::size_t taken = std::min(kWord - rest_.size(), bytes.size());
    rest_.append(bytes.substr(0, taken));
    bytes.remove_prefix(taken);
    if (rest_.size() < kWord) return;
    state_ = withWord(state_, rest_);
    rest_.clear();
  }
  for (; bytes.size() >= kWord; bytes.remove_prefix(kWord))
    state_ = withWord(state_, bytes.substr(0, kWord));
  rest_ = bytes;
}

std::string ContentHash::text() const {
  Wide hash = rest_.empty() ? state_ : withWord(state_, rest_);
  hash = (hash ^ size_) * kPrime;
  char text[40];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash >> 64),
                static_cast<unsigned long long>(hash));
  return text;
}

std::string contentHash(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes);
  return hash.text();
}

std::string sha256Text(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw FileError("its SHA-256 cannot be computed: OpenSSL does not offer it");
  }
  std::string text = "sha256:";
  for (unsigned int i = 0; i < size; ++i) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", digest.at(i));
    text += digits;
  }
  return text;
}

}  // namespace mems_stiction
