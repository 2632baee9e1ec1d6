#pragma once
#include <complex>
#include <vector>

#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// One sample of a linear periodic system: x_{j+1} = A x_j + B u_j.
struct LinearStage {
  Eigen::MatrixXd A, B;
};

struct PeriodicLqr {
  std::vector<Eigen::MatrixXd> gains;  ///< u_j = -gains[j] x_j
  Eigen::MatrixXd cost;                ///< x_0^T cost x_0 is what is left to pay from stage 0 on
  bool converged = false;
  int periods = 0;  ///< of the recursion
};

/// Feedback that minimises the sum over all time of x^T Q x + u^T R u, by Riccati's recursion
/// backwards over whole periods until the cost's largest relative change is below `tolerance`.
PeriodicLqr periodicLqr(const std::vector<LinearStage>& stages, const Eigen::MatrixXd& Q,
                        const Eigen::MatrixXd& R, double tolerance = 1e-10,
                        int max_periods = 10000);

/// Eigenvalues of the product of A - B K over a period (gains empty: of A), by magnitude, largest
/// first.
std::vector<std::complex<double>> multipliers(const std::vector<LinearStage>& stages,
                                              const std::vector<Eigen::MatrixXd>& gains);

}  // namespace monarch_flight
