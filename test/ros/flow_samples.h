// Air and pressure that the tests of rviz's pictures look at.
#pragma once

#include <string>

#include "monarch_flight/ros_io/fluid_conversions.h"
#include "monarch_flight/viz/flow_scene.h"

namespace monarch_flight {

inline Case caseWith(const std::string& wings) {
  return loadCase("climb_printed", {{"fluid", "quasi_steady"}, {"wings", wings}}, CONFIG_DIR);
}

inline SurfacePressure surface(float p) {
  return {{{-0.01f, 0.02f, 0.002f, 0.004f, p, -2.0f * p}, {0.01f, 0.03f, 0.003f, 0.005f, 0.0f, p}}};
}

/// Air that turns as a solid within a ball, with Q = 0 outside.
inline FlowPicture ball(float radius) {
  FlowPicture p;
  p.origin = {-0.02f, 0.01f, -0.02f};
  p.spacing = 0.001f;
  p.size = {41, 41, 41};
  p.step = 0.01f;
  for (int k = 0; k < 41; ++k) {
    for (int j = 0; j < 41; ++j) {
      for (int i = 0; i < 41; ++i) {
        const Eigen::Vector3f r(0.001f * float(i - 20), 0.001f * float(j - 20),
                                0.001f * float(k - 20));
        p.q_root.push_back(static_cast<std::int16_t>(1e5f * (2.0f * radius - r.norm())));
        p.omega_y.push_back(static_cast<std::int16_t>(i < 20 ? -500 : 500));
      }
    }
  }
  return p;
}

}  // namespace monarch_flight
