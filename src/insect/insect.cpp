#include "monarch_flight/insect/insect.h"

#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>

#include "monarch_flight/insect/build.h"

namespace monarch_flight {
namespace {

class FaultList {
 public:
  void require(bool good, const std::string& key, double value, const char* unit, const char* bound,
               const char* remedy) {
    if (good) return;
    std::ostringstream text;
    text << "insect/" << key << " = " << value << ' ' << unit << ": must be " << bound << "; "
         << remedy;
    faults.push_back(text.str());
  }
  void positive(const std::string& key, double value, const char* unit, const char* remedy) {
    require(std::isfinite(value) && value > 0.0, key, value, unit, "> 0", remedy);
  }
  void finite(const std::string& key, double value, const char* unit) {
    require(std::isfinite(value), key, value, unit, "a finite number", "correct it");
  }
  std::vector<std::string> faults;
};

void checkButterfly(const Insect& insect, FaultList& list) {
  list.positive("body/mass", insect.m_B, "kg", "a monarch's thorax and head have about 2e-4");
  list.positive("body/length", insect.body_length, "m", "a monarch's is about 0.015");
  list.positive("body/width", insect.body_width, "m", "a monarch's is about 0.006");
  list.positive("abdomen/mass", insect.abdomen.m, "kg", "a monarch's is about 1.5e-4");
  list.positive("abdomen/length", insect.abdomen_length, "m", "a monarch's is about 0.017");
  list.positive("abdomen/width", insect.abdomen_width, "m", "a monarch's is about 0.004");
  for (int i = 0; i < 3; ++i) list.finite("abdomen/joint", insect.abdomen.mu[i], "m");
}

/// `section`: where the case has the additions.
void checkAdditions(const std::string& section, const HingeAdditions& additions, FaultList& list) {
  const auto atLeastZero = [&](const char* name, double value, const char* unit) {
    list.require(std::isfinite(value) && value >= 0.0, section + name, value, unit, ">= 0",
                 "0 is the paper's hinge, which has none");
  };
  atLeastZero("damping", additions.damping, "N m s/rad");
  atLeastZero("cubic_stiffness", additions.cubic_stiffness, "N m/rad3");
  atLeastZero("stop_stiffness", additions.stop_stiffness, "N m/rad");
  const auto& [low, high] = std::tie(additions.stop_low, additions.stop_high);
  for (const auto& [name, stop] : {std::pair{"stop_low", low}, {"stop_high", high}}) {
    if (stop)
      list.require(std::abs(*stop) <= M_PI, section + name, *stop, "rad", "within +-pi, or none",
                   "angles without the suffix _deg are in radians");
  }
  if (low && high)
    list.require(*low < *high, section + "stop_low", *low, "rad", "< stop_high",
                 "the wing pitches freely between the two");
  if (low || high)
    list.require(additions.stop_stiffness != 0.0, section + "stop_stiffness",
                 additions.stop_stiffness, "N m/rad", "> 0 where there is a stop",
                 "ten times wing/kappa is a hard one");
}

/// `section`: where the case has the wing.
void checkWing(const std::string& section, const Wing& wing, bool bare, FaultList& list) {
  const auto key = [&section](const char* name) { return section + "/" + name; };
  const Appendage& plate = wing.plate;
  if (bare) {
    list.require(std::isfinite(plate.m) && plate.m >= 0.0, key("mass"), plate.m, "kg", ">= 0",
                 "give the wing's mass, or 0 for a wing that only follows a motion");
    list.require(plate.mu.isZero(0.0), key("root"), plate.mu.norm(), "m", "0",
                 "a bare wing has its root at the origin; move it by motion/body/position");
  } else {
    list.positive(key("mass"), plate.m, "kg", "a monarch's is about 3e-5");
    for (int i = 0; i < 3; ++i) list.finite(key("root"), plate.mu[i], "m");
  }
  list.require(std::isfinite(wing.kappa) && wing.kappa >= 0.0, key("kappa"), wing.kappa, "N m/rad",
               ">= 0", "the published value is 1.5e-4; 0 is a free hinge");
  list.require(std::abs(wing.theta_0) <= M_PI, key("theta_0"), wing.theta_0, "rad", "within +-pi",
               "angles without the suffix _deg are in radians");
  checkAdditions(key("hinge_additions/"), wing.additions, list);
}

}  // namespace

double Insect::totalMass() const {
  return m_B + wings.right.plate.m + (bare_wing ? 0.0 : wings.left.plate.m) + abdomen.m;
}

double Insect::meanChord() const {
  return 0.5 * (wings.right.planform.meanChord() + wings.left.planform.meanChord());
}

std::vector<std::string> Insect::problems() const {
  FaultList list;
  if (!bare_wing) checkButterfly(*this, list);
  checkWing("wing", wings.right, bare_wing, list);
  list.require(std::abs(beta) <= M_PI, "beta", beta, "rad", "within +-pi",
               "angles without the suffix _deg are in radians");
  return list.faults;
}

std::vector<std::string> wingProblems(const std::string& section, const Wing& wing) {
  FaultList list;
  checkWing(section, wing, false, list);
  return list.faults;
}

Appendage plateWing(const Planform& planform, double mass, const Eigen::Vector3d& mu) {
  Appendage wing;
  wing.m = mass;
  wing.mu = mu;
  const double density = mass / planform.area();  // per area
  wing.nu << planform.moment(1, 0), planform.moment(0, 1), 0.0;
  wing.nu /= planform.area();
  const double xx = density * planform.moment(2, 0);
  const double yy = density * planform.moment(0, 2);
  const double xy = density * planform.moment(1, 1);
  wing.J << yy, -xy, 0.0,  //
      -xy, xx, 0.0,        //
      0.0, 0.0, xx + yy;
  return wing;
}

Appendage mirrored(const Appendage& right) {
  const Eigen::Vector3d mirror(1.0, -1.0, 1.0);
  Appendage left = right;
  left.nu = mirror.cwiseProduct(right.nu);
  left.mu = mirror.cwiseProduct(right.mu);
  left.J = mirror.asDiagonal() * right.J * mirror.asDiagonal();
  return left;
}

Eigen::Matrix3d Cylinder::inertia() const {
  const double along = mass * width * width / 8.0;
  const double across = mass * (0.75 * width * width + length * length) / 12.0;
  return Eigen::Vector3d(along, across, across).asDiagonal();
}

Wing makeWing(const WingParameters& wing, const Planform& planform) {
  return {plateWing(planform, wing.mass, wing.root), planform, wing.kappa, wing.theta_0,
          wing.additions};
}

Insect makeBareWing(const std::string& name, const WingParameters& wing, const Planform& planform) {
  const Wing one = makeWing(wing, planform);
  return {name, true, 0.0, Eigen::Matrix3d::Zero(), 0.0, 0.0, 0.0, 0.0, {}, wing.beta, {one, one}};
}

Insect makeButterfly(const std::string& name, const Cylinder& body, const Cylinder& abdomen,
                     const Eigen::Vector3d& abdomen_joint, const WingParameters& wing,
                     const Planform& planform) {
  Insect insect = makeBareWing(name, wing, planform);
  insect.bare_wing = false;
  insect.m_B = body.mass;
  insect.J_B = body.inertia();
  insect.body_length = body.length;
  insect.body_width = body.width;
  insect.abdomen_length = abdomen.length;
  insect.abdomen_width = abdomen.width;
  Appendage& tail = insect.abdomen;
  tail.m = abdomen.mass;
  tail.mu = abdomen_joint;
  tail.nu = Eigen::Vector3d(-0.5 * abdomen.length, 0.0, 0.0);
  const double shift = tail.m * tail.nu.squaredNorm();  // parallel axes
  tail.J = abdomen.inertia();
  tail.J(1, 1) += shift;
  tail.J(2, 2) += shift;
  return insect;
}

}  // namespace monarch_flight
