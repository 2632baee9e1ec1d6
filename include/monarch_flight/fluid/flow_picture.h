#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace monarch_flight {

/// The vortices around a wing, for pictures: two fields on a uniform block of points, wing axes.
/// Point (i, j, k) is at origin + spacing (i, j, k) and has the place (k ny + j) nx + i. Both
/// fields are whole numbers of `step`.
struct FlowPicture {
  std::array<float, 3> origin{};        ///< the first point [m]
  float spacing = 0.0f;                 ///< between neighbours, the same in all directions [m]
  std::array<std::uint32_t, 3> size{};  ///< nx, ny, nz
  float step = 0.0f;                    ///< what a 1 of both fields stands for [1/s]
  std::vector<std::int16_t> q_root;     ///< sign(Q) sqrt(|Q|), Q: second invariant of the gradient
  std::vector<std::int16_t> omega_y;    ///< vorticity along the span

  std::size_t points() const { return q_root.size(); }
  bool empty() const { return q_root.empty(); }
};

/// The same block seen in the mirror y = 0: of a left wing told as its mirror image, in its true
/// axes, and back. The vorticity along y stays.
FlowPicture mirrored(const FlowPicture& block);

}  // namespace monarch_flight
