#pragma once
#include <Eigen/Dense>
#include <memory>

#include "monarch_flight/coupling/settings.h"

namespace monarch_flight {

/// Of x, z, theta_B, theta_R, dimensionless; 0 where a coordinate is prescribed.
using CouplingVector = Eigen::Vector4d;

/// Strategy that finds d = H(d) from the answers H(d^k): the loop does not know which one it uses.
class Accelerator {
 public:
  virtual ~Accelerator() = default;
  /// Forgets the past: the next residual is the first one of a new fixed-point problem.
  virtual void reset() = 0;
  /// Replaces d = d^k by d^{k+1}, given the residual H(d^k) - d^k. Returns the relaxation factor
  /// applied.
  virtual double advance(CouplingVector& d, const CouplingVector& residual) = 0;
};

/// d^{k+1} = d^k + omega r^k.
class ConstantRelaxation : public Accelerator {
 public:
  explicit ConstantRelaxation(double omega) : omega_(omega) {}
  void reset() override {}
  double advance(CouplingVector& d, const CouplingVector& residual) override;

 private:
  double omega_;
};

/// Aitken's vector Delta^2 (Kuettler & Wall 2008):
/// omega_k = - omega_{k-1} r_{k-1}.(r_k - r_{k-1}) / |r_k - r_{k-1}|^2, its absolute value kept
/// within [omega_min, omega_max]; the last factor stays where the residual did not change.
class AitkenRelaxation : public Accelerator {
 public:
  AitkenRelaxation(double omega_initial, double omega_min, double omega_max);
  void reset() override;
  double advance(CouplingVector& d, const CouplingVector& residual) override;

 private:
  double omega_initial_, omega_min_, omega_max_;
  double omega_;
  bool has_previous_ = false;
  CouplingVector previous_;  // residual of the last sub-iteration
};

/// The strategy that the settings name.
std::unique_ptr<Accelerator> makeAccelerator(const CouplingSettings& settings);

}  // namespace monarch_flight
