#!/usr/bin/python3
"""A flight over nodes that is killed in the middle goes on and is the same flight: files and bag."""
import glob
import os
import re
import signal
import unittest

import rosbag

import flying

KEYS = ("case:=climb_printed", "fluid:=quasi_steady", "flaps:=1", "steps_per_flap:=400",
        "checkpoint_every:=50")


def messages(folder):
    """(topic, time, message) of a bag without what is measured by a clock."""
    rows = []
    with rosbag.Bag(os.path.join(folder, "flight.bag")) as bag:
        for topic, message, t in bag.read_messages():
            if topic == "/diagnostics":
                continue
            if topic == "/monarch_flight/state":
                message.computing, message.exchange_s, message.coupling_s = None, 0.0, 0.0
            for row in message.rows if topic == "/monarch_flight/iterations" else ():
                row.fluid_wall_s = 0.0
            rows.append((topic, t.to_nsec(), message))
    return rows


class Resume(flying.FlightTest):
    def whole(self):
        code, output = self.fly(*KEYS, "in_process:=true", "out:=" + self.out("whole"))
        self.assertEqual(code, 0, output)

    def airborne(self, *keys, **environment):
        """A flight with a checkpoint or two, and the process ids of its nodes."""
        process = self.start(*KEYS, *keys, "out:=" + self.out("cut"), **environment)
        self.wait_for(lambda: glob.glob(self.out("cut") + "/checkpoints/step_0000000[1-3]?0"), 120,
                      "a checkpoint; so far: " + self.output(process))
        return process, {name: int(pid) for name, pid in re.findall(
            r"process\[monarch_flight/(\w+)-\d+\]: started with pid \[(\d+)\]",
            self.output(process))}

    def assert_same_flight(self):
        whole, cut = self.out("whole"), self.out("cut")
        self.assertEqual(flying.summary(cut)["state_sha256"], flying.summary(whole)["state_sha256"])
        for name in ("flight.csv", "case.yaml"):
            with open(os.path.join(whole, name)) as a, open(os.path.join(cut, name)) as b:
                self.assertEqual(a.read(), b.read(), name)
        a, b = messages(whole), messages(cut)
        self.assertEqual(len(a), len(b))
        different = next((pair for pair in zip(a, b) if pair[0] != pair[1]), None)
        self.assertIsNone(different)  # not the lists: a difference of thousands of messages takes hours

    # Delays make the flight long enough to be hit in the middle, and are the test of their own that
    # the time at which answers come changes nothing.
    def test_killed_node_and_delayed_answers(self):
        self.whole()
        process, pids = self.airborne(MONARCH_ANSWER_DELAY_MS="6")
        os.kill(pids["coordinator"], signal.SIGKILL)
        code, output = self.finish(process, 60)
        self.assertNotIn(code, (0, 130), output)
        code, output = self.fly("resume:=" + self.out("cut"), MONARCH_ANSWER_DELAY_MS="3")
        self.assertEqual(code, 0, output)
        self.assertRegex(output, r"goes on after step [1-3]\d0")
        self.assert_same_flight()

    def test_interrupted_flight_keeps_its_last_step(self):
        self.whole()
        process, _ = self.airborne(MONARCH_ANSWER_DELAY_MS="6")
        process.send_signal(signal.SIGINT)
        code, output = self.finish(process, 60)
        self.assertEqual(code, 130, output)
        failure = flying.summary(self.out("cut"))["failure"]
        kept = re.match(r"interrupted in step \d+; step (\d+) is the last one committed$", failure)
        self.assertTrue(kept, failure)
        code, output = self.fly("resume:=" + self.out("cut"), "in_process:=true")
        self.assertEqual(code, 0, output)
        self.assertIn("goes on after step " + kept.group(1), output)
        self.assert_same_flight()

    def test_refused_resumption_changes_nothing(self):
        self.whole()
        before = flying.summary(self.out("whole"))
        code, output = self.fly("resume:=" + self.out("whole"), "steps_per_flap:=500")
        self.assertNotEqual(code, 0)
        self.assertIn("time/steps_per_flap: 400 -> 500", output)
        self.assertEqual(flying.summary(self.out("whole")), before)
        code, output = self.fly("resume:=" + self.out("whole"), "out:=" + self.out("other"))
        self.assertEqual(code, 2)
        self.assertIn("goes on in its own folder", output)


if __name__ == "__main__":
    unittest.main()
