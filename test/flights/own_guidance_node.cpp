// A guidance node of one's own in C++: the case's motion, its deviation wider by 0.02 rad.
#include "monarch_flight/ros_io/node_main.h"

namespace {

using namespace monarch_flight;

class Wider : public Guidance {
 public:
  explicit Wider(const Case& c) : motion_(c.motion) {}
  PrescribedState start(double t) override { return at(t); }
  PrescribedState next(const GuidanceInput& input) override { return at(input.t); }

 private:
  PrescribedState at(double t) const {
    PrescribedState state = motion_->at(t);
    for (Side side : kSides) state.angles.wings[side].psi.q += 0.02;
    return state;
  }
  std::shared_ptr<const PrescribedMotion> motion_;
};

}  // namespace

int main(int argc, char** argv) {
  return guidanceMain(argc, argv, [](const Case& c) { return std::make_unique<Wider>(c); });
}
