#include "files/content_hash.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

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

}  // namespace mems_stiction
