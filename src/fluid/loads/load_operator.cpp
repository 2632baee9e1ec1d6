#include "fluid/loads/load_operator.h"

#include <array>

namespace monarch_flight::fluid::loads {
namespace {

constexpr double kVelocity = 1.0;  // of a unit evaluation [m/s], [rad/s]; exact for any value
constexpr double kRate = 50.0;     // turns the tip of a wing as fast as that

Vector6d vector(const Loads& loads) {
  Vector6d all;
  all << loads.force(), loads.moment();
  return all;
}

}  // namespace

Loads affineLinearise(FluidModel& model, const WingMotion& next, LoadOperator& jacobian) {
  std::array<Vector6d, kAffineEvaluations> shifted;
  for (int i = 0; i < kAffineEvaluations; ++i) {
    WingMotion motion = next;
    (i < 3 ? motion.v_W(i) : motion.omega_W(i - 3)) += i < 3 ? kVelocity : kRate;
    shifted[static_cast<std::size_t>(i)] = vector(model.evaluate(motion));
  }
  Loads loads = model.evaluate(next);  // the last one is what a commit keeps
  for (int i = 0; i < kAffineEvaluations; ++i) {
    jacobian.velocity.col(i) =
        (shifted[static_cast<std::size_t>(i)] - vector(loads)) / (i < 3 ? kVelocity : kRate);
  }
  jacobian.acceleration.setZero();
  return loads;
}

}  // namespace monarch_flight::fluid::loads
