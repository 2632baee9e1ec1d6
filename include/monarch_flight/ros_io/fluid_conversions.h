#pragma once
#include <geometry_msgs/Wrench.h>
#include <monarch_flight/FlowBlock.h>
#include <monarch_flight/FluidKernelTimes.h>
#include <monarch_flight/LoadDerivatives.h>
#include <monarch_flight/PressureFacet.h>
#include <monarch_flight/WholeFlow.h>

#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/fluid/fluid_model.h"

namespace monarch_flight {

/// What a fluid answers beside the loads, to messages and back, bit for bit.
LoadDerivatives toMessage(const LoadOperator& jacobian);
FluidKernelTimes toMessage(const KernelTimes& times);
WholeFlow toMessage(const FlowField& flow);
PressureFacet toMessage(const SurfacePressure::Facet& facet);
FlowBlock toMessage(const FlowPicture& block);
/// The columns of a matrix of loads by motion.
std::vector<geometry_msgs::Wrench> columnsOf(const Matrix6d& matrix);

LoadOperator fromMessage(const LoadDerivatives& jacobian);
KernelTimes fromMessage(const FluidKernelTimes& times);
std::shared_ptr<const FlowField> fromMessage(const WholeFlow& flow);
SurfacePressure::Facet fromMessage(const PressureFacet& facet);
FlowPicture fromMessage(const FlowBlock& block);
/// Precondition: six columns.
Matrix6d matrixOf(const std::vector<geometry_msgs::Wrench>& columns);

/// Why the arrays do not belong to one grid; empty when they do.
std::string problem(const WholeFlow& flow);
/// Why its fields do not belong to a block of points, or are too large; empty when they do.
std::string problem(const FlowBlock& block);

}  // namespace monarch_flight
