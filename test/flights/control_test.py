#!/usr/bin/python3
"""A person leads a flight: every service and the action fly on one run of real nodes."""
import os
import sys
import threading
import unittest

import flying
import leading

# Long enough that a goal is cancelled before the run is over.
KEYS = ("case:=climb_trimmed", "fluid:=quasi_steady", "flaps:=4", "steps_per_flap:=500")
STEPS = 2000


class Listener:
    """What the run publishes."""

    def __init__(self):
        import rospy
        from monarch_flight.msg import FlightState
        from rosgraph_msgs.msg import Clock
        from tf2_msgs.msg import TFMessage
        self.clock, self.steps, self.stamps = [], [], []
        # The latched topics bring the newest message to who comes late.
        self.subscribers = [
            rospy.Subscriber("/clock", Clock, lambda m: self.clock.append(m.clock), queue_size=1000),
            rospy.Subscriber("/monarch_flight/state", FlightState,
                             lambda m: self.steps.append(m.step), queue_size=1000),
            rospy.Subscriber("/tf", TFMessage,
                             lambda m: self.stamps.extend(t.header.stamp for t in m.transforms),
                             queue_size=1000)]


class Control(leading.Leader):
    def test_every_service_and_the_action(self):
        process = self.start(*KEYS, "paused:=true", "out:=" + self.out(),
                             ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost")
        self.assertEqual(self.good("pause"), "held after step 0")
        listener = Listener()
        self.wait_for(lambda: listener.clock and listener.stamps, 10, "the latched clock and pose")
        self.check_single_steps(listener)
        self.check_checkpoint()
        self.check_action(listener)
        self.check_reset(listener)
        self.good("resume")
        code, output = self.finish(process, 180)
        self.assertEqual(code, 0, output)
        self.check_same_flight()

    def check_single_steps(self, listener):
        self.assertIn("held after step 12", self.good("step", 12))
        self.wait_for(lambda: listener.steps[-1:] == [12], 10, "step 12")
        self.assertEqual(listener.steps, list(range(1, 13)))
        self.assertEqual(self.good("sub_iterate"),
                         "held after step 12, sub-iteration 0 of step 13")
        for _ in range(60):
            if self.good("sub_iterate") == "held after step 13":
                break
        else:
            self.fail("60 sub-iterations have not brought step 13 to its end")
        self.assertIn("must be at least 1", self.call("step", 0).message)
        before = len(listener.clock)
        self.good("pause")
        self.wait_for(lambda: listener.steps[-1:] == [13], 10, "step 13")
        threading.Event().wait(1.0)  # a held run publishes nothing
        self.assertLessEqual(len(listener.clock), before + 1)
        self.assertEqual(listener.clock, sorted(listener.clock))

    def check_checkpoint(self):
        """Of a held run, between two steps and inside one."""
        manifest = self.out() + "/checkpoints/step_0000000013/manifest.json"
        self.assertFalse(os.path.exists(manifest))
        self.assertEqual(self.good("checkpoint"), "checkpoint of step 13; held after step 13")
        self.assertTrue(os.path.exists(manifest))
        self.good("sub_iterate")
        self.assertEqual(self.good("checkpoint"),
                         "checkpoint of step 13; held after step 13, sub-iteration 0 of step 14")

    def check_action(self, listener):
        from monarch_flight.msg import FlyAction, FlyGoal
        import actionlib
        from actionlib_msgs.msg import GoalStatus
        client = actionlib.SimpleActionClient("/monarch_flight/fly", FlyAction)
        self.assertTrue(client.wait_for_server(flying_duration(20)))
        feedback = []

        def fly(until):
            client.send_goal(FlyGoal(until_step=until), feedback_cb=feedback.append)
            return client

        self.assertTrue(fly(60).wait_for_result(flying_duration(30)))
        self.assertEqual(client.get_state(), GoalStatus.SUCCEEDED, client.get_goal_status_text())
        self.assertEqual((client.get_result().step, client.get_result().complete), (60, False))
        self.wait_for(lambda: feedback, 10, "feedback")
        self.assertGreater(feedback[0].step, 13)
        self.assertGreaterEqual(feedback[0].time_left_s, 0)
        self.assertAlmostEqual(feedback[0].flap, feedback[0].step / 500, delta=1e-9)
        self.assertGreaterEqual(feedback[0].sub_iterations, 1)
        # Lies behind. actionlib's Python client misses an answer that comes before it has noted its goal.
        self.assertTrue(any(fly(50).wait_for_result(flying_duration(5)) for _ in range(6)))
        self.assertEqual(client.get_state(), GoalStatus.REJECTED)
        self.assertIn("from 61 to %d" % STEPS, client.get_goal_status_text())
        fly(0)
        self.wait_for(lambda: listener.steps[-1] > 60, 30, "a step of the new goal")
        self.assertIn("; flying after step ", self.good("checkpoint"))
        client.cancel_goal()
        self.assertTrue(client.wait_for_result(flying_duration(30)))
        self.assertEqual(client.get_state(), GoalStatus.PREEMPTED, client.get_goal_status_text())
        self.assertIn("held after step", client.get_result().message)
        self.wait_for(lambda: listener.steps[-1:] == [client.get_result().step], 10, "the last step")
        self.assertEqual(listener.steps, list(range(1, listener.steps[-1] + 1)))

    def check_reset(self, listener):
        self.good("sub_iterate")  # in the middle of a step
        threading.Event().wait(1.0)  # poses of the last step, of other nodes too, are still on their way
        del listener.steps[:], listener.clock[:], listener.stamps[:]
        self.assertEqual(self.good("reset"), "held after step 0")
        self.wait_for(lambda: listener.steps and listener.clock and listener.stamps, 10, "level 0")
        self.assertEqual(listener.steps, [0])
        self.assertEqual([t.to_nsec() for t in listener.clock], [10**9])
        self.assertEqual({t.to_nsec() for t in listener.stamps}, {10**9})
        self.assertIn("held after step 3", self.good("step", 3))
        self.wait_for(lambda: listener.steps[-1:] == [3], 10, "step 3")
        dt = 1 / 10.2 / 500
        for step, stamp in enumerate(listener.clock):
            self.assertAlmostEqual(stamp.to_sec(), 1 + step * dt, delta=2e-9)

    def check_same_flight(self):
        """Neither pauses nor the reset have left a trace in the flight or in its files."""
        import rosbag
        code, output = self.fly(*KEYS, "in_process:=true", "out:=" + self.out("undisturbed"))
        self.assertEqual(code, 0, output)
        led, undisturbed = flying.summary(self.out()), flying.summary(self.out("undisturbed"))
        self.assertEqual(led["state_sha256"], undisturbed["state_sha256"])
        self.assertEqual(led["steps"], STEPS)
        self.assertEqual(flying.table(self.out(), "flight.csv"),
                         flying.table(self.out("undisturbed"), "flight.csv"))
        with rosbag.Bag(self.out() + "/flight.bag") as bag:
            steps = [m.step for _, m, _ in bag.read_messages(["/monarch_flight/state"])]
        self.assertEqual(steps, list(range(STEPS + 1)))


def flying_duration(seconds):
    import rospy
    return rospy.Duration(seconds)


if __name__ == "__main__":
    sys.exit(unittest.main())
