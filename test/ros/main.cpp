// Of every ROS test: a node on the master of with_master.py, for as long as the tests run.
#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "ros_test");
  ros::NodeHandle keep;
  return RUN_ALL_TESTS();
}
