#pragma once
#include <optional>

#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/run/case.h"
#include "run/case/reader.h"

namespace monarch_flight::case_file {

/// The section `guidance/controller` (docs/guidance.md) of a case whose motion, what is free, time
/// and coupling have been read. Nothing, with every fault, where it cannot be flown.
std::optional<ControllerSettings> readController(Section section, const Case& c, Faults& faults);

}  // namespace monarch_flight::case_file
