#pragma once
#include <array>
#include <string>
#include <vector>

#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/insect/wingbeat.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// One number for each command that a law uses.
using ControlInput = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, int(kCommands), 1>;

/// Names of commands, with commas between them.
std::string namesOf(const std::vector<std::size_t>& inputs);

/// Gains of a law that is periodic in the flap, for some of the commands.
struct FeedbackGains {
  std::vector<std::size_t> inputs;  ///< commands used, indices of kCommandTable
  /// Rows input + inputs.size() * phase: command for a deviation of the states, of the filters
  /// (value, rate, acceleration of each input in turn) and of the integrals.
  Eigen::MatrixXd state, filter, integral;

  Eigen::Index size() const { return static_cast<Eigen::Index>(inputs.size()); }
};

/// u = u_ref - K (x - x_ref) - K_c (c - u_ref) - K_i z at the samples of a flap: c the filters of
/// the commands, z integrals that stop where they would drive a limited input further. No
/// allocation behind the constructor.
class FeedbackLaw {
 public:
  explicit FeedbackLaw(FeedbackGains gains);
  void start();
  const FeedbackGains& gains() const { return gains_; }
  /// Whether a command of the last sample was cut, by what was taken of it.
  bool limited(const WingbeatChange& taken);
  /// Adds what the last sample adds to the integrals.
  void integrate(int phase, const Eigen::Vector2d& step);
  /// The commands are those of the reference.
  void refer(const ControlInput& commands) { asked_ = commands; }
  /// Adds the feedback of a deviation x - x_ref.
  void feedBack(int phase, const Eigen::Ref<const Eigen::VectorXd>& deviation,
                const std::array<Coordinate, kCommands>& applied);
  /// Sets this law's commands.
  void write(WingbeatChange& change) const;
  const Eigen::Vector2d& integral() const { return integral_; }
  /// Names begin with `owner`.
  void memory(StateVisitor& state, const std::string& owner);

 private:
  FeedbackGains gains_;
  Eigen::Vector2d integral_;
  ControlInput asked_;   // at the last sample
  ControlInput excess_;  // of it over what was taken
  ControlInput reference_;
};

}  // namespace monarch_flight
