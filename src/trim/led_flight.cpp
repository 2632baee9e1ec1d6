#include "trim/led_flight.h"

#include "monarch_flight/coupling/participants.h"

namespace monarch_flight {

RunResult flyLed(const Case& c, std::unique_ptr<Guidance> guidance,
                 const std::vector<StepSink*>& sinks) {
  const CoupledModel model = makeModel(c);
  FluidParticipant fluid(Side::kRight, model, makeFluid(c));
  FlightParticipant flight(model);
  WingParticipant wing(model);
  GuidanceParticipant led(model, std::move(guidance));
  const StopFlag stop{false};
  FlyUntil control(stop);
  std::unique_ptr<FluidParticipant> left;
  if (!c.mirrored)
    left = std::make_unique<FluidParticipant>(Side::kLeft, model, makeFluid(c, Side::kLeft));
  return runCase(c, 1, {&fluid, &flight, &wing, &led, left.get()}, sinks, control);
}

}  // namespace monarch_flight
