#include "monarch_flight/ros_io/ros_output.h"

#include "monarch_flight/ros_io/master.h"

namespace monarch_flight {
namespace {

// Messages that may wait for a slow listener; the oldest go first.
constexpr std::uint32_t kQueue = 100;
const ros::WallDuration kDiagnosticPeriod(1.0);

// diagnostic_updater puts "<node>: " in front of the name of a task.
std::string taskName(const std::string& name) {
  const std::size_t colon = name.find(": ");
  return colon == std::string::npos ? name : name.substr(colon + 2);
}

}  // namespace

RosOutput::RosOutput(const ros::NodeHandle& node) : node_(node) {}

void RosOutput::open(const std::vector<StampedMessage>& topics) {
  ros::Time::setNow(ros::Time(1, 0));
  for (const StampedMessage& topic : topics) {
    if (topic.topic == topics::kDiagnostics) continue;
    std::visit(
        [&](const auto& content) {
          using Message = std::decay_t<decltype(content)>;
          // Who comes while the run is held gets the time and the pose, too.
          const bool latched =
              topic.latched || topic.topic == topics::kClock || topic.topic == topics::kTf;
          publishers_[topic.topic] = node_.advertise<Message>(topic.topic, kQueue, latched);
        },
        topic.message);
  }
  if (publishers_.count(topics::kClock) > 0) ownClock();
  updater_ = std::make_unique<diagnostic_updater::Updater>();
  updater_->setHardwareID("monarch_flight");
}

void RosOutput::write(const StampedMessage& message) {
  ros::Time::setNow(message.stamp);
  if (const auto* diagnostics = std::get_if<diagnostic_msgs::DiagnosticArray>(&message.message)) {
    diagnose(*diagnostics);
    return;
  }
  const ros::Publisher& publisher = publishers_.at(message.topic);
  if (!publisher) return;  // the clock of another run
  std::visit([&publisher](const auto& content) { publisher.publish(content); }, message.message);
}

void RosOutput::diagnose(const diagnostic_msgs::DiagnosticArray& diagnostics) {
  for (const diagnostic_msgs::DiagnosticStatus& status : diagnostics.status) {
    const bool known = statuses_.count(status.name) > 0;
    diagnostic_msgs::DiagnosticStatus& kept = statuses_[status.name];
    kept = status;
    if (known) continue;
    updater_->add(taskName(status.name), [&kept](diagnostic_updater::DiagnosticStatusWrapper& s) {
      s.summary(kept.level, kept.message);
      s.values = kept.values;
    });
  }
  keepAlive();
}

void RosOutput::keepAlive() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (statuses_.empty() || now < diagnosed_ + kDiagnosticPeriod) return;
  diagnosed_ = now;
  updater_->force_update();
}

/// What the last step said.
void RosOutput::close() {
  if (!statuses_.empty()) updater_->force_update();
}

/// The master lists publishers in the order in which they came, so two runs agree.
void RosOutput::ownClock() {
  const std::string owner = firstPublisher(node_.resolveName(topics::kClock));
  if (owner.empty() || owner == ros::this_node::getName()) return;
  publishers_[topics::kClock].shutdown();
  ROS_INFO("%s is that of %s: this run does not publish it", topics::kClock, owner.c_str());
}

}  // namespace monarch_flight
