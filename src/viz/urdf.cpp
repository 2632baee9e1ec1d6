#include "monarch_flight/viz/urdf.h"

#include <cmath>
#include <cstdarg>
#include <filesystem>
#include <fstream>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/viz/frames.h"
#include "monarch_flight/viz/mesh.h"
#include "viz/marker.h"

namespace monarch_flight {
namespace {

std::string format(const char* text, ...) {
  char out[512];
  va_list arguments;
  va_start(arguments, text);
  std::vsnprintf(out, sizeof(out), text, arguments);
  va_end(arguments);
  return out;
}

std::string xyz(const Eigen::Vector3d& v) {
  return format("%.15g %.15g %.15g", v.x(), v.y(), v.z());
}

// Mass, its centre and the inertia about the centre; J is about the link's origin.
std::string inertial(double m, const Eigen::Vector3d& nu, const Eigen::Matrix3d& J) {
  const Eigen::Matrix3d C =
      J - m * (nu.squaredNorm() * Eigen::Matrix3d::Identity() - nu * nu.transpose());
  return "    <inertial>\n      <origin xyz=\"" + xyz(nu) + "\"/>\n" +
         format("      <mass value=\"%.15g\"/>\n", m) +
         format(
             "      <inertia ixx=\"%.15g\" ixy=\"%.15g\" ixz=\"%.15g\" iyy=\"%.15g\" iyz=\"%.15g\" "
             "izz=\"%.15g\"/>\n",
             C(0, 0), C(0, 1), C(0, 2), C(1, 1), C(1, 2), C(2, 2)) +
         "    </inertial>\n";
}

std::string link(const std::string& name, const std::string& content = "") {
  if (content.empty()) return "  <link name=\"" + name + "\"/>\n";
  return "  <link name=\"" + name + "\">\n" + content + "  </link>\n";
}

std::string visual(const std::string& mesh, const std::string& material) {
  return "    <visual>\n      <geometry><mesh filename=\"" + mesh +
         "\"/></geometry>\n      <material name=\"" + material + "\"/>\n    </visual>\n";
}

std::string fixed(const std::string& parent, const std::string& child, const Eigen::Vector3d& rpy) {
  return "  <joint name=\"" + child + "_mount\" type=\"fixed\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + child + "\"/>\n    <origin xyz=\"0 0 0\" rpy=\"" + xyz(rpy) +
         "\"/>\n  </joint>\n";
}

std::string hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const Eigen::Vector3d& at, const Eigen::Vector3d& axis) {
  return "  <joint name=\"" + name + "\" type=\"continuous\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + child + "\"/>\n    <origin xyz=\"" + xyz(at) +
         "\"/>\n    <axis xyz=\"" + xyz(axis) + "\"/>\n  </joint>\n";
}

// The three joints of one wing on the stroke plane: exp(+-phi e1) exp(-+psi e3) exp(theta e2).
std::string wing(const Insect& insect, Side side, const std::string& mesh_uri) {
  const bool left = side == Side::kLeft;
  const Appendage part = left ? mirrored(insect.wings.left.plate) : insect.wings.right.plate;
  const std::string name = left ? "left" : "right";
  const double sign = left ? -1.0 : 1.0;
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  const std::string flapping = name + "_wing_flapping", deviation = name + "_wing_deviation",
                    blade = name + "_wing";
  return link(flapping) + link(deviation) +
         link(blade,
              inertial(part.m, part.nu, part.J) + visual(mesh_uri + name + "_wing.stl", "wing")) +
         hinge(name + "_flap", frames::kStrokePlane, flapping, wingRoot(insect, side),
               {sign, 0, 0}) +
         hinge(name + "_deviation", flapping, deviation, here, {0, 0, -sign}) +
         hinge(name + "_pitch", deviation, blade, here, {0, 1, 0});
}

void writeFile(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file) throw InputError("cannot write " + path.string() + ": is there space and permission?");
}

std::string material(const char* name, const std_msgs::ColorRGBA& c) {
  return format("  <material name=\"%s\"><color rgba=\"%.2f %.2f %.2f 1\"/></material>\n", name,
                static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b));
}

}  // namespace

std_msgs::ColorRGBA wingColour() { return colour(0.85f, 0.45f, 0.10f); }
std_msgs::ColorRGBA bodyColour() { return colour(0.20f, 0.17f, 0.15f); }

Mesh thoraxMesh(const Insect& insect) {
  return ellipsoidMesh(Eigen::Vector3d::Zero(), insect.body_length, insect.body_width);
}

// Behind its joint, on the side of its mass centre.
Mesh abdomenMesh(const Insect& insect) {
  const double side = insect.abdomen.nu.x() > 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d centre(0.5 * side * insect.abdomen_length, 0, 0);
  return ellipsoidMesh(centre, insect.abdomen_length, insect.abdomen_width);
}

std::string insectUrdf(const Insect& insect, const std::string& mesh_uri) {
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  std::string out = "<?xml version=\"1.0\"?>\n<robot name=\"" + insect.name + "\">\n" +
                    material("wing", wingColour()) + material("body", bodyColour()) +
                    link(frames::kBaseLink);
  const std::string body = insect.bare_wing ? ""
                                            : inertial(insect.m_B, here, insect.J_B) +
                                                  visual(mesh_uri + "thorax.stl", "body");
  out += link(frames::kBodyFrd, body) + link(frames::kStrokePlane) +
         fixed(frames::kBaseLink, frames::kBodyFrd, {M_PI, 0, 0}) +
         fixed(frames::kBodyFrd, frames::kStrokePlane, {0, insect.beta, 0});
  out += wing(insect, Side::kRight, mesh_uri);
  if (!insect.bare_wing) {
    const Appendage& abdomen = insect.abdomen;
    out += wing(insect, Side::kLeft, mesh_uri);
    out += link(frames::kAbdomen, inertial(abdomen.m, abdomen.nu, abdomen.J) +
                                      visual(mesh_uri + "abdomen.stl", "body"));
    out += hinge(joints::kAbdomen, frames::kBodyFrd, frames::kAbdomen, abdomen.mu, {0, 1, 0});
  }
  return out + "</robot>\n";
}

void writeMeshes(const Insect& insect, const std::string& directory) {
  const std::filesystem::path folder(directory);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  writeFile(folder / "right_wing.stl", stlBytes(wingMesh(insect.wings.right.planform, false)));
  if (insect.bare_wing) return;
  writeFile(folder / "left_wing.stl", stlBytes(wingMesh(insect.wings.left.planform, true)));
  writeFile(folder / "thorax.stl", stlBytes(thoraxMesh(insect)));
  writeFile(folder / "abdomen.stl", stlBytes(abdomenMesh(insect)));
}

}  // namespace monarch_flight
