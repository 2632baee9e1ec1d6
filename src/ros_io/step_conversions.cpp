#include "monarch_flight/ros_io/step_conversions.h"

#include "monarch_flight/ros_io/guidance_conversions.h"
#include "monarch_flight/ros_io/state_conversions.h"
#include "ros_io/geometry.h"

namespace monarch_flight {
namespace {

// In the order of kCoordinateTable.
constexpr std::array<double CoordinateResiduals::*, kCoordinates> kResiduals = {
    &CoordinateResiduals::x,           &CoordinateResiduals::y,         &CoordinateResiduals::z,
    &CoordinateResiduals::roll,        &CoordinateResiduals::pitch,     &CoordinateResiduals::yaw,
    &CoordinateResiduals::theta_right, &CoordinateResiduals::theta_left};

constexpr std::array<double RoleTimes::*, kRoles> kRoleTimes = {
    &RoleTimes::fluid, &RoleTimes::flight, &RoleTimes::wing, &RoleTimes::guidance,
    &RoleTimes::fluid_left};

}  // namespace

SubIteration toMessage(const IterationRecord& record) {
  SubIteration out;
  out.step = record.step;
  out.iteration = record.iteration;
  out.attempt = record.attempt;
  for (std::size_t i = 0; i < kCoordinates; ++i) out.residual.*kResiduals[i] = record.residual[i];
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
  for (std::size_t i = 0; i < kCoordinates; ++i) out.residual[i] = record.residual.*kResiduals[i];
  out.load_residual = record.load_residual;
  out.relaxation = record.relaxation;
  out.fluid_wall_s = record.fluid_wall_s;
  return out;
}

RoleTimes toMessage(const std::array<double, kRoles>& wall_s) {
  RoleTimes out;
  for (std::size_t i = 0; i < kRoles; ++i) out.*kRoleTimes[i] = wall_s[i];
  return out;
}

FlightState flightState(const CommittedStep& step, const ros::Time& stamp) {
  const auto& [wings, theta_A] = step.angles;
  FlightState out;
  out.header.stamp = stamp;
  out.header.frame_id = frames::kWorldNed;
  out.step = step.step;
  out.t = step.t;
  out.body = toMessage(step.interface.body);
  out.right_wing = toMessage(wings.right, step.guided.rest_angle.right);
  out.left_wing = toMessage(wings.left, step.guided.rest_angle.left);
  out.theta_a = toMessage(theta_A);
  out.wind = toVector3(step.guided.wind.v);
  out.guidance = toMessage(step.guidance);
  out.right_loads = toMessage(step.loads.right);
  out.left_loads = toMessage(step.loads.left);
  out.force = toVector3(step.force_I);
  out.sub_iterations = static_cast<std::uint32_t>(step.iterations.size());
  out.retried = step.retried();
  out.courant = step.fluid.courant;
  out.divergence = step.fluid.divergence;
  out.computing = toMessage(step.wall_s);
  out.exchange_s = step.exchange_s;
  out.coupling_s = step.coupling_s;
  return out;
}

StepIterations stepIterations(const CommittedStep& step, const ros::Time& stamp) {
  StepIterations out;
  out.header.stamp = stamp;
  out.step = step.step;
  out.retried = step.retried();
  out.prescribed = step.prescribed;
  out.fluid_evaluations = static_cast<std::uint32_t>(step.fluid_evaluations);
  out.added_mass_ratio = step.added_mass_ratio;
  out.work_fluid = step.work_fluid;
  out.work_structure = step.work_structure;
  out.rows.reserve(step.iterations.size());
  for (const IterationRecord& record : step.iterations) out.rows.push_back(toMessage(record));
  return out;
}

}  // namespace monarch_flight
