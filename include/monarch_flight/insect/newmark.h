#pragma once
#include <array>
#include <cstddef>
#include <initializer_list>

#include "monarch_flight/insect/state.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// The coordinates that the equations of motion can move, in the order of all vectors of them.
enum FreeCoordinate : std::size_t { kX, kY, kZ, kRoll, kPitch, kYaw, kThetaR, kThetaL };
inline constexpr std::size_t kCoordinates = 8;
/// A number for each coordinate.
using CoordinateVector = Eigen::Matrix<double, kCoordinates, 1>;
using CoordinateMatrix = Eigen::Matrix<double, kCoordinates, kCoordinates>;

struct CoordinateInfo {
  const char* name;  ///< in messages and tables
  bool translation;  ///< a length, else an angle
};
inline constexpr std::array<CoordinateInfo, kCoordinates> kCoordinateTable = {{
    {"x", true},
    {"y", true},
    {"z", true},
    {"roll", false},
    {"theta_B", false},
    {"yaw", false},
    {"theta_R", false},
    {"theta_L", false},
}};

/// Which coordinates the equations of motion move; the others follow the prescribed motion. Turning
/// coordinates are those of the angular velocity in body axes.
class FreeCoordinates {
 public:
  FreeCoordinates() { is_.fill(false); }
  FreeCoordinates(std::initializer_list<FreeCoordinate> free) : FreeCoordinates() {
    for (FreeCoordinate i : free) is_[i] = true;
  }
  bool& operator[](std::size_t i) { return is_[i]; }
  bool operator[](std::size_t i) const { return is_[i]; }
  int count() const {
    int n = 0;
    for (bool free : is_) n += free;
    return n;
  }
  /// Of the body.
  bool body() const {
    return is_[kX] || is_[kY] || is_[kZ] || is_[kRoll] || is_[kPitch] || is_[kYaw];
  }
  /// y, roll or yaw: the body can leave its plane.
  bool lateral() const { return is_[kY] || is_[kRoll] || is_[kYaw]; }
  bool wingPitch() const { return is_[kThetaR] || is_[kThetaL]; }

 private:
  std::array<bool, kCoordinates> is_;
};

/// Accelerations of all coordinates: of the mass centre in F_I, of the body about its axes, of the
/// wings' pitch.
CoordinateVector accelerations(const Interface& interface);

/// Newmark-beta (average acceleration): q_{n+1} = q_n + dt qd_n + dt^2 ((1/2 - beta) qdd_n + beta
/// qdd_{n+1}).
struct Newmark {
  double beta = 0.25;
  double gamma = 0.5;
  double dt = 0.0;  ///< [s]

  /// The coordinate at n+1 for the acceleration qdd there.
  Coordinate advance(const Coordinate& n, double qdd) const {
    Coordinate next;
    next.q = n.q + dt * n.qd + dt * dt * ((0.5 - beta) * n.qdd + beta * qdd);
    next.qd = n.qd + dt * ((1.0 - gamma) * n.qdd + gamma * qdd);
    next.qdd = qdd;
    return next;
  }
};

}  // namespace monarch_flight
