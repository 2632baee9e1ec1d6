// Mesh and motion of a case of OpenFOAM: a grid of ours and its wing as a polyMesh with a baffle.
#pragma once
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <string>
#include <vector>

#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

inline std::ofstream foamFile(const std::string& path, const char* type, const char* object) {
  std::ofstream out(path);
  if (!out) throw std::runtime_error("cannot write " + path);
  out << std::setprecision(15) << "FoamFile { version 2.0; format ascii; class " << type
      << "; object " << object << "; }\n";
  return out;
}

struct Patch {
  const char *name, *type;
  long first, count;
};

/// Cells x fastest; internal faces by owner, then by neighbour, as OpenFOAM wants them.
class PolyMesh {
 public:
  explicit PolyMesh(const Grid& g) : g_(g), nx_(g.x.n()), ny_(g.y.n()), nz_(g.z.n()) {
    for (int k = 0; k < nz_; ++k) {
      for (int j = 0; j < ny_; ++j) {
        for (int i = 0; i < nx_; ++i) {
          if (i + 1 < nx_) internal(xFace(i + 1, j, k), cell(i, j, k), cell(i + 1, j, k));
          if (j + 1 < ny_) internal(yFace(i, j + 1, k), cell(i, j, k), cell(i, j + 1, k));
          const bool cut = k + 1 == g.k_wing && g.isWing(i, j);
          if (k + 1 < nz_ && !cut) internal(zFace(i, j, k + 1), cell(i, j, k), cell(i, j, k + 1));
        }
      }
    }
    farFaces();
    wingFaces();
  }

  void write(const std::string& folder) const {
    auto points = foamFile(folder + "/points", "vectorField", "points");
    points << (nx_ + 1L) * (ny_ + 1) * (nz_ + 1) << "\n(\n";
    for (double z : g_.z.face) {
      for (double y : g_.y.face) {
        for (double x : g_.x.face) points << '(' << x << ' ' << y << ' ' << z << ")\n";
      }
    }
    points << ")\n";
    auto faces = foamFile(folder + "/faces", "faceList", "faces");
    faces << faces_.size() << "\n(\n";
    for (const auto& f : faces_)
      faces << "4(" << f[0] << ' ' << f[1] << ' ' << f[2] << ' ' << f[3] << ")\n";
    faces << ")\n";
    writeLabels(folder, "owner", owner_);
    writeLabels(folder, "neighbour", neighbour_);
    auto boundary = foamFile(folder + "/boundary", "polyBoundaryMesh", "boundary");
    boundary << patches_.size() << "\n(\n";
    for (const Patch& p : patches_) {
      boundary << p.name << " { type " << p.type << "; nFaces " << p.count << "; startFace "
               << p.first << "; }\n";
    }
    boundary << ")\n";
  }

 private:
  using Face = std::array<long, 4>;
  long cell(int i, int j, int k) const { return (static_cast<long>(k) * ny_ + j) * nx_ + i; }
  long point(int i, int j, int k) const {
    return (static_cast<long>(k) * (ny_ + 1) + j) * (nx_ + 1) + i;
  }
  // Faces whose normal points along the positive axis.
  Face xFace(int i, int j, int k) const {
    return {point(i, j, k), point(i, j + 1, k), point(i, j + 1, k + 1), point(i, j, k + 1)};
  }
  Face yFace(int i, int j, int k) const {
    return {point(i, j, k), point(i, j, k + 1), point(i + 1, j, k + 1), point(i + 1, j, k)};
  }
  Face zFace(int i, int j, int k) const {
    return {point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k), point(i, j + 1, k)};
  }
  static Face turned(const Face& f) { return {f[0], f[3], f[2], f[1]}; }

  void internal(const Face& f, long owner, long neighbour) {
    faces_.push_back(f);
    owner_.push_back(owner);
    neighbour_.push_back(neighbour);
  }
  void boundary(const Face& f, long owner) {
    faces_.push_back(f);
    owner_.push_back(owner);
  }
  void endPatch(const char* name, const char* type) {
    const long first = patches_.empty() ? static_cast<long>(neighbour_.size())
                                        : patches_.back().first + patches_.back().count;
    patches_.push_back({name, type, first, static_cast<long>(faces_.size()) - first});
  }
  void farFaces() {
    for (int k = 0; k < nz_; ++k) {
      for (int j = 0; j < ny_; ++j) {
        boundary(turned(xFace(0, j, k)), cell(0, j, k));
        boundary(xFace(nx_, j, k), cell(nx_ - 1, j, k));
      }
      for (int i = 0; i < nx_; ++i) {
        boundary(turned(yFace(i, 0, k)), cell(i, 0, k));
        boundary(yFace(i, ny_, k), cell(i, ny_ - 1, k));
      }
    }
    for (int j = 0; j < ny_; ++j) {
      for (int i = 0; i < nx_; ++i) {
        boundary(turned(zFace(i, j, 0)), cell(i, j, 0));
        boundary(zFace(i, j, nz_), cell(i, j, nz_ - 1));
      }
    }
    endPatch("far", "patch");
  }
  void wingFaces() {
    for (int side = 0; side < 2; ++side) {
      for (int j = 0; j < ny_; ++j) {
        for (int i = 0; i < nx_; ++i) {
          if (!g_.isWing(i, j)) continue;
          const Face f = zFace(i, j, g_.k_wing);
          side == 0 ? boundary(f, cell(i, j, g_.k_wing - 1))
                    : boundary(turned(f), cell(i, j, g_.k_wing));
        }
      }
      endPatch(side == 0 ? "wingBelow" : "wingAbove", "wall");
    }
  }
  static void writeLabels(const std::string& folder, const char* name,
                          const std::vector<long>& labels) {
    auto out = foamFile(folder + "/" + name, "labelList", name);
    out << labels.size() << "\n(\n";
    for (long l : labels) out << l << '\n';
    out << ")\n";
  }

  const Grid& g_;
  int nx_, ny_, nz_;
  std::vector<Face> faces_;
  std::vector<long> owner_, neighbour_;
  std::vector<Patch> patches_;
};

/// Motion relative to the axes at t = 0, in which the mesh is written: translation and the angles
/// of R = Rx Ry Rz in degrees.
template <class Motion>
void writeMotion(const Motion& motion, double dt, int steps, const std::string& path) {
  std::ofstream out(path);
  out << std::setprecision(15) << steps + 1 << "\n(\n";
  const WingMotion start = motion(0);
  for (int n = 0; n <= steps; ++n) {
    const WingMotion m = motion(n * dt);
    const Eigen::Vector3d x = start.R_IW.transpose() * (m.r_I - start.r_I);
    const Eigen::Matrix3d R = start.R_IW.transpose() * m.R_IW;
    const double degrees = 180 / M_PI;
    const Eigen::Vector3d angles(std::atan2(-R(1, 2), R(2, 2)), std::asin(R(0, 2)),
                                 std::atan2(-R(0, 1), R(0, 0)));
    out << '(' << n * dt << " ((" << x.transpose() << ") (" << (degrees * angles).transpose()
        << ")))\n";
  }
  out << ")\n";
}

}  // namespace monarch_flight
