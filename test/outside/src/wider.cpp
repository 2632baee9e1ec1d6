// Guidance of one's own: the motion of the case, its deviation wider.
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

#include "monarch_flight/run/plugins.h"

namespace monarch_outside {

using namespace monarch_flight;

class Guide : public Guidance {
 public:
  Guide(const Case& c, double deviation)
      : motion_(c.motion),
        wind_(c.wind),
        rate_(deviation / c.time.stepsPerFlap()),
        most_(deviation) {}

  PrescribedState start(double t) override {
    added_ = 0.0;
    return at(t, {});
  }
  PrescribedState next(const GuidanceInput& input) override {
    added_ = std::min(added_ + rate_, most_);
    return at(input.t, windAhead(*wind_, input));
  }
  void memory(StateVisitor& state) override { state("added", added_); }

 private:
  PrescribedState at(double t, const Wind& wind) const {
    PrescribedState level = motion_->at(t);
    for (Side side : kSides) level.angles.wings[side].psi.q += added_;
    level.wind = wind;
    return level;
  }
  std::shared_ptr<const PrescribedMotion> motion_;
  std::shared_ptr<const WindModel> wind_;
  double rate_, most_, added_ = 0.0;
};

class Wider : public GuidancePlugin {
 public:
  std::unique_ptr<Guidance> make(const GuidancePluginInput& input) override {
    const YAML::Node parameters = YAML::Load(input.parameters);
    return std::make_unique<Guide>(input.flown, parameters["deviation"].as<double>(0.0));
  }
};

}  // namespace monarch_outside

PLUGINLIB_EXPORT_CLASS(monarch_outside::Wider, monarch_flight::GuidancePlugin)
