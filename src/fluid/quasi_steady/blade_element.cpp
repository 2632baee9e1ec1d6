#include <cmath>
#include <cstring>
#include <stdexcept>

#include "fluid/quasi_steady/coefficients.h"
#include "fluid/quasi_steady/strips.h"
#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight::fluid::quasi_steady {
namespace {

constexpr int kStrips = 64;

// Motion of the wing through the air, wing axes: velocity of the root,
// angular velocity, and the component-wise rates of both.
struct RelativeMotion {
  Eigen::Vector3d u, omega;
  Vector6d rate;
};

// Load of one strip: in-plane force applied at x = x_force, and a couple about y.
struct SectionLoad {
  double fx = 0.0, fz = 0.0;  // [N]
  double my = 0.0;            // about the strip's own y line through x = 0 [N m]
};

class BladeElement final : public FluidModel {
 public:
  BladeElement(const Planform& planform, const Air& air, BladeElementVariant variant)
      : air_(air),
        variant_(variant),
        strips_(makeStrips(planform, kStrips)),
        added_mass_(stripAddedMass(strips_, air.rho)),
        damping_(0.5 * air.rho * rotationalDampingCoefficient(variant)),
        committed_jump_(strips_.size(), 0.0),
        next_jump_(strips_.size(), 0.0) {}

  void start(const WingMotion& motion, double) override {
    started_ = false;
    loadsOf(motion);
    evaluated_ = true;
    commit();
    started_ = true;
  }

  Loads evaluate(const WingMotion& next) override {
    if (!started_) throw std::logic_error("quasi-steady fluid: evaluate before start");
    Loads loads = loadsOf(next);
    evaluated_ = true;
    return loads;
  }

  Loads linearise(const WingMotion& next, LoadOperator& jacobian) override;
  int operatorCost() const override { return 0; }

  void commit() override {
    if (!evaluated_) throw std::logic_error("quasi-steady fluid: commit without an evaluation");
    committed_jump_ = next_jump_;
    evaluated_ = false;
  }

  // The model has no memory but for the picture: the pressure jump of the committed step.
  std::vector<char> save() const override {
    std::vector<char> bytes(committed_jump_.size() * sizeof(double));
    std::memcpy(bytes.data(), committed_jump_.data(), bytes.size());
    return bytes;
  }

  void restore(const std::vector<char>& bytes) override {
    if (bytes.size() != committed_jump_.size() * sizeof(double))
      throw std::invalid_argument("quasi-steady fluid: saved state belongs to another wing");
    std::memcpy(committed_jump_.data(), bytes.data(), bytes.size());
    started_ = true;
    evaluated_ = false;
  }

  Matrix6d addedMass() const override { return added_mass_; }
  FluidReport report() const override { return {}; }
  long cells() const override { return 0; }

  SurfacePressure surfacePressure() const override {
    SurfacePressure surface;
    surface.facets.reserve(strips_.size());
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      const Strip& s = strips_[i];
      const double half = 0.5 * committed_jump_[i];
      surface.facets.push_back({float(s.middle()), float(s.edge + 0.5 * s.dy), float(s.chord),
                                float(s.dy), float(half), float(-half)});
    }
    return surface;
  }

 private:
  RelativeMotion relativeMotion(const WingMotion& m) const;
  SectionLoad translation(const Strip& s, double ux, double uz) const;
  SectionLoad rotation(const Strip& s, double ux, double omega_y) const;
  Loads loadsOf(const WingMotion& motion);

  const Air air_;
  const BladeElementVariant variant_;
  const std::vector<Strip> strips_;
  const Matrix6d added_mass_;
  const double damping_;                // 1/2 rho C_rd [kg/m^3]
  std::vector<double> committed_jump_;  // pressure above minus below, per strip [Pa]
  std::vector<double> next_jump_;
  bool started_ = false, evaluated_ = false;
};

// d(v_W)/dt component-wise is a_W - omega x v_W.
RelativeMotion BladeElement::relativeMotion(const WingMotion& m) const {
  RelativeMotion r;
  r.u = m.v_W;
  r.omega = m.omega_W;
  r.rate.head<3>() = m.a_W - m.omega_W.cross(r.u);
  r.rate.tail<3>() = m.alpha_W;
  return r;
}

// Steady lift and drag for the velocity (ux, uz) of the reference point, at the centre of pressure.
// Lift is perpendicular to the velocity, on the side where its normal part opposes the normal
// motion.
SectionLoad BladeElement::translation(const Strip& s, double ux, double uz) const {
  const double speed = std::hypot(ux, uz);
  SectionLoad load;
  if (speed == 0.0) return load;
  const SectionCoefficients c = sectionCoefficients(variant_, std::atan2(std::abs(uz), ux));
  const double q = 0.5 * air_.rho * speed * s.chord * s.dy;  // times a velocity: a force
  const double side = ux * uz >= 0.0 ? c.lift : -c.lift;
  load.fx = q * (side * uz - c.drag * ux);
  load.fz = q * (-side * ux - c.drag * uz);
  load.my = -(s.leading - c.centre_of_pressure * s.chord) * load.fz;
  return load;
}

