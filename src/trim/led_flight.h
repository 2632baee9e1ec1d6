#pragma once
#include <memory>
#include <vector>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/run/federation.h"

namespace monarch_flight {

/// Flies a case in this process, led by this guidance instead of the case's own.
RunResult flyLed(const Case& c, std::unique_ptr<Guidance> guidance,
                 const std::vector<StepSink*>& sinks);

}  // namespace monarch_flight
