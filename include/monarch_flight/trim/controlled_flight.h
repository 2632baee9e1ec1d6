#pragma once
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/guidance/wingbeat_guidance.h"
#include "monarch_flight/insect/wind_model.h"
#include "monarch_flight/trim/flap_map.h"

namespace monarch_flight {

/// What a controlled flight begins with and flies through.
struct ControlledStart {
  FlapState change =
      FlapState::Zero();  ///< of the state that the controller refers to at the start
  std::shared_ptr<const WindModel> wind = std::make_shared<SteadyWind>();
  int flaps = 0;
  bool uncontrolled = false;  ///< commands stay those of the reference
};

/// One flap of it.
struct ControlledFlap {
  double speed = 0.0, climb = 0.0;  ///< of the mean velocity over ground [m/s], [rad]
  double theta_B_mean = 0.0, theta_B_low = 0.0, theta_B_high = 0.0;  ///< [rad]
  double turn = 0.0;                       ///< change of the heading [rad]
  double side_velocity = 0.0;              ///< mean, to the right of the heading, over ground [m/s]
  double roll_low = 0.0, roll_high = 0.0;  ///< [rad]
  WingbeatChange command_low, command_high;  ///< taken
  bool limited = false;                      ///< a command was cut in it
};

struct ControlledFlight {
  bool complete = false;
  bool lost = false;
  std::string failure;
  std::vector<ControlledFlap> flaps;
};

/// Flies a case's insect from t_start under a controller, in the case's air; the start is the first
/// set point's reference, changed. The wingbeat's settings are the guidance's.
ControlledFlight flyControlled(const Case& c, const WingbeatSettings& wingbeat,
                               const ControllerSettings& controller, const ControlledStart& start);

}  // namespace monarch_flight
