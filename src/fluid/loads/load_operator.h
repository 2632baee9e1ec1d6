#pragma once
#include "monarch_flight/fluid/fluid_model.h"

namespace monarch_flight::fluid::loads {

constexpr int kAffineEvaluations = 6;

/// Loads and Jacobian of a model whose loads are, within a step, affine in the wing's velocity and
/// do not depend on its acceleration: one evaluation for each of the six velocities.
Loads affineLinearise(FluidModel& model, const WingMotion& next, LoadOperator& jacobian);

}  // namespace monarch_flight::fluid::loads
