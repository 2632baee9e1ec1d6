// Reads a recorded flight: its case, its last state, and the air's force there by the library.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include <cstdio>
#include <exception>

#include "monarch_flight/FlightState.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/run/federation.h"

using namespace monarch_flight;

namespace {

template <class Message>
typename Message::ConstPtr lastOf(const rosbag::Bag& bag, const std::string& topic) {
  typename Message::ConstPtr last;
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery(topic)))
    last = m.instantiate<Message>();
  if (!last) throw std::runtime_error(topic + ": nothing in the bag");
  return last;
}

/// Force of quasi-steady air on the right wing of the case, at rest but for gliding [N].
Eigen::Vector3d force(const Case& c) {
  const auto air = makeQuasiSteady(c.insect.wings.right.planform, c.air, c.blade_element);
  WingMotion motion;
  motion.v_W = {1.0, 0.0, 0.3};
  air->start(motion, c.time.dt);
  LoadOperator jacobian;
  const Loads loads = air->linearise(motion, jacobian);
  air->commit();
  const std::vector<Matrix6d> copies(3, jacobian.velocity);  // of matrices that the library filled
  return copies.back().isZero() ? Eigen::Vector3d::Zero() : loads.force();
}

void print(const std::string& path) {
  const rosbag::Bag bag(path);
  const auto text = lastOf<std_msgs::String>(bag, "/monarch_flight/case");
  const Case c = caseFromText(text->data, path, {}, configDirectory());
  const auto state = lastOf<FlightState>(bag, "/monarch_flight/state");
  const Eigen::Vector3d f = force(c);
  std::printf("%s in %s air: step %u, height %.6f m; gliding force %.9g N\n", c.name.c_str(),
              fluidName(c).c_str(), state->step, -state->body.position.z, f.norm());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: print_flight <flight.bag>");
    print(argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "print_flight: %s\n", e.what());
    return 1;
  }
  return 0;
}
