#include "monarch_flight/ros_io/token.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <stdexcept>

namespace monarch_flight {
namespace {

constexpr std::size_t kSeal = 32;  // bytes at the end of a message

}  // namespace

void Token::seal(const std::string& topic, const std::vector<std::uint8_t>& bytes,
                 std::uint8_t* out) const {
  std::vector<std::uint8_t> text(topic.begin(), topic.end());
  text.push_back(0);
  text.insert(text.end(), bytes.begin(), bytes.end() - kSeal);
  unsigned int size = 0;
  if (HMAC(EVP_sha256(), secret_.data(), static_cast<int>(secret_.size()), text.data(), text.size(),
           out, &size) == nullptr ||
      size != kSeal) {
    throw std::runtime_error("token: OpenSSL has no working HMAC-SHA256");
  }
}

bool Token::sealed(const std::string& topic, const std::vector<std::uint8_t>& bytes) const {
  if (bytes.size() < kSeal) return false;
  std::array<std::uint8_t, kSeal> expected;
  seal(topic, bytes, expected.data());
  return CRYPTO_memcmp(expected.data(), bytes.data() + (bytes.size() - kSeal), kSeal) == 0;
}

}  // namespace monarch_flight
