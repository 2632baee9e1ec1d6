#pragma once
#include <string>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/run/sha256.h"

namespace monarch_flight {

/// SHA-256 over the committed states, level 0 included, in order. Of each step these 38 IEEE
/// doubles, little-endian: t; x, v, a of the body; q_IB as w, x, y, z; Omega_B, Omega_dot_B; pitch
/// q, qd, qdd; theta_R q, qd, qdd; force_pressure, force_friction, moment_pressure,
/// moment_friction. Equal hash: the same flight bit for bit. Where both wings are solved, of the
/// left one too: theta, loads.
class StateHash {
 public:
  explicit StateHash(bool mirrored) : mirrored_(mirrored) {}
  void add(const CommittedStep& step);
  /// Of everything added so far, lower-case hex. More may be added afterwards.
  std::string hex() const { return hash_.hex(); }
  void memory(StateVisitor& state);

 private:
  bool mirrored_;
  Sha256 hash_;
};

}  // namespace monarch_flight
