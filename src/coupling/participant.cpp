#include "monarch_flight/coupling/participant.h"

namespace monarch_flight {

const char* roleName(Role role) {
  switch (role) {
    case Role::kFluid:
      return "fluid";
    case Role::kFlight:
      return "flight";
    case Role::kWing:
      return "wing";
    case Role::kGuidance:
      return "guidance";
    case Role::kFluidLeft:
      return "fluid_left";
  }
  return "unknown role";
}

const char* phaseName(Phase phase) {
  switch (phase) {
    case Phase::kStart:
      return "START";
    case Phase::kIterate:
      return "ITERATE";
    case Phase::kCommit:
      return "COMMIT";
    case Phase::kAbort:
      return "ABORT";
    case Phase::kCheckpoint:
      return "CHECKPOINT";
    case Phase::kRestore:
      return "RESTORE";
  }
  return "unknown phase";
}

std::string IgnoredMessages::describe() const {
  return std::to_string(late) + " late, " + std::to_string(repeated) + " repeated, " +
         std::to_string(foreign) + " foreign, " + std::to_string(malformed) + " malformed, " +
         std::to_string(forged) + " forged";
}

IgnoredMessages& IgnoredMessages::operator+=(const IgnoredMessages& o) {
  late += o.late;
  repeated += o.repeated;
  foreign += o.foreign;
  malformed += o.malformed;
  forged += o.forged;
  return *this;
}

}  // namespace monarch_flight
