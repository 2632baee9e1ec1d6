// A wind that is uniform in space is a moving frame, whatever it does in time: the wing's loads,
// and a whole flight, seen from the air.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "core/coupling_fakes.h"
#include "core/fluid_flapping.h"
#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/insect/gusts.h"

namespace monarch_flight {
namespace {

using Eigen::Vector3d;
using testing::publishedMonarch;

const FreeCoordinates kAllFree = {kX, kZ, kPitch, kThetaR};
const Vector3d kRest = Vector3d::Zero();

/// Motion of the air's frame: place, velocity and acceleration at t.
struct Drift {
  Vector3d x, v, a;
};
using DriftAt = std::function<Drift(double t)>;

/// The motion of another one as it is seen from the air.
class SeenFromTheAir : public PrescribedMotion {
 public:
  SeenFromTheAir(std::shared_ptr<const PrescribedMotion> base, DriftAt air)
      : base_(std::move(base)), air_(std::move(air)) {}
  PrescribedState at(double t) const override {
    PrescribedState state = base_->at(t);
    const Drift air = air_(t);
    state.body.x -= air.x;
    state.body.v -= air.v;
    state.body.a -= air.a;
    return state;
  }

 private:
  std::shared_ptr<const PrescribedMotion> base_;
  DriftAt air_;
};

/// The wind that moves the air so.
class DriftWind : public WindModel {
 public:
  explicit DriftWind(DriftAt air) : air_(std::move(air)) {}
  Wind at(double t, const Vector3d&, const Vector3d&, const Vector3d&) const override {
    return {air_(t).v, air_(t).a};
  }
  WindRange range() const override { return {}; }

