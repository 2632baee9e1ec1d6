#pragma once
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// Every number of an interface in a fixed order: x, v, a, q_IB (w, x, y, z), Omega_B,
/// Omega_dot_B, pitch, theta of the right and of the left wing (each q, qd, qdd).
using InterfaceValues = Eigen::Matrix<double, 28, 1>;
InterfaceValues interfaceValues(const Interface& interface);
Interface interfaceOf(const InterfaceValues& values);

/// The same of everything prescribed: the interface, then phi and psi of the right and of the left
/// wing, theta_A (each q, qd, qdd), the rest angles, the wind's velocity and acceleration.
using PrescribedValues = Eigen::Matrix<double, 51, 1>;
PrescribedValues prescribedValues(const PrescribedState& prescribed);
PrescribedState prescribedOf(const PrescribedValues& values);

/// Whether two interfaces are the same bit for bit (NaN never is).
bool same(const Interface& a, const Interface& b);
bool same(const Coordinate& a, const Coordinate& b);
/// Whether two requests are the same: key, time, what is prescribed, interface, loads and wishes.
bool same(const Request& a, const Request& b);

/// Whether it is of length 1 (to 1e-6 of its square): an attitude.
bool isAttitude(const Quaternion& q);

/// Whether every number of a message is finite; of commands guidance itself takes care.
bool finite(const Request& request);
bool finite(const Reply& reply);

}  // namespace monarch_flight
