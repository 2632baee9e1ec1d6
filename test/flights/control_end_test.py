#!/usr/bin/python3
"""A person leads a flight to its very end: the last step counts like every other."""
import sys
import unittest

import flying
import leading

KEYS = ("case:=climb_trimmed", "fluid:=quasi_steady", "flaps:=0.1", "steps_per_flap:=500", "paused:=true")
STEPS = 50


class ControlEnd(leading.Leader):
    def test_the_last_step(self):
        self.check_steps("all", STEPS)
        self.check_steps("beyond", STEPS + 1)
        self.check_action("to_the_end", 0)
        self.check_action("to_the_last_step", STEPS)

    def begin(self, name):
        process = self.start(*KEYS, "out:=" + self.out(name), ROS_MASTER_URI=self.master,
                             ROS_HOSTNAME="localhost")
        self.assertEqual(self.good("pause"), "held after step 0")
        return process

    def check_end(self, process, name):
        code, output = self.finish(process, 60)
        self.assertEqual(code, 0, output)
        self.assertEqual(flying.summary(self.out(name))["steps"], STEPS)

    def check_steps(self, name, asked):
        process = self.begin(name)
        answer = self.call("step", asked)
        self.assertEqual(answer.step, STEPS)
        self.assertEqual(answer.success, asked == STEPS, answer.message)
        self.assertEqual(answer.message, "the run is over: complete")
        self.check_end(process, name)

    def check_action(self, name, until):
        import actionlib
        import rospy
        from actionlib_msgs.msg import GoalStatus
        from monarch_flight.msg import FlyAction, FlyGoal
        process = self.begin(name)
        client = actionlib.SimpleActionClient("/monarch_flight/fly", FlyAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(20)))
        client.send_goal(FlyGoal(until_step=until))
        self.assertTrue(client.wait_for_result(rospy.Duration(30)))
        self.assertEqual(client.get_state(), GoalStatus.SUCCEEDED, client.get_goal_status_text())
        result = client.get_result()
        self.assertEqual((result.step, result.complete), (STEPS, True), result.message)
        self.check_end(process, name)


if __name__ == "__main__":
    sys.exit(unittest.main())
