#pragma once
#include <memory>
#include <string>

#include "monarch_flight/coupling/settings.h"

namespace monarch_flight {

/// SHA-256 over the committed states, level 0 included, in order. Of each step these 43 IEEE
/// doubles, little-endian: t; x, v, a of the body; R_IB by rows; Omega_B, Omega_dot_B; pitch q, qd,
/// qdd; theta_R q, qd, qdd; force_pressure, force_friction, moment_pressure, moment_friction. Equal
/// hash: the same flight bit for bit.
class StateHash {
 public:
  StateHash();
  ~StateHash();
  void add(const CommittedStep& step);
  /// Of everything added so far, lower-case hex. More may be added afterwards.
  std::string hex() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monarch_flight
