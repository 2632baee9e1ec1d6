#pragma once
#include <string>
#include <vector>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/trim/control_design.h"
#include "monarch_flight/trim/controlled_flight.h"

namespace monarch_flight {

/// The insect, its law, and what the law is asked to hold.
struct Subject {
  Case c;
  WingbeatSettings wingbeat;
  ControllerSettings law;
  SetPoint wanted;
  ControlledFlight fly(const ControlledStart& start) const {
    return flyControlled(c, wingbeat, law, start);
  }
};

/// Flaps after which the flight stays near the set point; none: -1.
int settled(const ControlledFlight& flight, const SetPoint& wanted, std::size_t from);

/// Studies of the lateral law; nothing where the subject has none.
inline const std::vector<std::string> kLateralStudies = {"turn", "sides", "cross_gust", "damage"};
void lateralStudy(const Subject& s, const std::string& what, const ControlOptions& options,
                  const std::string& config_dir);

}  // namespace monarch_flight
