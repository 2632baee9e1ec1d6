#include "monarch_flight/ros_io/fluid_conversions.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ros_io/geometry.h"

namespace monarch_flight {
namespace {

using Points = std::vector<geometry_msgs::Point32>;
constexpr std::uint64_t kLargestBlock = 1000000;  // points of one message
static_assert(sizeof(geometry_msgs::Point32) == 3 * sizeof(float));

// In the order of Kernel.
constexpr std::array<double FluidKernelTimes::*, kKernels> kKernelFields = {
    &FluidKernelTimes::turning,     &FluidKernelTimes::momentum_x_y, &FluidKernelTimes::momentum_z,
    &FluidKernelTimes::net_outflow, &FluidKernelTimes::transforms,   &FluidKernelTimes::columns,
    &FluidKernelTimes::capacitance, &FluidKernelTimes::loads,        &FluidKernelTimes::projection};

geometry_msgs::Wrench columnOf(const Matrix6d& matrix, int i) {
  return wrench(matrix.block<3, 1>(0, i), matrix.block<3, 1>(3, i));
}

template <class Wrenches>
Matrix6d matrixFrom(const Wrenches& columns) {
  Matrix6d matrix;
  for (int i = 0; i < 6; ++i) {
    const geometry_msgs::Wrench& column = columns[static_cast<std::size_t>(i)];
    matrix.col(i) << vector(column.force), vector(column.torque);
  }
  return matrix;
}

Points points(const std::vector<float>& numbers) {
  Points out(numbers.size() / 3);
  if (!out.empty())
    std::memcpy(static_cast<void*>(out.data()), numbers.data(), out.size() * sizeof out[0]);
  return out;
}

std::vector<float> numbers(const Points& points) {
  std::vector<float> out(3 * points.size());
  if (!out.empty()) std::memcpy(out.data(), points.data(), out.size() * sizeof out[0]);
  return out;
}

WingFace toMessage(const FlowField::WingFace& face) {
  WingFace out;
  out.x = face.x;
  out.y = face.y;
  out.dx = face.dx;
  out.dy = face.dy;
  out.p_upper = face.p_upper;
  out.p_lower = face.p_lower;
  out.friction_upper_x = face.friction_upper[0];
  out.friction_upper_y = face.friction_upper[1];
  out.friction_lower_x = face.friction_lower[0];
  out.friction_lower_y = face.friction_lower[1];
  return out;
}

FlowField::WingFace fromMessage(const WingFace& f) {
  return {f.x,
          f.y,
          f.dx,
          f.dy,
          f.p_upper,
          f.p_lower,
          {f.friction_upper_x, f.friction_upper_y},
          {f.friction_lower_x, f.friction_lower_y}};
}

template <class Numbers>
bool allFinite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](auto x) { return std::isfinite(x); });
}

bool finite(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const geometry_msgs::Point32& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
}

bool finite(const WingFace& f) {
  return allFinite(std::array<float, 10>{f.x, f.y, f.dx, f.dy, f.p_upper, f.p_lower,
                                         f.friction_upper_x, f.friction_upper_y, f.friction_lower_x,
                                         f.friction_lower_y});
}

bool finite(const WholeFlow& flow) {
  return allFinite(flow.x) && allFinite(flow.y) && allFinite(flow.z) && finite(flow.velocity) &&
         finite(flow.vorticity) && allFinite(flow.pressure) && allFinite(flow.q) &&
         std::all_of(flow.wing.begin(), flow.wing.end(),
                     [](const WingFace& face) { return finite(face); });
}

}  // namespace

LoadDerivatives toMessage(const LoadOperator& jacobian) {
  LoadDerivatives out;
  for (int i = 0; i < 6; ++i) {
    out.velocity[static_cast<std::size_t>(i)] = columnOf(jacobian.velocity, i);
    out.acceleration[static_cast<std::size_t>(i)] = columnOf(jacobian.acceleration, i);
  }
  return out;
}

LoadOperator fromMessage(const LoadDerivatives& jacobian) {
  return {matrixFrom(jacobian.velocity), matrixFrom(jacobian.acceleration)};
}

FluidKernelTimes toMessage(const KernelTimes& times) {
  FluidKernelTimes out;
  for (std::size_t i = 0; i < kKernels; ++i) out.*kKernelFields[i] = times[i];
  return out;
}

