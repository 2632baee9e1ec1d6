#pragma once

namespace monarch_flight {

/// The instruction set for which this library was compiled: "x86-64", "x86-64-v3" or "x86-64-v4",
/// at least; elsewhere "generic". A package holds one library of the flow for each, and the dynamic
/// linker takes the best that the processor knows.
const char* fluidInstructionSet();

}  // namespace monarch_flight
