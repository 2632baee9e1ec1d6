#pragma once
#include <monarch_flight/CouplingKey.h>
#include <monarch_flight/IgnoredCounts.h>
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>

#include <string>

#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/ros_io/fluid_conversions.h"
#include "monarch_flight/ros_io/guidance_conversions.h"
#include "monarch_flight/ros_io/state_conversions.h"

namespace monarch_flight {

/// Version of the lockstep protocol that this build speaks.
constexpr std::uint32_t kProtocolVersion = ParticipantRequest::PROTOCOL;

/// Core structs to messages and back. Every number crosses bit for bit: fromMessage(toMessage(x))
/// == x.
CouplingKey toMessage(const ExchangeKey& key);
ParticipantRequest toMessage(const Request& request);
ParticipantReply toMessage(const Reply& reply);
IgnoredCounts toMessage(const IgnoredMessages& ignored);

/// Precondition: problem(message) is empty (phase and sizes are possible).
ExchangeKey fromMessage(const CouplingKey& key);
Request fromMessage(const ParticipantRequest& request);
Reply fromMessage(const ParticipantReply& reply);
IgnoredMessages fromMessage(const IgnoredCounts& ignored);

/// Why a message cannot be used (protocol version, phase, sizes); empty when it can. Says nothing
/// of the run.
std::string problem(const ParticipantRequest& request);
std::string problem(const ParticipantReply& reply);

/// "step 12, sub-iteration 3, ITERATE", for messages to people.
std::string describe(const ExchangeKey& key);

}  // namespace monarch_flight
