#pragma once
#include <functional>
#include <optional>
#include <string>

#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// What shall vanish at trimmed flight, dimensionless. `periodicity` has one row a state and is
/// driven to zero; `targets` (any number, none included) are met as well as the parameters' bounds
/// allow, in the sense of least squares.
struct TrimResidual {
  Eigen::VectorXd periodicity;
  Eigen::VectorXd targets;
  Eigen::VectorXd stacked() const;
};

/// Residual at dimensionless unknowns (states first, then parameters); nothing where the flight
/// fails. Called from several threads at once when `threads` > 1.
using TrimFunction = std::function<std::optional<TrimResidual>(const Eigen::VectorXd&)>;

struct NewtonSettings {
  double tolerance = 1e-6;       ///< on every component of the periodicity
  double step_tolerance = 1e-4;  ///< on the last change of every parameter, with targets
  int max_iterations = 30;
  double max_step = 2.0;  ///< largest change of an unknown in one iteration
  int max_halvings = 6;   ///< of a step that does not reduce the residual
  double damping = 1e-4;  ///< of a step of the parameters (Levenberg's), targets count 1
  /// Of the periodicity beside the targets in steps that seek both at once, for maps whose periodic
  /// flights turn back in a parameter (multipliers near 1). 0: periodicity first, targets after it.
  double weight = 0.0;
  /// Converged where the step of least squares (weight > 0) moves no unknown by more than
  /// step_tolerance, however large the periodicity is there.
  bool least_squares = false;
  double difference = 1e-3;      ///< step of the finite differences
  bool central = true;           ///< central differences, else forward
  bool broyden = false;          ///< one Jacobian by differences, rank-one updates after it
  int threads = 1;               ///< evaluations at once
  Eigen::VectorXd lower, upper;  ///< bounds of the parameters
};

struct NewtonResult {
  bool converged = false;
  std::string reason;  ///< why it ended
  Eigen::VectorXd unknowns;
  TrimResidual residual;
  Eigen::MatrixXd jacobian;  ///< of the stacked residual
  int iterations = 0, evaluations = 0;
};

/// Jacobian of the stacked residual by finite differences. Throws NumericalError when a perturbed
/// flight fails.
Eigen::MatrixXd differenceJacobian(const TrimFunction& f, const Eigen::VectorXd& at,
                                   const TrimResidual& residual, const NewtonSettings& settings,
                                   int& evaluations);

/// The full step to periodic flight (linearised) on which the parameters, within their bounds,
/// bring the targets closest; with settings.weight the step of least squares of both, no unknown
/// moving by more than `limit`. `n` states stand in front.
Eigen::VectorXd trimStep(const Eigen::MatrixXd& jacobian, const TrimResidual& residual,
                         const Eigen::VectorXd& unknowns, const NewtonSettings& settings,
                         double limit);

/// Newton's method with bounded steps and a backtracking line search, or Broyden's from a given
/// `jacobian` (empty: by differences). `accepted` hears of every iteration's point. Throws
/// NumericalError when the flight from `start` itself fails.
NewtonResult solveTrim(const TrimFunction& f, const Eigen::VectorXd& start,
                       const NewtonSettings& settings, Eigen::MatrixXd jacobian,
                       const std::function<void(const NewtonResult&)>& accepted);

}  // namespace monarch_flight
