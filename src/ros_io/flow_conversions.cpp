#include <algorithm>
#include <cmath>

#include "monarch_flight/ros_io/conversions.h"

namespace monarch_flight {
namespace {

/// Numbers of a face of the wing in a WholeFlow.
constexpr std::size_t kFaceNumbers = sizeof(FlowField::WingFace) / sizeof(float);

}  // namespace

WholeFlow toMessage(const FlowField& flow) {
  WholeFlow out;
  out.x = flow.x;
  out.y = flow.y;
  out.z = flow.z;
  out.velocity = flow.velocity;
  out.vorticity = flow.vorticity;
  out.pressure = flow.pressure;
  out.q = flow.q;
  for (const FlowField::WingFace& f : flow.wing) {
    out.wing.insert(out.wing.end(),
                    {f.x, f.y, f.dx, f.dy, f.p_upper, f.p_lower, f.friction_upper[0],
                     f.friction_upper[1], f.friction_lower[0], f.friction_lower[1]});
  }
  return out;
}

std::shared_ptr<const FlowField> fromMessage(const WholeFlow& flow) {
  auto out = std::make_shared<FlowField>();
  out->x = flow.x;
  out->y = flow.y;
  out->z = flow.z;
  out->velocity = flow.velocity;
  out->vorticity = flow.vorticity;
  out->pressure = flow.pressure;
  out->q = flow.q;
  for (std::size_t i = 0; i + kFaceNumbers <= flow.wing.size(); i += kFaceNumbers) {
    const float* f = flow.wing.data() + i;
    out->wing.push_back({f[0], f[1], f[2], f[3], f[4], f[5], {f[6], f[7]}, {f[8], f[9]}});
  }
  return out;
}

namespace {

template <class Numbers>
bool allFinite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](auto x) { return std::isfinite(x); });
}

bool finite(const WholeFlow& flow) {
  return allFinite(flow.x) && allFinite(flow.y) && allFinite(flow.z) && allFinite(flow.velocity) &&
         allFinite(flow.vorticity) && allFinite(flow.pressure) && allFinite(flow.q) &&
         allFinite(flow.wing);
}

}  // namespace

std::string problem(const WholeFlow& flow) {
  const auto cellsAlong = [](const std::vector<double>& faces) {
    return faces.empty() ? 0 : faces.size() - 1;
  };
  const std::size_t n = cellsAlong(flow.x) * cellsAlong(flow.y) * cellsAlong(flow.z);
  const bool fits = n > 0 && flow.velocity.size() == 3 * n && flow.vorticity.size() == 3 * n &&
                    flow.pressure.size() == n && flow.q.size() == n &&
                    flow.wing.size() % kFaceNumbers == 0;
  if (fits && !finite(flow)) return "a flow that is not finite";
  return fits ? "" : "a flow whose arrays do not fit its " + std::to_string(n) + " cells";
}

}  // namespace monarch_flight
