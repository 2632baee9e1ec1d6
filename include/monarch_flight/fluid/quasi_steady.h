#pragma once
#include <memory>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/planform.h"

namespace monarch_flight {

/// Coefficients of the blade-element model.
enum class BladeElementVariant { kSaneDickinson, kWhitneyWood };

/// Blade-element model with added mass, rotational circulation and damping (docs/quasi_steady.md).
/// Its start, evaluate and linearise throw NumericalError when the loads are not finite, evaluate
/// before start std::logic_error.
std::unique_ptr<FluidModel> makeQuasiSteady(const Planform& planform, const Air& air,
                                            BladeElementVariant variant);

}  // namespace monarch_flight
