#pragma once
#include <monarch_flight/BodyMotion.h>
#include <monarch_flight/InterfaceState.h>
#include <monarch_flight/JointMotion.h>
#include <monarch_flight/PrescribedLevel.h>
#include <monarch_flight/WingJoints.h>
#include <monarch_flight/WingLoads.h>

#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// Body, joints and loads of a time level to messages and back. Every number crosses bit for bit.
JointMotion toMessage(const Coordinate& coordinate);
BodyMotion toMessage(const BodyState& body);
WingJoints toMessage(const WingAngles& angles, double rest_angle);
InterfaceState toMessage(const Interface& interface);
WingLoads toMessage(const Loads& loads);
PrescribedLevel toMessage(const PrescribedState& prescribed);

BodyState fromMessage(const BodyMotion& body);
/// Without the rest angle.
WingAngles fromMessage(const WingJoints& joints);
Interface fromMessage(const InterfaceState& interface);
Loads fromMessage(const WingLoads& loads);
PrescribedState fromMessage(const PrescribedLevel& prescribed);

/// True when every number of the state is finite.
bool finite(const Interface& interface);

}  // namespace monarch_flight
