#include "monarch_flight/coupling/participants.h"

#include <utility>

#include "monarch_flight/coupling/interface_values.h"

namespace monarch_flight {

FluidParticipant::FluidParticipant(Side side, const CoupledModel& model,
                                   std::unique_ptr<FluidModel> fluid)
    : SolverParticipant(kFluids[side], model), side_(side), fluid_(std::move(fluid)) {}

/// As the air sees it.
WingMotion FluidParticipant::motion(const Request& request) const {
  const PrescribedState& prescribed = request.prescribed;
  return wingMotionInAir(side_, model().insect, prescribed.wind, request.interface.body,
                         prescribed.anglesWith(request.interface.theta));
}

void FluidParticipant::onStart(const Request& request, Reply& reply) {
  fluid_->start(motion(request), model().newmark.dt);
  reply.report = fluid_->report();
  reply.report.cells = fluid_->cells();
  reply.report.added_mass = fluid_->addedMass();
  reply.report.operator_cost = fluid_->operatorCost();
}

void FluidParticipant::onIterate(const Request& request, Reply& reply) {
  if (request.want_operator) {
    reply.jacobian.emplace();
    reply.loads = fluid_->linearise(motion(request), *reply.jacobian);
  } else {
    reply.loads = fluid_->evaluate(motion(request));
  }
  reply.report = fluid_->report();
}

void FluidParticipant::onCommit(const Request& request, Reply& reply) {
  fluid_->commit();
  reply.report = fluid_->report();
  if (request.want_surface) reply.surface = fluid_->surfacePressure();
  if (request.block_points > 0) reply.picture = fluid_->flowPicture(request.block_points);
  if (request.want_flow) reply.flow = fluid_->flowField();
}

void FluidParticipant::memory(StateVisitor& state) {
  std::vector<char> air;
  if (!state.loading()) air = fluid_->save();
  state.bytes("air", air);
  if (state.loading()) fluid_->restore(air);
}

bool FluidParticipant::sameGuess(const Interface& answered, const Interface& committed) const {
  return same(answered, committed);
}

FlightParticipant::FlightParticipant(const CoupledModel& model)
    : SolverParticipant(Role::kFlight, model),
      solver_(model.insect, model.gravity, model.free, model.newmark) {}

void FlightParticipant::onStart(const Request&, Reply&) {}

void FlightParticipant::onIterate(const Request& request, Reply& reply) {
  const JointAngles angles = request.prescribed.anglesWith(request.interface.theta);
  const Interface from = model().departure(request.key.step, committed(), request.interface);
  reply.interface.body = solver_.step(from.body, request.prescribed.body, request.interface.body,
                                      angles, request.loads);
}

void FlightParticipant::onCommit(const Request&, Reply&) {}

bool FlightParticipant::sameGuess(const Interface& answered, const Interface& committed) const {
  return same(answered, committed);
}

WingParticipant::WingParticipant(const CoupledModel& model)
    : SolverParticipant(Role::kWing, model) {
  if (!model.free.wingPitch()) return;
  for (Side side : model.sides())
    solvers_[side].emplace(side, model.insect, model.gravity, model.newmark);
}

void WingParticipant::onStart(const Request&, Reply&) {}

void WingParticipant::onIterate(const Request& request, Reply& reply) {
  const PrescribedState& prescribed = request.prescribed;
  const JointAngles angles = prescribed.anglesWith(request.interface.theta);
  const Interface from = model().departure(request.key.step, committed(), request.interface);
  for (Side side : model().sides()) {
    reply.interface.theta[side] =
        solvers_[side] ? solvers_[side]->step(from.theta[side], request.interface.body, angles,
                                              request.loads[side], prescribed.rest_angle[side])
                       : prescribed.angles.wings[side].theta;
  }
  if (model().mirrored) reply.interface.theta.left = reply.interface.theta.right;
}

void WingParticipant::onCommit(const Request&, Reply&) {}

bool WingParticipant::sameGuess(const Interface& answered, const Interface& committed) const {
  // The body in ITERATE is the flight's answer.
  return same(answered.theta.right, committed.theta.right) &&
         same(answered.theta.left, committed.theta.left);
}

GuidanceParticipant::GuidanceParticipant(const CoupledModel& model,
                                         std::unique_ptr<Guidance> guidance)
    : SolverParticipant(Role::kGuidance, model), guidance_(std::move(guidance)) {}

void GuidanceParticipant::onStart(const Request& request, Reply& reply) {
  ahead_ = false;
  reply.prescribed = guidance_->start(request.t);
  reply.guidance = guidance_->report();
}

void GuidanceParticipant::onIterate(const Request& request, Reply& reply) {
  const auto show = [this](StateVisitor& state) { guidance_->memory(state); };
  if (ahead_) {
    before_.putBack(show);
  } else {
    before_.take(show);
  }
  ahead_ = true;
  reply.prescribed = guidance_->next({request.key.step, request.t, model().newmark.dt,
                                      request.interface, request.loads, request.prescribed});
  reply.guidance = guidance_->report();
}

void GuidanceParticipant::onCommit(const Request&, Reply&) { ahead_ = false; }

/// Of the committed level, also while the next one has been prescribed.
void GuidanceParticipant::memory(StateVisitor& state) {
  const auto show = [this](StateVisitor& s) { guidance_->memory(s); };
  if (state.loading() || !ahead_) {
    ahead_ = false;
    show(state);
    return;
  }
  StateSnapshot now;
  now.take(show);
  before_.putBack(show);
  show(state);
  now.putBack(show);
}

/// The interface of its ITERATE is the level before.
bool GuidanceParticipant::sameGuess(const Interface&, const Interface&) const { return true; }

}  // namespace monarch_flight
