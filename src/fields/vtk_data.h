#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/run/case.h"
#include "monarch_flight/run/pressure_reference.h"

namespace monarch_flight {

/// Constants of a run that its files carry.
struct FieldScales {
  PressureReference pressure;
  double q_threshold = 0.0;  ///< an iso-value that shows the vortices of the edges [1/s^2]
};

/// The grid of a wing's flow with its fields, world axes. Precondition: it is not null.
vtkSmartPointer<vtkStructuredGrid> flowGrid(const Case& c, const FieldScales& scales,
                                            const CommittedStep& step, Side side);

/// Right wing and, unless a bare wing, the left one: a quadrangle a face, world axes; its front
/// side (anticlockwise) is the ventral one.
vtkSmartPointer<vtkPolyData> wingSurface(const Case& c, const FieldScales& scales,
                                         const CommittedStep& step);

}  // namespace monarch_flight
