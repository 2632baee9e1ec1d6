#include <algorithm>

#include "monarch_flight/ros_io/conversions.h"

namespace monarch_flight {
namespace {

constexpr std::size_t kLargestPicture = 1000000;  // facets, or points, of one message

std::string problem(std::uint32_t protocol, const CouplingKey& key) {
  if (protocol != kProtocolVersion) {
    return "protocol version " + std::to_string(protocol) + " instead of " +
           std::to_string(kProtocolVersion);
  }
  if (key.phase > CouplingKey::RESTORE) return "unknown phase " + std::to_string(key.phase);
  return "";
}

}  // namespace

CouplingKey toMessage(const ExchangeKey& key) {
  CouplingKey out;
  out.run = key.run;
  out.step = key.step;
  out.iteration = key.iteration;
  out.phase = static_cast<std::uint8_t>(key.phase);
  out.reset = key.reset;
  return out;
}

ExchangeKey fromMessage(const CouplingKey& key) {
  return {key.run, key.step, key.iteration, static_cast<Phase>(key.phase), key.reset};
}

ParticipantRequest toMessage(const Request& request) {
  ParticipantRequest out;
  out.protocol = kProtocolVersion;
  out.key = toMessage(request.key);
  out.t = request.t;
  out.prescribed = toMessage(request.prescribed);
  out.interface = toMessage(request.interface);
  out.right_loads = toMessage(request.loads.right);
  out.left_loads = toMessage(request.loads.left);
  out.want_operator = request.want_operator;
  out.want_surface = request.want_surface;
  out.block_points = request.block_points;
  out.want_flow = request.want_flow;
  out.checkpoints = request.checkpoints;
  return out;
}

Request fromMessage(const ParticipantRequest& request) {
  Request out;
  out.key = fromMessage(request.key);
  out.t = request.t;
  out.prescribed = fromMessage(request.prescribed);
  out.interface = fromMessage(request.interface);
  out.loads = {fromMessage(request.right_loads), fromMessage(request.left_loads)};
  out.want_operator = request.want_operator;
  out.want_surface = request.want_surface;
  out.block_points = request.block_points;
  out.want_flow = request.want_flow;
  out.checkpoints = request.checkpoints;
  return out;
}

ParticipantReply toMessage(const Reply& reply) {
  ParticipantReply out;
  out.protocol = kProtocolVersion;
  out.key = toMessage(reply.key);
  out.interface = toMessage(reply.interface);
  if (reply.prescribed) out.prescribed.push_back(toMessage(*reply.prescribed));
  if (reply.command) out.command.push_back(toMessage(*reply.command));
  out.lost = reply.guidance.lost;
  out.loads = toMessage(reply.loads);
  const FluidReport& report = reply.report;
  out.courant = report.courant;
  out.divergence = report.divergence;
  out.cells = static_cast<std::uint64_t>(report.cells);
  if (!report.added_mass.isZero(0.0)) out.added_mass = columnsOf(report.added_mass);
  out.operator_cost = static_cast<std::uint32_t>(report.operator_cost);
  if (reply.jacobian) out.load_operator.push_back(toMessage(*reply.jacobian));
  out.wall_s = reply.wall_s;
  if (report.kernel_s != KernelTimes{}) out.kernel_times.push_back(toMessage(report.kernel_s));
  out.error = reply.error;
  out.surface.reserve(reply.surface.facets.size());
  for (const SurfacePressure::Facet& f : reply.surface.facets) out.surface.push_back(toMessage(f));
  if (!reply.picture.empty()) out.block.push_back(toMessage(reply.picture));
  if (reply.flow) out.flow.push_back(toMessage(*reply.flow));
  return out;
}

Reply fromMessage(const ParticipantReply& reply) {
  Reply out;
  out.key = fromMessage(reply.key);
  out.interface = fromMessage(reply.interface);
  if (!reply.prescribed.empty()) out.prescribed = fromMessage(reply.prescribed.front());
  if (!reply.command.empty()) out.command = fromMessage(reply.command.front());
  out.guidance.lost = reply.lost;
  out.loads = fromMessage(reply.loads);
  out.report.courant = reply.courant;
  out.report.divergence = reply.divergence;
  out.report.cells = static_cast<long>(reply.cells);
  if (!reply.added_mass.empty()) out.report.added_mass = matrixOf(reply.added_mass);
  out.report.operator_cost = static_cast<int>(reply.operator_cost);
  if (!reply.load_operator.empty()) out.jacobian = fromMessage(reply.load_operator.front());
  out.wall_s = reply.wall_s;
  if (!reply.kernel_times.empty()) out.report.kernel_s = fromMessage(reply.kernel_times.front());
  out.error = reply.error;
  out.surface.facets.reserve(reply.surface.size());
  for (const PressureFacet& f : reply.surface) out.surface.facets.push_back(fromMessage(f));
  if (!reply.block.empty()) out.picture = fromMessage(reply.block.front());
  if (!reply.flow.empty()) out.flow = fromMessage(reply.flow.front());
  return out;
}

IgnoredCounts toMessage(const IgnoredMessages& ignored) {
  IgnoredCounts out;
  out.late = ignored.late;
  out.repeated = ignored.repeated;
  out.foreign = ignored.foreign;
  out.malformed = ignored.malformed;
  out.forged = ignored.forged;
  return out;
}

IgnoredMessages fromMessage(const IgnoredCounts& ignored) {
  return {ignored.late, ignored.repeated, ignored.foreign, ignored.malformed, ignored.forged};
}

std::string problem(const ParticipantRequest& request) {
  if (request.block_points > kLargestPicture)
    return "a picture of " + std::to_string(request.block_points) + " points";
  return problem(request.protocol, request.key);
}

std::string problem(const ParticipantReply& reply) {
  const std::size_t columns = reply.added_mass.size();
  if (columns != 0 && columns != 6)
    return "added mass of " + std::to_string(columns) + " columns, not 6";
  if (reply.load_operator.size() > 1)
    return std::to_string(reply.load_operator.size()) + " load operators, at most one fits";
  if (reply.kernel_times.size() > 1)
    return std::to_string(reply.kernel_times.size()) + " times by kernel, at most one fits";
  if (std::max(reply.prescribed.size(), reply.command.size()) > 1)
    return "more than one prescribed level or command";
  if (reply.flow.size() > 1) return std::to_string(reply.flow.size()) + " flows, at most one fits";
  for (const WholeFlow& flow : reply.flow) {
    std::string misfit = problem(flow);
    if (!misfit.empty()) return misfit;
  }
  if (reply.block.size() > 1)
    return std::to_string(reply.block.size()) + " blocks of the flow, at most one fits";
  for (const FlowBlock& block : reply.block) {
    std::string misfit = problem(block);
    if (!misfit.empty()) return misfit;
  }
  if (reply.surface.size() > kLargestPicture)
    return "a picture of " + std::to_string(reply.surface.size()) + " facets";
  return problem(reply.protocol, reply.key);
}

std::string describe(const ExchangeKey& key) {
  return "step " + std::to_string(key.step) + ", sub-iteration " + std::to_string(key.iteration) +
         ", " + phaseName(key.phase);
}

}  // namespace monarch_flight
