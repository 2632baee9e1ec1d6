// What must stay: momenta without loads, energy with everything that does work.
#include <memory>

#include "dynamics/ode.h"
#include "dynamics/rows.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Vector3d;

constexpr int kFlaps = 10;
constexpr double kDelay = 0.013;  // of the left wing, so that nothing stays in one plane [s]

Loads noLoads(double) { return {}; }

/// Momenta of the insect with unequal wings, started with velocity and spin about every axis.
DynamicsRows momenta(const Case& c, int steps_per_flap) {
  const auto joints = [&](double t) {
    JointAngles angles = c.motion->at(t).angles;
    WingAngles& late = angles.wings.left;
    late = c.motion->at(t - kDelay).angles.wings.left;
    late.psi.q *= 2.0, late.psi.qd *= 2.0, late.psi.qdd *= 2.0;
    return insectMotion(c.insect.beta, BodyState(), angles).joints;
  };
  const auto none = [](double) {
    return std::array<Vector6d, 3>{Vector6d::Zero(), Vector6d::Zero(), Vector6d::Zero()};
  };
  const FreeInsect insect(c.insect, 0.0, joints, none);
  BodyState start = c.motion->at(0.0).body;
  start.v = {1.3, 0.2, -0.562};
  start.Omega_B = {5.0, 15.0, -3.0};
  OdeState y = FreeInsect::state(start);
  Vector3d p0, L0;
  double p_scale = 0.0, L_scale = 0.0, p_drift = 0.0, L_drift = 0.0;
  integrate(insect, y, 0.0, kFlaps * c.time.period, kFlaps * steps_per_flap,
            [&](const OdeState& s, double t) {
              const InsectMotion m = insect.motion(s, t);
              const Vector3d p = insect.dynamics().linearMomentum(m);
              const Vector3d L =
                  insect.dynamics().angularMomentum(m) - insect.dynamics().massCentre(m).cross(p);
              if (t == 0.0) p0 = p, L0 = L;
              // What joints pass between body and appendages.
              Eigen::Matrix<double, 9, 1> rates;
              rates << m.joints[0].Omega, m.joints[1].Omega, m.joints[2].Omega;
              const Vector6d exchanged =
                  insect.dynamics().inertia(m).topRightCorner<6, 9>() * rates;
              p_scale = std::max(p_scale, exchanged.head<3>().norm());
              L_scale = std::max(L_scale, exchanged.tail<3>().norm());
              p_drift = std::max(p_drift, (p - p0).norm());
              L_drift = std::max(L_drift, (L - L0).norm());
            });
  const std::string how = std::to_string(steps_per_flap) + " steps a flap, order 8";
  return {{"momentum", "linear momentum, largest drift in 10 flaps / exchanged", how, p_drift,
           p_scale, p_drift / p_scale, 1e-10},
          {"momentum", "angular momentum about the mass centre, largest drift / exchanged", how,
           L_drift, L_scale, L_drift / L_scale, 1e-10}};
}

/// Kinetic and potential energy against the work of actuators and air.
DynamicsRow energy(const std::string& name, const Case& c, double gravity, double flaps,
                   int steps_per_flap, const LongitudinalFlight::RightLoads& loads) {
  const LongitudinalFlight flight(c.insect, gravity, c.motion, loads);
  OdeState y = flight.state(0.0);
  double start = 0.0, low = INFINITY, high = -INFINITY, worst = 0.0;
  integrate(flight, y, 0.0, flaps * c.time.period, static_cast<int>(flaps * steps_per_flap),
            [&](const OdeState& s, double t) {
              const double kinetic = flight.kineticEnergy(s, t);
              const double rest = kinetic + flight.potentialEnergy(s, t) - s[8] - s[9];
              if (t == 0.0) start = rest;
              low = std::min(low, kinetic), high = std::max(high, kinetic);
              worst = std::max(worst, std::abs(rest - start));
            });
  return {"energy", name,       std::to_string(steps_per_flap) + " steps a flap, order 8",
          worst,    high - low, worst / (high - low),
          1e-9};
}

}  // namespace

DynamicsRows checkConservation(const DynamicsFolders& folders) {
  const Case c = loadCase("climb_fwuav", {}, folders.config);
  return momenta(c, 400);
}

DynamicsRows checkEnergy(const DynamicsFolders& folders) {
  DynamicsRows rows;
  for (const char* name : {"climb_printed", "climb_fwuav"}) {
    const Case c = loadCase(name, {}, folders.config);
    const double f = 1.0 / c.time.period;
    const std::string of = std::string(" (") + name + "), J of swing of kinetic energy";
    rows.push_back(energy("actuators and spring, one flap" + of, c, 0.0, 1.0, 1000, noLoads));
    rows.push_back(
        energy("actuators, spring and gravity, one flap" + of, c, c.gravity, 1.0, 1000, noLoads));
    rows.push_back(energy("actuators, spring, gravity and air, one flap" + of, c, c.gravity, 1.0,
                          1000, [f](double t) { return smoothLoads(f, t); }));
  }
  return rows;
}

}  // namespace monarch_flight::verify
