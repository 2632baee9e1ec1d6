#include "monarch_flight/trim/periodic_lqr.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace monarch_flight {

PeriodicLqr periodicLqr(const std::vector<LinearStage>& stages, const Eigen::MatrixXd& Q,
                        const Eigen::MatrixXd& R, double tolerance, int max_periods) {
  PeriodicLqr result;
  result.gains.resize(stages.size());
  Eigen::MatrixXd P = Q;
  for (result.periods = 0; result.periods < max_periods && !result.converged; ++result.periods) {
    const Eigen::MatrixXd before = P;
    for (std::size_t j = stages.size(); j-- > 0;) {
      const Eigen::MatrixXd& A = stages[j].A;
      const Eigen::MatrixXd& B = stages[j].B;
      const Eigen::MatrixXd PB = P * B;
      const Eigen::MatrixXd S = R + B.transpose() * PB;
      result.gains[j] = S.ldlt().solve(PB.transpose() * A);
      const Eigen::MatrixXd closed = A - B * result.gains[j];
      P = Q + closed.transpose() * P * closed +
          result.gains[j].transpose() * R * result.gains[j];  // Joseph's form: stays symmetric
      P = 0.5 * (P + P.transpose()).eval();
    }
    const double size = P.cwiseAbs().maxCoeff();
    result.converged = (P - before).cwiseAbs().maxCoeff() <= tolerance * size;
    if (!P.allFinite()) break;
  }
  result.cost = P;
  return result;
}

std::vector<std::complex<double>> multipliers(const std::vector<LinearStage>& stages,
                                              const std::vector<Eigen::MatrixXd>& gains) {
  const Eigen::Index n = stages.front().A.rows();
  Eigen::MatrixXd product = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t j = 0; j < stages.size(); ++j) {
    const Eigen::MatrixXd stage =
        gains.empty() ? stages[j].A : Eigen::MatrixXd(stages[j].A - stages[j].B * gains[j]);
    product = (stage * product).eval();
  }
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(product).eigenvalues();
  std::vector<std::complex<double>> all(values.data(), values.data() + n);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::make_pair(std::abs(a), a.imag()) > std::make_pair(std::abs(b), b.imag());
  });
  return all;
}

}  // namespace monarch_flight