 private:
  DriftAt air_;
};

using MakeFluid = std::function<std::unique_ptr<FluidModel>()>;

std::unique_ptr<FluidModel> quasiSteady() {
  return makeQuasiSteady(publishedMonarch().wings.right.planform, Air{},
                         BladeElementVariant::kSaneDickinson);
}

std::unique_ptr<FluidModel> navierStokes() {
  return makeNavierStokes(publishedMonarch().wings.right.planform, Air{}, smallGrid());
}

class Fluids : public ::testing::TestWithParam<MakeFluid> {};

/// Loads of `steps` prescribed steps of dt [s], as the fluid participant answers them.
std::vector<Loads> loadsOf(const MakeFluid& fluid, const PrescribedMotion& motion,
                           const WindModel& wind, int steps, double dt) {
  CoupledModel model = testing::coupledModel({}, steps);
  model.newmark.dt = dt;
  FluidParticipant air(Side::kRight, model, fluid());
  std::vector<Loads> loads;
  for (int n = 0; n <= steps; ++n) {
    Request request;
    request.key.run = 7;
    request.key.step = n;
    request.key.phase = n == 0 ? Phase::kStart : Phase::kIterate;
    request.t = model.time(n);
    request.prescribed = motion.at(request.t);
    request.interface = request.prescribed.interface();
    const BodyState& body = request.prescribed.body;
    request.prescribed.wind = wind.at(request.t, body.x, body.v, body.a);
    const Reply reply = air.exchange(request);
    EXPECT_EQ(reply.error, "");
    if (n == 0) continue;
    loads.push_back(reply.loads);
    request.key.phase = Phase::kCommit;
    EXPECT_EQ(air.exchange(request).error, "");
  }
  return loads;
}

double largest(const std::vector<Loads>& loads) {
  double result = 0.0;
  for (const Loads& l : loads) result = std::max(result, l.force().norm());
  return result;
}

double distance(const std::vector<Loads>& a, const std::vector<Loads>& b) {
  double result = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result = std::max(result, (a[i].force() - b[i].force()).norm());
    result = std::max(result, (a[i].moment() - b[i].moment()).norm() / 0.02);
  }
  return result;
}

/// Gusts of all kinds at the times of the tests; for the air's frame only v and a matter.
std::shared_ptr<const WindModel> gusts() {
  const auto slow = std::make_shared<TimeGust>(0.021, 0.011, Vector3d(-1.2, 0.7, 0.9));
  const auto fast = std::make_shared<TimeGust>(0.019, 0.004, Vector3d(0.3, -0.2, -1.1));
  const auto steady = std::make_shared<SteadyWind>(Vector3d(0.4, -0.3, 0.2));
  return std::make_shared<WindSum>(
      std::vector<std::shared_ptr<const WindModel>>{slow, fast, steady});
}

DriftAt driftOf(const std::shared_ptr<const WindModel>& wind) {
  return [wind](double t) {
    const Wind w = wind->at(t, kRest, kRest, kRest);
    return Drift{kRest, w.v, w.a};  // where the air is does not matter to it
  };
}

TEST_P(Fluids, AGustIsAMovingFrame) {
  const auto base = std::make_shared<testing::SineFlapping>();
  const auto wind = gusts();
  const SeenFromTheAir still(base, driftOf(wind));
  const std::vector<Loads> blown = loadsOf(GetParam(), *base, *wind, 12, 5e-4);
  const std::vector<Loads> moved = loadsOf(GetParam(), still, SteadyWind(), 12, 5e-4);
  const std::vector<Loads> calm = loadsOf(GetParam(), *base, SteadyWind(), 12, 5e-4);
  EXPECT_LT(distance(blown, moved), 1e-12 * largest(blown));
  EXPECT_GT(distance(blown, calm), 0.1 * largest(blown));  // the gust is felt
}

TEST_P(Fluids, AWingThatIsCarriedByTheWindFeelsNothing) {
  const auto wind = gusts();
  class Carried : public PrescribedMotion {
   public:
    explicit Carried(DriftAt air) : air_(std::move(air)) {}
    PrescribedState at(double t) const override {
      PrescribedState state;
      state.body = withPitch(state.body, {0.3, 0.0, 0.0});
      state.body.v = air_(t).v;
      state.body.a = air_(t).a;
      WingAngles wing;
      wing.phi.q = 0.4;
      wing.theta.q = -0.2;
      state.angles.wings = testing::both(wing);
      return state;
    }

   private:
    DriftAt air_;
  };
  const Carried carried(driftOf(wind));
  const double held = largest(loadsOf(GetParam(), carried, SteadyWind(), 6, 5e-4));
  EXPECT_LT(largest(loadsOf(GetParam(), carried, *wind, 6, 5e-4)), 1e-14 * held);
}

INSTANTIATE_TEST_SUITE_P(Both, Fluids, ::testing::Values(&quasiSteady, &navierStokes),
                         [](const auto& info) {
                           return info.index == 0 ? "QuasiSteady" : "NavierStokes";
                         });

/// A whole flight in one process.
std::vector<CommittedStep> fly(const MakeFluid& fluid,
                               std::shared_ptr<const PrescribedMotion> motion,
                               std::shared_ptr<const WindModel> wind, double gravity,
                               std::uint32_t steps, double dt) {
  CoupledModel model = testing::coupledModel(kAllFree, steps);
  model.newmark.dt = dt;
  model.gravity = gravity;
  CouplingSettings settings = testing::couplingSettings();
  settings.tolerance = 1e-12;
  settings.load_tolerance = 1e-10;
  FluidParticipant air(Side::kRight, model, fluid());
  FlightParticipant flight(model);
  WingParticipant wing(model);
  GuidanceParticipant guidance(
      model, std::make_unique<MotionGuidance>(std::move(motion), std::move(wind)));
  testing::KeepingSink sink;
  const StopFlag stop{false};
  FlyUntil control(stop);
  const CoupledOutcome outcome =
      Coordinator(model, settings, {&air, &flight, &wing, &guidance, nullptr}, 7)
          .run({&sink}, control);
  EXPECT_TRUE(outcome.complete) << outcome.failure;
  return sink.steps;
}

/// In a wind W = w0 + c t the air's frame is accelerated by c: from it the flight is one in still
/// air under the gravity g - c, exactly; Newmark's steps, too, are exact for the difference.
/// Returns the largest distance of the two flights (positions in chords, angles in rad).
double frameError(const MakeFluid& fluid, std::uint32_t steps, double dt, double& felt) {
  const double gravity = 9.81, t0 = 0.02;
  const Vector3d w0(-0.6, 0.0, 0.3), c(0.0, 0.0, -4.0);
  const DriftAt air = [&](double t) {
    const double s = t - t0;
    return Drift{w0 * s + 0.5 * c * s * s, w0 + c * s, c};
  };
  const auto base = std::make_shared<testing::SineFlapping>();
  const auto blown = fly(fluid, base, std::make_shared<DriftWind>(air), gravity, steps, dt);
  const auto still = fly(fluid, std::make_shared<SeenFromTheAir>(base, air),
                         std::make_shared<SteadyWind>(), gravity - c.z(), steps, dt);
  const auto calm = fly(fluid, base, std::make_shared<SteadyWind>(), gravity, steps, dt);
  EXPECT_EQ(blown.size(), steps + 1);
  EXPECT_EQ(still.size(), steps + 1);
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(blown.size(), still.size()); ++i) {
    Interface seen = still[i].interface;
    seen.body.x += air(still[i].t).x;
    worst = std::max(worst, testing::dimensionlessDistance(blown[i].interface, seen, 0.0209));
  }
  felt = testing::dimensionlessDistance(blown.back().interface, calm.back().interface, 0.0209);
  return worst;
}

TEST(RisingWind, IsAnotherGravityInQuasiSteadyAir) {
  double felt = 0.0;
  EXPECT_LT(frameError(&quasiSteady, 1000, 1e-4, felt), 1e-12);  // a flap
  EXPECT_GT(felt, 0.1);
}

TEST(RisingWind, IsAnotherGravityInNavierStokesAir) {
  double felt = 0.0;
  EXPECT_LT(frameError(&navierStokes, 40, 2.5e-4, felt), 1e-11);
  EXPECT_GT(felt, 1e-3);
}

}  // namespace
}  // namespace monarch_flight