KernelTimes fromMessage(const FluidKernelTimes& times) {
  KernelTimes out;
  for (std::size_t i = 0; i < kKernels; ++i) out[i] = times.*kKernelFields[i];
  return out;
}

std::vector<geometry_msgs::Wrench> columnsOf(const Matrix6d& matrix) {
  std::vector<geometry_msgs::Wrench> out;
  out.reserve(6);
  for (int i = 0; i < 6; ++i) out.push_back(columnOf(matrix, i));
  return out;
}

Matrix6d matrixOf(const std::vector<geometry_msgs::Wrench>& columns) { return matrixFrom(columns); }

PressureFacet toMessage(const SurfacePressure::Facet& facet) {
  PressureFacet out;
  out.x = facet.x;
  out.y = facet.y;
  out.dx = facet.dx;
  out.dy = facet.dy;
  out.p_upper = facet.p_upper;
  out.p_lower = facet.p_lower;
  return out;
}

SurfacePressure::Facet fromMessage(const PressureFacet& facet) {
  return {facet.x, facet.y, facet.dx, facet.dy, facet.p_upper, facet.p_lower};
}

FlowBlock toMessage(const FlowPicture& block) {
  FlowBlock out;
  out.origin.x = block.origin[0];
  out.origin.y = block.origin[1];
  out.origin.z = block.origin[2];
  out.spacing = block.spacing;
  std::copy(block.size.begin(), block.size.end(), out.size.begin());
  out.step = block.step;
  out.q_root = block.q_root;
  out.vorticity = block.omega_y;
  return out;
}

FlowPicture fromMessage(const FlowBlock& block) {
  return {{block.origin.x, block.origin.y, block.origin.z},
          block.spacing,
          {block.size[0], block.size[1], block.size[2]},
          block.step,
          block.q_root,
          block.vorticity};
}

WholeFlow toMessage(const FlowField& flow) {
  WholeFlow out;
  out.x = flow.x;
  out.y = flow.y;
  out.z = flow.z;
  out.velocity = points(flow.velocity);
  out.vorticity = points(flow.vorticity);
  out.pressure = flow.pressure;
  out.q = flow.q;
  out.wing.reserve(flow.wing.size());
  for (const FlowField::WingFace& face : flow.wing) out.wing.push_back(toMessage(face));
  return out;
}

std::shared_ptr<const FlowField> fromMessage(const WholeFlow& flow) {
  auto out = std::make_shared<FlowField>();
  out->x = flow.x;
  out->y = flow.y;
  out->z = flow.z;
  out->velocity = numbers(flow.velocity);
  out->vorticity = numbers(flow.vorticity);
  out->pressure = flow.pressure;
  out->q = flow.q;
  out->wing.reserve(flow.wing.size());
  for (const WingFace& face : flow.wing) out->wing.push_back(fromMessage(face));
  return out;
}

std::string problem(const WholeFlow& flow) {
  const auto cellsAlong = [](const std::vector<double>& faces) {
    return faces.empty() ? 0 : faces.size() - 1;
  };
  const std::size_t n = cellsAlong(flow.x) * cellsAlong(flow.y) * cellsAlong(flow.z);
  const bool fits = n > 0 && flow.velocity.size() == n && flow.vorticity.size() == n &&
                    flow.pressure.size() == n && flow.q.size() == n;
  if (fits && !finite(flow)) return "a flow that is not finite";
  return fits ? "" : "a flow whose arrays do not fit its " + std::to_string(n) + " cells";
}

std::string problem(const FlowBlock& block) {
  std::uint64_t n = 1;
  for (std::uint32_t along : block.size) n = std::min<std::uint64_t>(n, kLargestBlock) * along;
  const bool fits =
      n > 0 && n <= kLargestBlock && block.q_root.size() == n && block.vorticity.size() == n;
  if (!fits) return "a block of the flow whose fields do not fit its size";
  if (*std::min_element(block.size.begin(), block.size.end()) < 2)
    return "a block of the flow with fewer than 2 points along an axis";
  const std::array<float, 4> numbers{block.origin.x, block.origin.y, block.origin.z, block.step};
  const bool good = allFinite(numbers) && std::isfinite(block.spacing) && block.spacing > 0.0f &&
                    block.step >= 0.0f;
  return good ? "" : "a block of the flow that is not finite";
}

}  // namespace monarch_flight
