#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/guidance/command_filter.h"
#include "monarch_flight/guidance/command_source.h"

namespace monarch_flight {

/// What a wingbeat that can be led takes.
struct WingbeatSettings {
  std::array<CommandLimits, kCommands> limits;
  double time_constant = 0.0;  ///< of every filter [s]
  double frequency = 0.0;      ///< of the motion [Hz], > 0
  double dt = 0.0;             ///< [s]
  /// Every fault at once, "guidance/limits/<command> = ...".
  std::vector<std::string> problems() const;
};

/// The case's motion with a wingbeat that can be led (docs/guidance.md). With s(t) a series of the
/// motion, m its mean over the flap that begins at t_start and x the filtered commands:
///   flapping   phi = s_phi(tau) + x_amplitude (s_phi(tau) - m_phi) + x_flapping_mean,
///   deviation  psi = s_psi(tau) + x_deviation_mean,
///   abdomen    theta_A = s_A(tau) + x_abdomen_amplitude (s_A(tau) - m_A) + x_abdomen_mean,
///   hinge      its rest angle is theta_0 + x_rest_angle,
///   clock      tau' = 1 + x_frequency, so flaps are counted by the phase f tau.
/// The body's prescribed coordinates follow the motion at t. Without a command it is the motion bit
/// for bit.
class WingbeatGuidance : public Guidance {
 public:
  /// `source` may be null: nobody leads. Throws InputError with every fault of the settings.
  WingbeatGuidance(std::shared_ptr<const PrescribedMotion> motion,
                   std::shared_ptr<const WindModel> wind, const WingbeatSettings& settings,
                   double t_start, std::unique_ptr<CommandSource> source);
  PrescribedState start(double t) override;
  PrescribedState next(const GuidanceInput& input) override;
  GuidanceReport report() const override { return report_; }
  void memory(StateVisitor& state) override;

 private:
  void take(const WingbeatChange& wanted);
  PrescribedState at(double t);
  Coordinate command(Command both, Side side) const;

  std::shared_ptr<const PrescribedMotion> motion_;
  std::shared_ptr<const WindModel> wind_;
  WingbeatSettings settings_;
  PerWing<double> phi_mean_;
  double abdomen_mean_;  // of the motion [rad]
  std::unique_ptr<CommandSource> source_;
  std::vector<CommandFilter> filters_;  // by kCommandTable
  std::array<Coordinate, kCommands> applied_{};
  GuidanceReport report_;
};

}  // namespace monarch_flight
