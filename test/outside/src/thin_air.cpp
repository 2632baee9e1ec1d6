// Air of one's own: the quasi-steady model with another density.
#include <yaml-cpp/yaml.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <utility>

#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/run/plugins.h"

namespace monarch_outside {

using namespace monarch_flight;

class Model : public FluidModel {
 public:
  explicit Model(std::unique_ptr<FluidModel> inner) : inner_(std::move(inner)) {}
  void start(const WingMotion& motion, double dt) override { inner_->start(motion, dt); }
  Loads evaluate(const WingMotion& next) override { return inner_->evaluate(next); }
  Loads linearise(const WingMotion& next, LoadOperator& jacobian) override {
    return inner_->linearise(next, jacobian);
  }
  int operatorCost() const override { return inner_->operatorCost(); }
  void commit() override { inner_->commit(); }
  std::vector<char> save() const override { return inner_->save(); }
  void restore(const std::vector<char>& bytes) override { inner_->restore(bytes); }
  Matrix6d addedMass() const override { return inner_->addedMass(); }
  FluidReport report() const override { return inner_->report(); }
  long cells() const override { return 0; }
  SurfacePressure surfacePressure() const override { return inner_->surfacePressure(); }

 private:
  std::unique_ptr<FluidModel> inner_;
};

class ThinAir : public FluidPlugin {
 public:
  std::unique_ptr<FluidModel> make(const FluidPluginInput& input) override {
    const YAML::Node parameters = YAML::Load(input.parameters);
    const double factor = parameters["density_factor"].as<double>(1.0);
    if (!(factor > 0.0)) throw std::invalid_argument("density_factor: must be > 0");
    Air air = input.flown.air;
    air.rho *= factor;
    return std::make_unique<Model>(makeQuasiSteady(input.planform, air, input.flown.blade_element));
  }
};

}  // namespace monarch_outside

PLUGINLIB_EXPORT_CLASS(monarch_outside::ThinAir, monarch_flight::FluidPlugin)
