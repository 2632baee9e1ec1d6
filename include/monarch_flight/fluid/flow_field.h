#pragma once
#include <cstddef>
#include <vector>

namespace monarch_flight {

/// The whole flow at the committed level, for pictures and files: values at the centres of the
/// cells, cell (i, j, k) at (k ny + j) nx + i. Vectors are resolved in wing axes, three numbers a
/// cell; the velocity is relative to the undisturbed air.
struct FlowField {
  std::vector<double> x, y, z;   ///< faces of the cells, wing axes [m]
  std::vector<float> velocity;   ///< [m/s]
  std::vector<float> vorticity;  ///< [1/s]
  std::vector<float> pressure;   ///< gauge [Pa]
  std::vector<float> q;          ///< second invariant of the velocity gradient [1/s^2]

  /// One face of the wing. Friction is what the air of a side drags the wing by, along x and y.
  struct WingFace {
    float x, y, dx, dy;                          ///< centre and size [m]
    float p_upper, p_lower;                      ///< dorsal (-z) and ventral (+z) side [Pa]
    float friction_upper[2], friction_lower[2];  ///< [Pa]
  };
  std::vector<WingFace> wing;

  std::size_t cells() const { return pressure.size(); }
};

}  // namespace monarch_flight
