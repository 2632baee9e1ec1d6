#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "monarch_flight/coupling/stop_flag.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/insect/wingbeat.h"

namespace monarch_flight {

/// The solvers, and guidance, which is asked once a step before the first sub-iteration. `kFluid`
/// has the air of the right wing, `kFluidLeft` that of the left one where it is solved, too: both
/// are asked at the same time.
enum class Role : std::uint8_t {
  kFluid = 0,
  kFlight = 1,
  kWing = 2,
  kGuidance = 3,
  kFluidLeft = 4
};
inline constexpr std::size_t kRoles = 5;
inline constexpr std::array<Role, kRoles> kAllRoles = {Role::kFluid, Role::kFlight, Role::kWing,
                                                       Role::kGuidance, Role::kFluidLeft};
inline constexpr PerWing<Role> kFluids = {Role::kFluid, Role::kFluidLeft};
const char* roleName(Role role);

/// START: take the initial interface. ITERATE: compute from (committed state, request), keep
/// nothing that a later ITERATE could see. COMMIT: keep the last answered ITERATE of this step.
/// ABORT: end. CHECKPOINT: write the committed state of `step` down. RESTORE: after START, take it
/// up again.
enum class Phase : std::uint8_t {
  kStart = 0,
  kIterate = 1,
  kCommit = 2,
  kAbort = 3,
  kCheckpoint = 4,
  kRestore = 5
};
const char* phaseName(Phase phase);

/// Identifies a request and its reply. Never a time, never a sequence number of the transport.
struct ExchangeKey {
  std::uint64_t run = 0;
  std::uint32_t step = 0;       ///< the time level n+1 being computed; 0 for START
  std::uint32_t iteration = 0;  ///< sub-iteration k, from 0
  Phase phase = Phase::kStart;
  std::uint32_t reset = 0;  ///< how often the run has been set back to its start
  bool operator==(const ExchangeKey& o) const {
    return run == o.run && step == o.step && iteration == o.iteration && phase == o.phase &&
           reset == o.reset;
  }
  bool operator!=(const ExchangeKey& o) const { return !(*this == o); }
};

struct Request {
  ExchangeKey key;
  double t = 0.0;  ///< time of level `step` [s]
  /// Everything prescribed at level `step`: solvers own no motion. To guidance: of the committed
  /// level.
  PrescribedState prescribed;
  /// Guess of level `step` (START: the initial state). To guidance: the committed level.
  Interface interface;
  /// Of this sub-iteration; zero to the fluid; of the committed level to guidance.
  PerWing<Loads> loads;
  bool want_operator = false;  ///< ITERATE to the fluid: answer with the loads' Jacobian too
  bool want_surface = false;   ///< COMMIT to the fluid: answer with the pressure on the wing
  /// COMMIT to the fluid: answer with the flow around the wing on at most so many points; 0: not.
  std::uint32_t block_points = 0;
  bool want_flow = false;  ///< COMMIT to the fluid: answer with the whole flow
  /// START between processes: folder of the run's checkpoints.
  std::string checkpoints;
};

struct Reply {
  ExchangeKey key;
  Interface interface;  ///< flight fills body, wing fills theta, the rest is as in the request
  std::optional<PrescribedState> prescribed;  ///< of guidance that owns the motion
  std::optional<WingbeatChange> command;      ///< of guidance that leads the case's own wingbeat
  GuidanceReport guidance;                    ///< filled by guidance
  Loads loads;                                ///< of its wing, filled by the fluid
  std::optional<LoadOperator>
      jacobian;             ///< of the loads, at the request's motion; only when asked for
  FluidReport report;       ///< filled by the fluid
  double wall_s = 0.0;      ///< time spent computing
  std::string error;        ///< empty: good; else why the participant cannot go on
  SurfacePressure surface;  ///< only when asked for
  FlowPicture picture;      ///< only when asked for; empty where there is no field
  std::shared_ptr<const FlowField> flow;  ///< only when asked for; null where there is no field
};

/// Messages that were not for this run or not well formed, and were therefore not used.
struct IgnoredMessages {
  std::uint64_t late = 0;       ///< of this run, but of an exchange that is over
  std::uint64_t repeated = 0;   ///< the same message again
  std::uint64_t foreign = 0;    ///< of another run
  std::uint64_t malformed = 0;  ///< wrong protocol version, unknown phase, impossible sizes
  std::uint64_t forged = 0;     ///< not sealed with the token of the run
  std::uint64_t total() const { return late + repeated + foreign + malformed + forged; }
  /// "1 late, 0 repeated, ..."
  std::string describe() const;
  IgnoredMessages& operator+=(const IgnoredMessages& o);
};

/// One solver, or guidance, as the coordinator sees it. In process: direct call; over ROS: a
/// lockstep exchange.
class Participant {
 public:
  virtual ~Participant() = default;
  /// At both ends of the connection since the run began; none in one process.
  virtual IgnoredMessages ignored() const { return {}; }
  /// Answers `request`. In-process participants report failures in Reply::error; transports throw
  /// ExchangeError naming participant, step, iteration and phase when no answer comes in time.
  virtual Reply exchange(const Request& request) = 0;
  /// The same in two parts, between which others may be asked: `ask` begins, `answer` waits for the
  /// end. Here, nothing begins before `answer`.
  virtual void ask(const Request& request) { asked_ = request; }
  virtual Reply answer() { return exchange(asked_); }

 private:
  Request asked_;
};

class ExchangeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace monarch_flight
