#pragma once
// A flap through the package's coordinator whose air bears given loads.
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight::verify {

/// Air that bears given loads whatever the wing does.
class GivenLoads : public FluidModel {
 public:
  explicit GivenLoads(std::function<Loads(double t)> loads) : loads_(std::move(loads)) {}
  void start(const WingMotion&, double dt) override { dt_ = dt, level_ = 0; }
  Loads evaluate(const WingMotion&) override { return loads_((level_ + 1) * dt_); }
  Loads linearise(const WingMotion& next, LoadOperator& jacobian) override {
    jacobian = LoadOperator();  // given loads do not feel the motion
    return evaluate(next);
  }
  int operatorCost() const override { return 0; }
  void commit() override { ++level_; }
  std::vector<char> save() const override { return {}; }
  void restore(const std::vector<char>&) override {}
  Matrix6d addedMass() const override { return Matrix6d::Zero(); }
  FluidReport report() const override { return {}; }
  long cells() const override { return 0; }
  SurfacePressure surfacePressure() const override { return {}; }

 private:
  std::function<Loads(double t)> loads_;
  double dt_ = 0.0;
  int level_ = 0;
};

/// The motion, with accelerations at t = 0 that satisfy the equations of motion.
class ConsistentStart : public PrescribedMotion {
 public:
  ConsistentStart(std::shared_ptr<const PrescribedMotion> base, PrescribedState start)
      : base_(std::move(base)), start_(std::move(start)) {}
  PrescribedState at(double t) const override { return t == 0.0 ? start_ : base_->at(t); }

 private:
  std::shared_ptr<const PrescribedMotion> base_;
  PrescribedState start_;
};

struct LastStep : StepSink {
  void onStep(const CommittedStep& step) override { last = step; }
  void onReset() override {}
  void onEnd(const std::string&) override {}
  CommittedStep last;
};

}  // namespace monarch_flight::verify