// Rotational circulation (Sane & Dickinson only) and rotational damping.
SectionLoad BladeElement::rotation(const Strip& s, double ux, double omega_y) const {
  SectionLoad load;
  const double ahead = s.leading - s.reference, behind = s.chord - ahead;
  if (variant_ == BladeElementVariant::kSaneDickinson) {
    // Kutta: the circulation follows the normal velocity at 3/4 chord as the flow sees it. Of the
    // excess omega c (3/4 - x0) over the reference point, omega c (1/2 - x0) is the velocity of
    // mid-chord and acts like translation, at a quarter chord; the curvature part omega c / 4 acts
    // at mid-chord.
    const double x0 = ahead / s.chord;
    const double forward = ux >= 0.0 ? 1.0 : -1.0;
    const double f = -kPi * air_.rho * s.chord * s.chord * std::abs(ux) * omega_y * s.dy;
    const double f_middle = f * 0.25 * forward, f_quarter = f * (0.5 - x0);
    load.fz = f_middle + f_quarter;
    load.my = -s.middle() * load.fz - forward * 0.25 * s.chord * f_quarter;
  }
  // Drag of the chord's elements turning about the reference point, as a couple.
  const double fourth = 0.25 * (std::pow(ahead, 4) + std::pow(behind, 4));
  load.my -= damping_ * fourth * std::abs(omega_y) * omega_y * s.dy;
  return load;
}

// Velocity: central differences of the load, the added mass's part of it included. Acceleration:
// minus the added mass, exactly.
Loads BladeElement::linearise(const WingMotion& next, LoadOperator& jacobian) {
  constexpr double kStep = 1e-4, kRateStep = 1e-2;  // [m/s], [rad/s]: far below those of a flight
  for (int i = 0; i < 6; ++i) {
    Vector6d side[2];
    for (int s = 0; s < 2; ++s) {
      WingMotion motion = next;
      (i < 3 ? motion.v_W(i) : motion.omega_W(i - 3)) +=
          (s == 0 ? 1.0 : -1.0) * (i < 3 ? kStep : kRateStep);
      const Loads loads = loadsOf(motion);
      side[s] << loads.force(), loads.moment();
    }
    jacobian.velocity.col(i) = (side[0] - side[1]) / (2.0 * (i < 3 ? kStep : kRateStep));
  }
  jacobian.acceleration = -added_mass_;
  return evaluate(next);
}

Loads BladeElement::loadsOf(const WingMotion& motion) {
  evaluated_ = false;  // until it is done: what throws leaves nothing to commit
  const RelativeMotion m = relativeMotion(motion);
  Loads loads;
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Strip& s = strips_[i];
    const double ux = m.u.x() - m.omega.z() * s.y;
    const double uz = m.u.z() + m.omega.x() * s.y - m.omega.y() * s.reference;
    const SectionLoad t = translation(s, ux, uz), r = rotation(s, ux, m.omega.y());
    const double fx = t.fx + r.fx, fz = t.fz + r.fz;
    loads.force_pressure += Eigen::Vector3d(fx, 0.0, fz);
    loads.moment_pressure += Eigen::Vector3d(s.y * fz, t.my + r.my, -s.y * fx);

    const double normal_rate = m.rate[2] + s.y * m.rate[3] - s.middle() * m.rate[4];
    const double added = -0.25 * kPi * air_.rho * s.chord * normal_rate;  // force per area
    next_jump_[i] = fz / (s.chord * s.dy) + added;
  }
  // The air's kinetic energy changes: conservative, and linear in the accelerations.
  const Vector6d added = -(added_mass_ * m.rate);
  loads.force_pressure += added.head<3>();
  loads.moment_pressure += added.tail<3>();
  if (!loads.finite())
    throw NumericalError(
        "quasi-steady fluid: the loads are not finite; the wing's motion handed in is not finite "
        "or "
        "far out of any physical range");
  return loads;
}

}  // namespace

}  // namespace monarch_flight::fluid::quasi_steady

namespace monarch_flight {

std::unique_ptr<FluidModel> makeQuasiSteady(const Planform& planform, const Air& air,
                                            BladeElementVariant variant) {
  return std::make_unique<fluid::quasi_steady::BladeElement>(planform, air, variant);
}

}  // namespace monarch_flight
