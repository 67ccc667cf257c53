#include "files/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <cstdio>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

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
