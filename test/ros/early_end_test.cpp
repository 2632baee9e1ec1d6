// Nodes that refuse their input before the flight: the others do not wait for them. Signals and
// plans at the start.
#include <csignal>

#include "ros/nodes_fixture.h"

namespace monarch_flight {
namespace {

class EarlyEnds : public Nodes {
 protected:
  EarlyEnds() {
    for (const char* node : {"coordinator", "fluid", "flight", "wing"})
      ros::param::set(std::string("/monarch_flight/exit_codes/") + node, -1);
  }
  void refused(Process& node, const std::string& whom) {
    EXPECT_EQ(2, node.wait(8.0)) << node.output();
    EXPECT_TRUE(contains(node.output(), whom + " has refused the run")) << node.output();
  }
};

TEST_F(EarlyEnds, OfTheCoordinatorEndsThoseThatWaitForItsToken) {
  ros::param::set("/monarch_flight/token_file", folder / "not yet");
  ros::param::set("/monarch_flight/guidance", "nobody/Nothing");
  startAll();
  EXPECT_EQ(2, coordinator->wait(8.0)) << coordinator->output();
  for (Process* node : {fluid.get(), flight.get(), wing.get()}) refused(*node, "the coordinator");
}

TEST_F(EarlyEnds, OfTheCoordinatorEndsThoseThatWaitForIt) {
  ros::param::set("/monarch_flight/guidance", "nobody/Nothing");
  startAll();
  EXPECT_EQ(2, coordinator->wait(8.0)) << coordinator->output();
  for (Process* node : {fluid.get(), flight.get(), wing.get()}) refused(*node, "the coordinator");
}

TEST_F(EarlyEnds, AFaultOfTheCaseIsToldOnce) {
  const std::string fault = "time/flaps = -1";
  ros::param::set("/monarch_flight/flaps", "-1");
  startAll();
  EXPECT_EQ(2, coordinator->wait(8.0)) << coordinator->output();
  EXPECT_TRUE(contains(coordinator->output(), fault)) << coordinator->output();
  for (Process* node : {fluid.get(), flight.get(), wing.get()}) {
    refused(*node, "the coordinator");
    EXPECT_FALSE(contains(node->output(), fault)) << node->output();
  }
}

TEST_F(EarlyEnds, NodesStartedByHandTellAFaultEach) {
  ros::param::set("/monarch_flight/flaps", "-1");
  ros::param::del("/monarch_flight/exit_codes");  // started by hand
  startAll();
  for (Process* node : {coordinator.get(), fluid.get(), flight.get(), wing.get()}) {
    EXPECT_EQ(2, node->wait(8.0)) << node->output();
    EXPECT_TRUE(contains(node->output(), "time/flaps = -1")) << node->output();
  }
}

TEST_F(EarlyEnds, OfASolverEndsTheRun) {
  ros::param::set("/monarch_flight/ranks", 2);  // it is not started by mpirun
  ros::param::set("/monarch_flight/fluid", "navier_stokes");
  startAll();
  EXPECT_EQ(2, fluid->wait(8.0)) << fluid->output();
  refused(*coordinator, "the fluid node");
  for (Process* node : {flight.get(), wing.get()}) EXPECT_NE(-1, node->wait(8.0)) << node->output();
}

TEST_F(Nodes, SignalsThatWereIgnoredAtTheStartStayIgnored) {
  for (int number : {SIGHUP, SIGINT}) std::signal(number, SIG_IGN);
  startLongFlight();
  for (int number : {SIGHUP, SIGINT}) std::signal(number, SIG_DFL);
  for (int number : {SIGHUP, SIGINT}) coordinator->send(number);
  EXPECT_EQ(-1, coordinator->wait(1.0)) << coordinator->output();
  coordinator->send(SIGTERM);
  EXPECT_EQ(130, coordinator->wait(8.0)) << coordinator->output();
}

TEST_F(Nodes, APlanWithAnUnknownPluginIsRefused) {
  for (const char* key : {"guidance", "fluid"}) {
    Process plan(std::string(NODE_DIR) + "/fly_in_process",
                 {"case:=climb_printed", "plan:=true", std::string(key) + ":=nobody/Nothing"},
                 folder / "plan.log");
    EXPECT_EQ(2, plan.wait(10.0)) << plan.output();
    EXPECT_TRUE(contains(plan.output(), "nobody/Nothing")) << plan.output();
  }
}

}  // namespace
}  // namespace monarch_flight
