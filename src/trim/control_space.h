#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "monarch_flight/trim/phase_map.h"

namespace monarch_flight {

/// The part of a flight's state that one feedback law sees: about a flight in the plane of symmetry
/// what stays in the plane and what leaves it are two systems.
class ControlSpace {
 public:
  explicit ControlSpace(std::vector<std::size_t> given) : inputs(std::move(given)) {}
  virtual ~ControlSpace() = default;
  /// Scale of each of its states, and of the two integrals.
  virtual Eigen::VectorXd scales() const = 0;
  virtual Eigen::Vector2d integralScales() const = 0;
  /// The flight's state changed by a change of its states.
  virtual FlapState changed(FlapState state, const Eigen::VectorXd& change) const = 0;
  /// Its states at the end of a flight whose start was changed so, and the means that are
  /// integrated.
  virtual Eigen::VectorXd end(const PhaseFlight& flight, const Eigen::VectorXd& change) const = 0;
  virtual Eigen::Vector2d means(const PhaseFlight& flight, const Eigen::VectorXd& change) const = 0;

  const std::vector<std::size_t> inputs;
};

/// In the plane of symmetry: both wings alike; means of the velocity.
std::unique_ptr<ControlSpace> inPlaneSpace(const Case& c, std::vector<std::size_t> inputs);
/// Out of it (LateralState): the wings against each other; means of heading and side velocity.
std::unique_ptr<ControlSpace> lateralSpace(const Case& c, std::vector<std::size_t> inputs);

}  // namespace monarch_flight
