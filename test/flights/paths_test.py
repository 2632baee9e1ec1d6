#!/usr/bin/python3
"""Spaces and apostrophes in the names of every folder that a flight meets."""
import os
import shutil
import unittest

import flying

KEYS = ("fluid:=quasi_steady", "flaps:=0.1")


class Paths(flying.FlightTest):
    def setUp(self):
        super().setUp()
        self.place = os.path.join(self.folder, "it's a place")
        os.mkdir(self.place)
        shutil.copy(os.path.join(flying.ROOT, "config", "cases", "climb_printed.yaml"), self.place + "/it's mine.yaml")

    def complete(self, name, *keys):
        """Flown in the odd place, with a home of ROS like it."""
        home = os.path.join(self.folder, "it's ROS")
        code, output = self.fly(*keys, ROS_HOME=home, ROS_LOG_DIR=home + "/its log")
        self.assertEqual(code, 0, output)
        return flying.summary(os.path.join(self.place, name))["state_sha256"]

    def environment(self, **more):
        return dict(super().environment(), **more)

    def test_over_nodes_and_again(self):
        first = self.complete("it's flown", "case:=it's mine.yaml", *KEYS, "out:=it's flown")
        again = self.complete("it's again", "replay:=it's flown", "out:=it's again")
        self.assertEqual(first, again)
        further = self.complete("it's flown", "resume:=it's flown", "flaps:=0.2")
        self.assertNotEqual(further, first)

    def test_in_process(self):
        self.complete("it's flown", "case:=it's mine.yaml", *KEYS, "out:=it's flown", "in_process:=true")


if __name__ == "__main__":
    unittest.main()
