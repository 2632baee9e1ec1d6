#!/usr/bin/python3
"""Ctrl-C: what is said fits what there is to go on with."""
import os
import signal
import unittest

import flying

KEYS = ("case:=climb_printed", "fluid:=quasi_steady")
NOTHING = "stopped by hand before the first step: nothing was flown"


class Stopped(flying.FlightTest):
    def stop(self, process):
        process.send_signal(signal.SIGINT)
        code, output = self.finish(process, 60)
        self.assertEqual(code, 130, output)
        return output

    def begun(self, process, word):
        self.wait_for(lambda: word in self.output(process), 60, word)

    def check_nothing(self, output):
        self.assertIn(NOTHING, output)
        self.assertNotIn("resume:=", output)

    def test_before_there_is_a_folder(self):
        process = self.start(*KEYS, "out:=" + self.out())
        self.begun(process, "started roslaunch server")
        output = self.stop(process)
        if not os.path.exists(self.out()):
            self.check_nothing(output)

    def test_held_at_the_start(self):
        process = self.start(*KEYS, "paused:=true", "out:=" + self.out())
        self.begun(process, "results in " + self.out())
        self.check_nothing(self.stop(process))
        self.assertEqual(flying.summary(self.out())["steps"], 0)

    def fly_and_stop(self, *keys):
        process = self.start(*KEYS, "in_process:=true", "record:=false", "flaps:=2000", "out:=" + self.out(), *keys)
        table = os.path.join(self.out(), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table) and os.path.getsize(table) > 10000, 60, "some steps")
        output = self.stop(process)
        self.assertGreater(flying.summary(self.out())["steps"], 0)
        self.assertNotIn(NOTHING, output)
        return output

    def test_in_flight(self):
        self.assertIn("goes on with scripts/fly resume:=" + self.out(), self.fly_and_stop())

    def test_in_flight_without_checkpoints(self):
        output = self.fly_and_stop("checkpoint_every:=0")
        self.assertIn("has no checkpoint to go on from", output)
        self.assertNotIn("resume:=", output)


if __name__ == "__main__":
    unittest.main()
