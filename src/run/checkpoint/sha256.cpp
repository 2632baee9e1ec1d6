// OpenSSL's newer interface cannot write a half-done hash down; its older one is a plain struct.
#define OPENSSL_SUPPRESS_DEPRECATED
#include "monarch_flight/run/sha256.h"

#include <openssl/sha.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace monarch_flight {
namespace {

void require(int ok) {
  if (ok != 1) throw std::runtime_error("OpenSSL cannot compute SHA-256");
}

}  // namespace

struct Sha256::Impl {
  SHA256_CTX context;
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) { require(SHA256_Init(&impl_->context)); }

Sha256::~Sha256() = default;

void Sha256::add(const void* bytes, std::size_t size) {
  require(SHA256_Update(&impl_->context, bytes, size));
}

std::string Sha256::hex() const {
  SHA256_CTX copy = impl_->context;
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  require(SHA256_Final(digest.data(), &copy));
  static const char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::vector<char> Sha256::state() const {
  std::vector<char> bytes(sizeof(SHA256_CTX));
  std::memcpy(bytes.data(), &impl_->context, bytes.size());
  return bytes;
}

void Sha256::setState(const std::vector<char>& state) {
  if (state.size() != sizeof(SHA256_CTX))
    throw std::invalid_argument("SHA-256: the state is of another program");
  std::memcpy(&impl_->context, state.data(), state.size());
}

std::string sha256Hex(std::string_view text) {
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.hex();
}

}  // namespace monarch_flight
