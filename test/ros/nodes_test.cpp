// The executables as a person runs them: whole flights, killed and hung nodes, wrong parameters.
#include "ros/nodes_fixture.h"

namespace monarch_flight {
namespace {

TEST_F(Nodes, FlyLikeOneProcessBitForBit) {
  startAll();
  EXPECT_EQ(0, coordinator->wait(40.0)) << coordinator->output();
  EXPECT_EQ(0, fluid->wait(5.0)) << fluid->output();
  EXPECT_EQ(0, flight->wait(5.0)) << flight->output();
  EXPECT_EQ(0, wing->wait(5.0)) << wing->output();
  Process alone(
      std::string(NODE_DIR) + "/fly_in_process",
      {"case:=climb_printed", "fluid:=quasi_steady", "flaps:=0.1", "out:=" + (folder / "alone")},
      folder / "alone.log");
  EXPECT_EQ(0, alone.wait(20.0)) << alone.output();
  const nlohmann::json nodes = summary(), process = summary("alone");
  EXPECT_EQ("complete", nodes["status"]);
  EXPECT_EQ(50, nodes["steps"]);
  EXPECT_EQ(process["state_sha256"], nodes["state_sha256"]);
  EXPECT_EQ(process["added_mass"], nodes["added_mass"]);
  EXPECT_EQ(process["case_sha256"], nodes["case_sha256"]);
  EXPECT_EQ(fileText(folder / "alone/flight.csv"), fileText(folder / "run/flight.csv"));
}

TEST_F(Nodes, ARateHoldsTheFlightBack) {
  ros::param::set("/monarch_flight/rate", 0.004);
  startAll();
  ASSERT_TRUE(coordinator->prints("results in", 20.0)) << coordinator->output();
  const ros::WallTime begin = ros::WallTime::now();
  EXPECT_EQ(0, coordinator->wait(60.0)) << coordinator->output();
  // Almost a tenth of a flap, which takes 0.098 s.
  EXPECT_GT((ros::WallTime::now() - begin).toSec(), 0.009 / 0.004);
}

TEST_F(Nodes, TheFirstStepWaitsForRviz) {
  ros::param::set("/monarch_flight/rviz", true);
  startAll();
  ASSERT_TRUE(coordinator->prints("waiting for rviz", 20.0)) << coordinator->output();
  EXPECT_FALSE(coordinator->prints("flight complete", 3.0));
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = "/rviz";
  request[1] = "/monarch_flight/path";
  request[2] = "nav_msgs/Path";
  request[3] = "http://localhost:1/";
  ASSERT_TRUE(ros::master::execute("registerSubscriber", request, response, payload, false));
  EXPECT_EQ(0, coordinator->wait(20.0)) << coordinator->output();
  EXPECT_FALSE(contains(coordinator->output(), "begins without it"));
  XmlRpc::XmlRpcValue leave;
  leave[0] = request[0];
  leave[1] = request[1];
  leave[2] = request[3];
  EXPECT_TRUE(ros::master::execute("unregisterSubscriber", leave, response, payload, false));
}

TEST_F(Nodes, AKilledNodeEndsTheRunAtOnceAndIsNamed) {
  startLongFlight();
  wing->send(SIGKILL);
  const ros::WallTime begin = ros::WallTime::now();
  EXPECT_EQ(1, coordinator->wait(10.0)) << coordinator->output();
  EXPECT_LT((ros::WallTime::now() - begin).toSec(), 5.0);
  EXPECT_TRUE(contains(coordinator->output(), "the wing node (/monarch_flight/wing) is lost"))
      << coordinator->output();
  EXPECT_EQ("failed", summary()["status"]);
  EXPECT_TRUE(contains(summary()["failure"], "the wing node"));
  EXPECT_TRUE(exists(folder / "run/flight.bag"));
  EXPECT_FALSE(exists(folder / "run/flight.bag.active"));
  EXPECT_EQ(0, fluid->wait(5.0)) << fluid->output();  // the coordinator has ended the run in order
  EXPECT_EQ(0, flight->wait(5.0)) << flight->output();
}

TEST_F(Nodes, AHungNodeEndsTheRunByTheWatchdogAndIsNamed) {
  ros::param::set("/monarch_flight/watchdog", 1.5);
  startLongFlight();
  fluid->send(SIGSTOP);
  EXPECT_EQ(1, coordinator->wait(15.0)) << coordinator->output();
  EXPECT_TRUE(
      contains(coordinator->output(), "the fluid node (/monarch_flight/fluid) did not answer step"))
      << coordinator->output();
  EXPECT_TRUE(contains(coordinator->output(), "within 1.5 s (watchdog)"));
  EXPECT_EQ(0, flight->wait(5.0)) << flight->output();
  EXPECT_EQ(0, wing->wait(5.0)) << wing->output();
}

TEST_F(Nodes, AKilledCoordinatorEndsTheSolvers) {
  startLongFlight();
  coordinator->send(SIGKILL);
  for (Process* node : {fluid.get(), flight.get(), wing.get()}) {
    EXPECT_EQ(1, node->wait(5.0)) << node->output();
    EXPECT_TRUE(contains(node->output(), "the coordinator (/monarch_flight/coordinator) is lost"))
        << node->output();
  }
  EXPECT_TRUE(exists(folder / "run/flight.bag.active"));
  EXPECT_FALSE(exists(folder / "run/flight.bag"));
}

TEST_F(Nodes, AnInterruptClosesTheFiles) {
  startLongFlight();
  coordinator->send(SIGINT);
  EXPECT_EQ(130, coordinator->wait(5.0)) << coordinator->output();
  EXPECT_TRUE(contains(coordinator->output(), "interrupted"));
  EXPECT_TRUE(exists(folder / "run/flight.bag"));
  EXPECT_TRUE(exists(folder / "run/flight.csv"));
}

TEST_F(Nodes, ASecondRunIsRefusedAndTheFirstGoesOn) {
  startLongFlight();
  for (const char* name : {"coordinator", "fluid", "flight", "wing"}) {
    const std::unique_ptr<Process> second = start(name, std::string("second_") + name);
    EXPECT_EQ(2, second->wait(10.0)) << second->output();
    EXPECT_TRUE(contains(second->output(), "a run is already going on")) << second->output();
  }
  EXPECT_TRUE(coordinator->running()) << coordinator->output();
  EXPECT_TRUE(fluid->running() && flight->running() && wing->running());
}

TEST_F(Nodes, ADifferentCaseIsRefusedOnBothSides) {
  coordinator = start("coordinator");
  fluid = start("fluid");
  flight = start("flight");
  for (Process* node : {coordinator.get(), fluid.get(), flight.get()}) ASSERT_TRUE(node->running());
  ros::WallDuration(3.0).sleep();  // they have read their parameters
  ros::param::set("/monarch_flight/steps_per_flap", 700);
  wing = start("wing");
  EXPECT_EQ(1, coordinator->wait(10.0)) << coordinator->output();
  EXPECT_TRUE(contains(coordinator->output(), "the wing node (/monarch_flight/wing) refuses"))
      << coordinator->output();
  EXPECT_EQ(1, wing->wait(5.0)) << wing->output();
  EXPECT_TRUE(contains(wing->output(), "handshake refused: case climb")) << wing->output();
  EXPECT_FALSE(exists(folder / "run"));
}

TEST_F(Nodes, EveryWrongParameterIsNamedAtOnce) {
  ros::param::set("/monarch_flight/ranks", -4);
  ros::param::set("/monarch_flight/watchdog", -1);
  ros::param::set("/monarch_flight/flap", 3);
  coordinator = start("coordinator");
  EXPECT_EQ(2, coordinator->wait(10.0));
  const std::string text = coordinator->output();
  EXPECT_TRUE(contains(text, "/monarch_flight/ranks = -4: must be a whole number")) << text;
  EXPECT_TRUE(contains(text, "/monarch_flight/watchdog = -1: must be")) << text;
  EXPECT_TRUE(contains(text, "/monarch_flight/flap: unknown parameter")) << text;
  EXPECT_FALSE(exists(folder / "run"));
}

TEST_F(Nodes, AFolderThatIsInUseIsRefused) {
  startAll();
  EXPECT_EQ(0, coordinator->wait(40.0)) << coordinator->output();
  const std::string before = fileText(folder / "run/flight.csv");
  startAll();
  EXPECT_EQ(2, coordinator->wait(40.0)) << coordinator->output();
  EXPECT_TRUE(contains(coordinator->output(), "must be a new or an empty folder"));
  EXPECT_EQ(before, fileText(folder / "run/flight.csv"));
  EXPECT_EQ(0, wing->wait(5.0)) << wing->output();
}

TEST_F(Nodes, AMissingMasterIsSaid) {
  const std::string master = std::getenv("ROS_MASTER_URI");
  setenv("ROS_MASTER_URI", "http://localhost:1", 1);
  coordinator = start("coordinator");
  setenv("ROS_MASTER_URI", master.c_str(), 1);
  EXPECT_EQ(2, coordinator->wait(10.0));
  EXPECT_TRUE(contains(coordinator->output(), "no ROS master answers at http://localhost:1"));
}

}  // namespace
}  // namespace monarch_flight
