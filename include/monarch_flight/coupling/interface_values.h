#pragma once
#include <Eigen/Dense>

#include "monarch_flight/coupling/participant.h"

namespace monarch_flight {

/// Every number of an interface in a fixed order: x, v, a, R_IB (column by column), Omega_B,
/// Omega_dot_B, pitch (q, qd, qdd), theta_R (q, qd, qdd).
using InterfaceValues = Eigen::Matrix<double, 30, 1>;
InterfaceValues interfaceValues(const Interface& interface);
Interface interfaceOf(const InterfaceValues& values);

/// Whether two interfaces are the same bit for bit (NaN never is).
bool same(const Interface& a, const Interface& b);
bool same(const Coordinate& a, const Coordinate& b);
/// Whether two requests are the same: key, time, interface, loads and wish for fields.
bool same(const Request& a, const Request& b);

/// Whether time, interface and loads of a message are finite numbers.
bool finite(const Request& request);
bool finite(const Reply& reply);

}  // namespace monarch_flight
