#pragma once
#include <memory>
#include <string>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Writes the flow of every step that carries one (CommittedStep::flow) for ParaView into `folder`,
/// which is made with the first of them: flow_<step>.vts, the grid with its fields;
/// wing_<step>.vtp, the wings' surface; fields.pvd, which names them with their times. World axes
/// (x east, y north, z up), SI; what they hold: docs/fields.md. A file is renewed as a whole and is
/// never half-written. Throws InputError when this build has no VTK; the sink's onStep throws
/// OutputError.
/// `resumed`: what onCheckpoint has shown, for a run that goes on.
std::unique_ptr<StepSink> makeFieldOutput(const Case& c, const std::string& folder,
                                          StateVisitor* resumed = nullptr);

}  // namespace monarch_flight
