#include "monarch_flight/ros_io/token.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace monarch_flight {

Token Token::fromEnvironment() {
  const char* secret = std::getenv(kVariable);
  return Token(secret != nullptr ? secret : "");
}

void Token::code(const std::vector<std::uint8_t>& text, std::uint8_t* out) const {
  unsigned int size = 0;
  if (HMAC(EVP_sha256(), secret_.data(), static_cast<int>(secret_.size()), text.data(), text.size(),
           out, &size) == nullptr ||
      size != kSeal) {
    throw std::runtime_error("token: OpenSSL has no working HMAC-SHA256");
  }
}

bool Token::matches(const std::vector<std::uint8_t>& text, const std::uint8_t* seal) const {
  std::array<std::uint8_t, kSeal> expected;
  code(text, expected.data());
  return CRYPTO_memcmp(expected.data(), seal, kSeal) == 0;
}

}  // namespace monarch_flight
