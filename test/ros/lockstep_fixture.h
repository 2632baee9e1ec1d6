#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "monarch_flight/ros_io/conversions.h"
#include "monarch_flight/ros_io/lockstep_client.h"
#include "monarch_flight/ros_io/lockstep_server.h"

namespace monarch_flight {

inline const std::string kSha(64, 'a');

/// A solver that answers the loads (step, iteration, number of computations) and can dawdle or
/// fail.
class ScriptedSolver : public Participant {
 public:
  Reply exchange(const Request& request) override {
    if (request.key.phase != Phase::kAbort) ++computed;
    if (request.key.phase == slow_phase) ros::WallDuration(dawdle_s).sleep();
    Reply reply;
    reply.key = request.key;
    reply.interface = request.interface;
    reply.loads.force_pressure = {double(request.key.step), double(request.key.iteration),
                                  double(computed.load())};
    if (broken) reply.loads.force_pressure.x() = std::numeric_limits<double>::quiet_NaN();
    return reply;
  }
  std::atomic<int> computed{0};
  std::atomic<bool> broken{false};
  Phase slow_phase = Phase::kCommit;
  double dawdle_s = 0.0;
};

inline LockstepLimits shortLimits() {
  LockstepLimits limits;
  limits.connect_s = 5.0;
  limits.exchange_s = 1.0;
  limits.start_s = 2.0;
  limits.silence_s = 30.0;
  limits.grace_s = 0.3;
  return limits;
}

/// Both ends in a namespace of their own; the server runs in a thread.
class Lockstep : public testing::Test {
 protected:
  Lockstep() : node(uniqueNamespace()) {
    run.id = 42;
    run.limits = shortLimits();
    run.stop = &stop;
  }
  ~Lockstep() override { endServer(); }

  void startServer(const LockstepIdentity& identity) {
    server = std::make_unique<LockstepServer>(node, identity, solver, server_limits, server_stop);
    thread = std::thread([this] {
      try {
        server->serve();
        server_end = "ended";
      } catch (const std::exception& e) {
        server_end = e.what();
      }
    });
  }
  void endServer() {
    server_stop = true;
    if (thread.joinable()) thread.join();
  }
  void joinServer() {
    if (thread.joinable()) thread.join();
  }
  void connect() {
    startServer(fluid);
    client = std::make_unique<RosParticipant>(node, fluid, run);
    client->connect();
  }
  static Request request(std::uint32_t step, std::uint32_t iteration, Phase phase) {
    Request out;
    out.key = {42, step, iteration, phase};
    out.t = 0.1 * step;
    return out;
  }
  static std::string failureOf(Participant& participant, const Request& request) {
    try {
      participant.exchange(request);
    } catch (const ExchangeError& e) {
      return e.what();
    }
    return "";
  }
  static std::string uniqueNamespace() {
    static int count = 0;
    return "/lockstep_" + std::to_string(++count);
  }
  // Publishes on a topic of the fluid once its listener is there.
  template <class Message>
  ros::Publisher injector(const std::string& name) {
    ros::Publisher out = node.advertise<Message>("fluid/" + name, 8);
    for (int i = 0; i < 200 && out.getNumSubscribers() == 0; ++i) ros::WallDuration(0.01).sleep();
    EXPECT_GT(out.getNumSubscribers(), 0u);
    return out;
  }
  // A message for a topic of the fluid with the seal of the run.
  template <class Message>
  Message sealed(const std::string& name, Message message) const {
    fluid.token.seal(node.resolveName("fluid/" + name), message);
    return message;
  }
  // Waits until a value has been reached.
  template <class Condition>
  static bool eventually(Condition condition, double limit_s = 5.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(limit_s);
    while (!condition() && ros::WallTime::now() < end) ros::WallDuration(0.01).sleep();
    return condition();
  }

  LockstepIdentity fluid{Role::kFluid, "climb", kSha, Token("secret")};
  LockstepLimits server_limits = shortLimits();
  ros::NodeHandle node;
  StopFlag stop{false}, server_stop{false};
  LockstepRun run;
  ScriptedSolver solver;
  std::unique_ptr<LockstepServer> server;
  std::unique_ptr<RosParticipant> client;
  std::thread thread;
  std::string server_end;
};

}  // namespace monarch_flight
