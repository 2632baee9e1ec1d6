#pragma once
#include <monarch_flight/CouplingKey.h>
#include <monarch_flight/GuidanceState.h>
#include <monarch_flight/IgnoredCounts.h>
#include <monarch_flight/InterfaceState.h>
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>
#include <monarch_flight/PrescribedLevel.h>
#include <monarch_flight/SubIteration.h>
#include <monarch_flight/WholeFlow.h>
#include <monarch_flight/WingLoads.h>
#include <monarch_flight/WingbeatCommand.h>

#include <memory>
#include <string>

#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/settings.h"

namespace monarch_flight {

/// Version of the lockstep protocol that this build speaks.
constexpr std::uint32_t kProtocolVersion = ParticipantRequest::PROTOCOL;

/// Core structs to messages and back. Every number crosses bit for bit: fromMessage(toMessage(x))
/// == x.
CouplingKey toMessage(const ExchangeKey& key);
InterfaceState toMessage(const Interface& interface);
WingLoads toMessage(const Loads& loads);
WholeFlow toMessage(const FlowField& flow);
std::shared_ptr<const FlowField> fromMessage(const WholeFlow& flow);
/// Why the arrays do not belong to one grid; empty when they do.
std::string problem(const WholeFlow& flow);

ParticipantRequest toMessage(const Request& request);
ParticipantReply toMessage(const Reply& reply);
SubIteration toMessage(const IterationRecord& record);
IgnoredCounts toMessage(const IgnoredMessages& ignored);
PrescribedLevel toMessage(const PrescribedState& prescribed);
/// `at_once` of the message is left as it is by default.
WingbeatCommand toMessage(const WingbeatChange& change);
GuidanceState toMessage(const GuidanceReport& report);

/// Precondition: problem(message) is empty (the phase is one of Phase).
ExchangeKey fromMessage(const CouplingKey& key);
Interface fromMessage(const InterfaceState& interface);
Loads fromMessage(const WingLoads& loads);
Request fromMessage(const ParticipantRequest& request);
Reply fromMessage(const ParticipantReply& reply);
IterationRecord fromMessage(const SubIteration& record);
IgnoredMessages fromMessage(const IgnoredCounts& ignored);
PrescribedState fromMessage(const PrescribedLevel& prescribed);
WingbeatChange fromMessage(const WingbeatCommand& command);

/// Why a message cannot be used (protocol version, phase, sizes); empty when it can. Says nothing
/// of the run.
std::string problem(const ParticipantRequest& request);
std::string problem(const ParticipantReply& reply);

/// True when every number of the state is finite.
bool finite(const Interface& interface);

/// "step 12, sub-iteration 3, ITERATE", for messages to people.
std::string describe(const ExchangeKey& key);

}  // namespace monarch_flight
