#include "monarch_flight/ros_io/guidance_conversions.h"

namespace monarch_flight {
WingbeatCommand toMessage(const WingbeatChange& change) {
  WingbeatCommand out;
  out.differential_amplitude = change.differential_amplitude;
  out.differential_flapping = change.differential_flapping;
  out.differential_deviation = change.differential_deviation;
  out.differential_rest_angle = change.differential_rest_angle;
  out.amplitude = change.amplitude;
  out.flapping_mean = change.flapping_mean;
  out.frequency = change.frequency;
  out.deviation_mean = change.deviation_mean;
  out.rest_angle = change.rest_angle;
  out.abdomen_mean = change.abdomen_mean;
  out.abdomen_amplitude = change.abdomen_amplitude;
  return out;
}

WingbeatChange fromMessage(const WingbeatCommand& command) {
  return {command.amplitude,
          command.flapping_mean,
          command.frequency,
          command.deviation_mean,
          command.rest_angle,
          command.abdomen_mean,
          command.abdomen_amplitude,
          command.differential_amplitude,
          command.differential_flapping,
          command.differential_deviation,
          command.differential_rest_angle};
}

GuidanceState toMessage(const GuidanceReport& report) {
  GuidanceState out;
  out.command = toMessage(report.command);
  out.applied = toMessage(report.applied);
  out.phase = report.phase;
  out.clipped = report.clipped;
  out.refused = report.refused;
  out.lost = report.lost;
  return out;
}

}  // namespace monarch_flight
