#include "monarch_flight/run/state_hash.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace monarch_flight {
namespace {

// The doubles of a step as little-endian bytes: 38, and 15 of a left wing of its own.
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
  std::array<unsigned char, 53 * 8> bytes_{};
  std::size_t size_ = 0;
};

void putLoads(Layout& layout, const Loads& loads) {
  for (const auto* v : {&loads.force_pressure, &loads.force_friction, &loads.moment_pressure,
                        &loads.moment_friction})
    layout.put(*v);
}

}  // namespace

void StateHash::add(const CommittedStep& step) {
  const BodyState& body = step.interface.body;
  Layout layout;
  layout.put(step.t);
  for (const auto* v : {&body.x, &body.v, &body.a}) layout.put(*v);
  const Quaternion& q = body.q_IB;
  for (double component : {q.w(), q.x(), q.y(), q.z()}) layout.put(component);
  for (const auto* v : {&body.Omega_B, &body.Omega_dot_B}) layout.put(*v);
  layout.put(body.pitch);
  layout.put(step.interface.theta.right);
  putLoads(layout, step.loads.right);
  if (!mirrored_) {
    layout.put(step.interface.theta.left);
    putLoads(layout, step.loads.left);
  }
  hash_.add(layout.data(), layout.size());
}

void StateHash::memory(StateVisitor& state) {
  std::vector<char> where = hash_.state();
  state.bytes("state_sha256", where);
  if (state.loading()) hash_.setState(where);
}

}  // namespace monarch_flight
