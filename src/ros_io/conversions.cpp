#include "monarch_flight/ros_io/conversions.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {
namespace {

constexpr std::size_t kLargestPicture = 1000000;  // facets or vortex points of one message

using Array3 = boost::array<double, 3>;
using Array9 = boost::array<double, 9>;

Array3 array(const Eigen::Vector3d& v) { return {{v.x(), v.y(), v.z()}}; }
Array3 array(const Coordinate& c) { return {{c.q, c.qd, c.qdd}}; }
Eigen::Vector3d vector(const Array3& a) { return {a[0], a[1], a[2]}; }
Coordinate coordinate(const Array3& a) { return {a[0], a[1], a[2]}; }

Array9 rowByRow(const Eigen::Matrix3d& R) {
  Array9 out;
  for (int i = 0; i < 9; ++i) out[i] = R(i / 3, i % 3);
  return out;
}

Eigen::Matrix3d matrix(const Array9& rows) {
  Eigen::Matrix3d R;
  for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = rows[i];
  return R;
}

bool finite(const Coordinate& c) {
  return std::isfinite(c.q) && std::isfinite(c.qd) && std::isfinite(c.qdd);
}

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

InterfaceState toMessage(const Interface& interface) {
  const BodyState& body = interface.body;
  InterfaceState out;
  out.position = array(body.x);
  out.velocity = array(body.v);
  out.acceleration = array(body.a);
  out.attitude = rowByRow(body.R_IB);
  out.angular_velocity = array(body.Omega_B);
  out.angular_acceleration = array(body.Omega_dot_B);
  out.theta_b = array(body.pitch);
  out.theta_r = array(interface.theta.right);
  out.theta_l = array(interface.theta.left);
  return out;
}

Interface fromMessage(const InterfaceState& interface) {
  Interface out;
  out.body.x = vector(interface.position);
  out.body.v = vector(interface.velocity);
  out.body.a = vector(interface.acceleration);
  out.body.R_IB = matrix(interface.attitude);
  out.body.Omega_B = vector(interface.angular_velocity);
  out.body.Omega_dot_B = vector(interface.angular_acceleration);
  out.body.pitch = coordinate(interface.theta_b);
  out.theta = {coordinate(interface.theta_r), coordinate(interface.theta_l)};
  return out;
}

WingLoads toMessage(const Loads& loads) {
  WingLoads out;
  out.force_pressure = array(loads.force_pressure);
  out.force_friction = array(loads.force_friction);
  out.moment_pressure = array(loads.moment_pressure);
  out.moment_friction = array(loads.moment_friction);
  return out;
}

Loads fromMessage(const WingLoads& loads) {
  Loads out;
  out.force_pressure = vector(loads.force_pressure);
  out.force_friction = vector(loads.force_friction);
  out.moment_pressure = vector(loads.moment_pressure);
  out.moment_friction = vector(loads.moment_friction);
  return out;
}

ParticipantRequest toMessage(const Request& request) {
  ParticipantRequest out;
  out.protocol = kProtocolVersion;
  out.key = toMessage(request.key);
  out.t = request.t;
  out.prescribed = toMessage(request.prescribed);
  out.interface = toMessage(request.interface);
  out.loads = toMessage(request.loads.right);
  out.loads_l = toMessage(request.loads.left);
  out.want_operator = request.want_operator;
  out.want_fields = request.want_fields;
  out.q_threshold = request.q_threshold;
  out.vortex_limit = static_cast<std::uint32_t>(request.vortex_limit);
  out.want_flow = request.want_flow;
  return out;
}

Request fromMessage(const ParticipantRequest& request) {
  Request out;
  out.key = fromMessage(request.key);
  out.t = request.t;
  out.prescribed = fromMessage(request.prescribed);
  out.interface = fromMessage(request.interface);
  out.loads = {fromMessage(request.loads), fromMessage(request.loads_l)};
  out.want_operator = request.want_operator;
  out.want_fields = request.want_fields;
  out.q_threshold = request.q_threshold;
  out.vortex_limit = static_cast<int>(request.vortex_limit);
  out.want_flow = request.want_flow;
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
  out.courant = reply.report.courant;
  out.divergence = reply.report.divergence;
  out.cells = static_cast<std::uint64_t>(reply.report.cells);
  const Matrix6d& M = reply.report.added_mass;
  if (!M.isZero(0.0)) {
    for (int i = 0; i < 36; ++i) out.added_mass.push_back(M(i / 6, i % 6));
  }
  out.operator_cost = static_cast<std::uint32_t>(reply.report.operator_cost);
  if (reply.jacobian) {
    for (const Matrix6d* m : {&reply.jacobian->velocity, &reply.jacobian->acceleration}) {
      for (int i = 0; i < 36; ++i) out.load_operator.push_back((*m)(i / 6, i % 6));
    }
  }
  out.wall_s = reply.wall_s;
  const KernelTimes& kernels = reply.report.kernel_s;
  if (kernels != KernelTimes{}) out.kernel_s.assign(kernels.begin(), kernels.end());
  out.error = reply.error;
  out.surface.reserve(reply.surface.facets.size());
  for (const SurfacePressure::Facet& f : reply.surface.facets) {
    PressureFacet facet;
    facet.x = f.x;
    facet.y = f.y;
    facet.dx = f.dx;
    facet.dy = f.dy;
    facet.p_upper = f.p_upper;
    facet.p_lower = f.p_lower;
    out.surface.push_back(facet);
  }
  out.vortices.reserve(reply.vortices.size());
  for (const VortexPoint& v : reply.vortices) {
    VortexSample sample;
    sample.x = v.x;
    sample.y = v.y;
    sample.z = v.z;
    sample.q = v.q;
    sample.omega_y = v.omega_y;
    out.vortices.push_back(sample);
  }
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
  for (std::size_t i = 0; i < reply.added_mass.size(); ++i) {
    out.report.added_mass(static_cast<int>(i) / 6, static_cast<int>(i) % 6) = reply.added_mass[i];
  }
  out.report.operator_cost = static_cast<int>(reply.operator_cost);
  if (!reply.load_operator.empty()) {
    out.jacobian.emplace();
    for (std::size_t i = 0; i < reply.load_operator.size(); ++i) {
      Matrix6d& m = i < 36 ? out.jacobian->velocity : out.jacobian->acceleration;
      m(static_cast<int>(i % 36) / 6, static_cast<int>(i % 6)) = reply.load_operator[i];
    }
  }
  out.wall_s = reply.wall_s;
  std::copy(reply.kernel_s.begin(), reply.kernel_s.end(), out.report.kernel_s.begin());
  out.error = reply.error;
  out.surface.facets.reserve(reply.surface.size());
  for (const PressureFacet& f : reply.surface) {
    out.surface.facets.push_back({f.x, f.y, f.dx, f.dy, f.p_upper, f.p_lower});
  }
  out.vortices.reserve(reply.vortices.size());
  for (const VortexSample& v : reply.vortices) {
    out.vortices.push_back({v.x, v.y, v.z, v.q, v.omega_y});
  }
  if (!reply.flow.empty()) out.flow = fromMessage(reply.flow.front());
  return out;
}

SubIteration toMessage(const IterationRecord& record) {
  SubIteration out;
  out.step = record.step;
  out.iteration = record.iteration;
  out.attempt = record.attempt;
  std::copy(record.residual.begin(), record.residual.end(), out.residual.begin());
  out.load_residual = record.load_residual;
  out.relaxation = record.relaxation;
  out.fluid_wall_s = record.fluid_wall_s;
  return out;
}

IterationRecord fromMessage(const SubIteration& record) {
  IterationRecord out;
  out.step = record.step;
  out.iteration = record.iteration;
  out.attempt = record.attempt;
  std::copy(record.residual.begin(), record.residual.end(), out.residual.begin());
  out.load_residual = record.load_residual;
  out.relaxation = record.relaxation;
  out.fluid_wall_s = record.fluid_wall_s;
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
  if (request.vortex_limit > kLargestPicture)
    return "a picture of " + std::to_string(request.vortex_limit) + " parts";
  return problem(request.protocol, request.key);
}

std::string problem(const ParticipantReply& reply) {
  const std::size_t size = reply.added_mass.size();
  if (size != 0 && size != 36) return "added mass of " + std::to_string(size) + " numbers, not 36";
  const std::size_t numbers = reply.load_operator.size();
  if (numbers != 0 && numbers != 72) {
    return "load operator of " + std::to_string(numbers) + " numbers, not 72";
  }
  const std::size_t kernels = reply.kernel_s.size();
  if (kernels != 0 && kernels != kKernels) {
    return "times of " + std::to_string(kernels) + " kernels, not " + std::to_string(kKernels);
  }
  if (std::max(reply.prescribed.size(), reply.command.size()) > 1)
    return "more than one prescribed level or command";
  if (reply.flow.size() > 1) return std::to_string(reply.flow.size()) + " flows, at most one fits";
  for (const WholeFlow& flow : reply.flow) {
    std::string misfit = problem(flow);
    if (!misfit.empty()) return misfit;
  }
  const std::size_t picture = std::max(reply.surface.size(), reply.vortices.size());
  if (picture > kLargestPicture) return "a picture of " + std::to_string(picture) + " parts";
  return problem(reply.protocol, reply.key);
}

bool finite(const Interface& interface) {
  const BodyState& body = interface.body;
  return body.x.allFinite() && body.v.allFinite() && body.a.allFinite() && body.R_IB.allFinite() &&
         body.Omega_B.allFinite() && body.Omega_dot_B.allFinite() && finite(body.pitch) &&
         finite(interface.theta.right) && finite(interface.theta.left);
}

std::string describe(const ExchangeKey& key) {
  return "step " + std::to_string(key.step) + ", sub-iteration " + std::to_string(key.iteration) +
         ", " + phaseName(key.phase);
}

}  // namespace monarch_flight
