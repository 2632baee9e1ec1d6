#pragma once
#include <array>
#include <memory>
#include <vector>

#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/coupling/keeper.h"
#include "monarch_flight/coupling/model.h"
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/run_control.h"
#include "monarch_flight/guidance/command_inbox.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// The flow model that the case names, of one wing, started by the participant's START request.
std::unique_ptr<FluidModel> makeFluid(const Case& c, Side side = Side::kRight);
/// Who takes part in a flight of the case.
std::vector<Role> rolesOf(const Case& c);
/// Part of a checkpoint that the coordinator's own guidance writes beside that of a guidance node.
constexpr char kWingbeatPart[] = "wingbeat";
/// What owns the motion of the case. `inbox`: where the commands of a person or a node arrive.
std::unique_ptr<Guidance> makeGuidance(const Case& c,
                                       std::shared_ptr<CommandInbox> inbox = nullptr);
/// The pictures that the case asks for.
PictureSettings picturesOf(const Case& c);
/// What coordinator and participants need to know of the case.
CoupledModel makeModel(const Case& c);
/// The in-process participant for a role; the ROS nodes wrap exactly these. `checkpoints`: folder
/// in which it keeps its part of them; `inbox`: as above, for guidance.
std::unique_ptr<Participant> makeParticipant(Role role, const Case& c,
                                             const std::string& checkpoints,
                                             std::shared_ptr<CommandInbox> inbox = nullptr);

/// Result of a run as written to summary.json.
struct RunResult {
  bool complete = false;
  std::string failure;  ///< empty when complete
};

/// Runs the coupled loop of the whole case over its participants and feeds the sinks.
/// `control` is asked before every sub-iteration. Never throws for a failed run: see RunResult.
/// A sink that throws in onStep ends the run with its message; one that throws in onEnd makes it
/// failed, and the sinks behind it are ended with that failure.
RunResult runCase(const Case& c, std::uint64_t run_id, const Participants& participants,
                  const std::vector<StepSink*>& sinks, RunControl& control,
                  Keeper* keeper = nullptr);

/// Fluid, flight, wing and guidance of a case in one process, without ROS.
class InProcessFederation {
 public:
  /// `checkpoints`: their folder; needed for a run with a keeper.
  explicit InProcessFederation(const Case& c, const std::string& checkpoints = "");
  /// Flies until the end or until `stop` is set.
  RunResult run(std::uint64_t run_id, const std::vector<StepSink*>& sinks, const StopFlag& stop,
                Keeper* keeper = nullptr);
  Participants participants();

 private:
  Case case_;
  std::array<std::unique_ptr<Participant>, kRoles> participants_;
};

}  // namespace monarch_flight
