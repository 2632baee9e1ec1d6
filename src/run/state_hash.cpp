#include "monarch_flight/run/state_hash.h"

#include <openssl/evp.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace monarch_flight {
namespace {

struct FreeContext {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};
using Context = std::unique_ptr<EVP_MD_CTX, FreeContext>;

void require(int ok) {
  if (ok != 1) throw std::runtime_error("state hash: OpenSSL has no working SHA-256");
}

// The 43 doubles of a step as little-endian bytes.
class Layout {
 public:
  void put(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; ++i) bytes_[size_++] = static_cast<unsigned char>(bits >> (8 * i));
  }
  void put(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) put(v[i]);
  }
  void put(const Coordinate& c) {
    put(c.q);
    put(c.qd);
    put(c.qdd);
  }
  const unsigned char* data() const { return bytes_.data(); }
  std::size_t size() const { return size_; }

 private:
  std::array<unsigned char, 43 * 8> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace

struct StateHash::Impl {
  Context context{EVP_MD_CTX_new()};
};

StateHash::StateHash() : impl_(std::make_unique<Impl>()) {
  require(impl_->context != nullptr);
  require(EVP_DigestInit_ex(impl_->context.get(), EVP_sha256(), nullptr));
}

StateHash::~StateHash() = default;

void StateHash::add(const CommittedStep& step) {
  const BodyState& body = step.interface.body;
  Layout layout;
  layout.put(step.t);
  for (const auto* v : {&body.x, &body.v, &body.a}) layout.put(*v);
  for (int i = 0; i < 3; ++i) layout.put(Eigen::Vector3d(body.R_IB.row(i)));
  for (const auto* v : {&body.Omega_B, &body.Omega_dot_B}) layout.put(*v);
  layout.put(body.pitch);
  layout.put(step.interface.theta_R);
  const Loads& loads = step.loads;
  for (const auto* v : {&loads.force_pressure, &loads.force_friction, &loads.moment_pressure,
                        &loads.moment_friction})
    layout.put(*v);
  require(EVP_DigestUpdate(impl_->context.get(), layout.data(), layout.size()));
}

std::string StateHash::hex() const {
  const Context copy(EVP_MD_CTX_new());
  require(copy != nullptr);
  require(EVP_MD_CTX_copy_ex(copy.get(), impl_->context.get()));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  require(EVP_DigestFinal_ex(copy.get(), digest.data(), &size));
  static const char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

}  // namespace monarch_flight
