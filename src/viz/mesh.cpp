#include "monarch_flight/viz/mesh.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace monarch_flight {
namespace {

using Point = Eigen::Vector3f;

// A quadrilateral a, b, c, d as two triangles; those of which two corners meet are left out.
void addQuad(Mesh& mesh, const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto add = [&mesh](const Point& p, const Point& q, const Point& r) {
    if (p != q && q != r && r != p) mesh.triangles.push_back({p, q, r});
  };
  add(a, b, c);
  add(a, c, d);
}

template <class T>
void append(std::string& bytes, const T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace

Mesh wingMesh(const Planform& planform, bool left, int stations) {
  const float side = left ? -1.0f : 1.0f;
  const auto edge = [&](int i, bool leading) {
    // Cosine spacing: the outline turns fastest at root and tip.
    const double s = 0.5 * (1.0 - std::cos(M_PI * i / stations));
    const double y = planform.yRoot() + s * planform.span();
    const double x = leading ? planform.leading(y) : planform.trailing(y);
    return Point(static_cast<float>(x), side * static_cast<float>(y), 0.0f);
  };
  Mesh mesh;
  for (int i = 0; i < stations; ++i) {
    const Point a = edge(i, false), b = edge(i, true), c = edge(i + 1, true),
                d = edge(i + 1, false);
    addQuad(mesh, a, b, c, d);
    addQuad(mesh, d, c, b, a);
  }
  return mesh;
}

Mesh ellipsoidMesh(const Eigen::Vector3d& centre, double length, double width) {
  constexpr int kAlong = 16, kAround = 20;
  const auto point = [&](int i, int j) {
    const double u = M_PI * i / kAlong, v = 2.0 * M_PI * (j % kAround) / kAround;
    const double r = (i == 0 || i == kAlong) ? 0.0 : 0.5 * width * std::sin(u);
    const Eigen::Vector3d p(0.5 * length * std::cos(u), r * std::cos(v), r * std::sin(v));
    return Point((centre + p).cast<float>());
  };
  Mesh mesh;
  for (int i = 0; i < kAlong; ++i) {
    for (int j = 0; j < kAround; ++j) {
      addQuad(mesh, point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
    }
  }
  return mesh;
}

std::string stlBytes(const Mesh& mesh) {
  std::string bytes = "monarch_flight";
  bytes.resize(80, '\0');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Point normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    for (const Point& p : {normal, t[0], t[1], t[2]}) {
      for (int i = 0; i < 3; ++i) append(bytes, p[i]);
    }
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace monarch_flight
