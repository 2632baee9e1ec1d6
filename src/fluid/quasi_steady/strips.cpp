#include "fluid/quasi_steady/strips.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/math/angle.h"

namespace monarch_flight::fluid::quasi_steady {
namespace {

struct Rule {
  Eigen::VectorXd node, weight;  // on [-1, 1]
};

// Golub & Welsch: nodes and weights from the eigenvectors of the Legendre Jacobi matrix.
Rule gaussLegendre(int n) {
  Eigen::VectorXd off(std::max(n - 1, 0));
  for (int i = 1; i < n; ++i) off[i - 1] = i / std::sqrt(4.0 * i * i - 1.0);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(n), off);
  Rule rule;
  rule.node = solver.eigenvalues();
  rule.weight = 2.0 * solver.eigenvectors().row(0).transpose().cwiseAbs2();
  return rule;
}

Strip makeStrip(const Planform& planform, double y, double dy, double edge) {
  Strip s;
  s.y = y;
  s.dy = dy;
  s.edge = edge;
  s.chord = planform.chord(y);
  s.leading = planform.leading(y);
  s.reference = std::clamp(0.0, s.leading - s.chord, s.leading);
  return s;
}

}  // namespace

std::vector<Strip> makeStrips(const Planform& planform, int minimum) {
  std::vector<double> ends{planform.yRoot()};
  for (double y : planform.breaks())
    if (y > ends.back() && y < planform.yTip()) ends.push_back(y);
  ends.push_back(planform.yTip());

  std::vector<Strip> strips;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double half = 0.5 * (ends[i + 1] - ends[i]);
    const int n = std::max(3, static_cast<int>(std::ceil(minimum * 2.0 * half / planform.span())));
    const Rule rule = gaussLegendre(n);
    double edge = ends[i];
    for (int k = 0; k < n; ++k) {
      const double dy = half * rule.weight[k];
      const Strip s = makeStrip(planform, ends[i] + half * (1.0 + rule.node[k]), dy, edge);
      edge += dy;
      if (s.chord > 0.0) strips.push_back(s);
    }
  }
  return strips;
}

Matrix6d stripAddedMass(const std::vector<Strip>& strips, double rho) {
  Matrix6d M = Matrix6d::Zero();
  for (const Strip& s : strips) {
    Vector6d normal = Vector6d::Zero();  // normal velocity of mid-chord = normal . (v; omega)
    normal[2] = 1.0;
    normal[3] = s.y;
    normal[4] = -s.middle();
    const double c2 = s.chord * s.chord;
    M += (0.25 * kPi * rho * c2 * s.dy) * normal * normal.transpose();
    M(4, 4) += kPi / 128.0 * rho * c2 * c2 * s.dy;
  }
  const Matrix6d upper = M.triangularView<Eigen::Upper>();
  return upper.selfadjointView<Eigen::Upper>();  // symmetric to the last bit
}

}  // namespace monarch_flight::fluid::quasi_steady
