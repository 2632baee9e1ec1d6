#!/usr/bin/python3
"""What a person may type wrongly: one clear message, a non-zero exit code, nothing written."""
import os
import signal
import subprocess
import unittest

import flying
from monarch_flight.runs import master


class WrongInput(flying.FlightTest):
    def refused(self, *arguments):
        """Output of a command that must be refused at once."""
        code, output = self.fly(*arguments, limit=30)
        self.assertEqual(code, 2, output)
        self.assertIn("scripts/fly --help says what is allowed", output)
        self.assertNotIn("build:", output)
        return output

    def test_wrong_keys_and_values_are_named_all_at_once(self):
        output = self.refused("flapps:=2", "grid", "fluid:=water", "flaps:=-1", "record:=yes",
                              "ranks:=0", "steps_per_flap:=0.5", "rviz:=true", "flaps:=2")
        for fault in ("unknown key 'flapps'; did you mean 'flaps'?", "'grid' is not of the form key:=value",
                      "fluid:=water: must be navier_stokes or quasi_steady", "record:=yes",
                      "ranks:=0", "steps_per_flap:=0.5", "no display", "'flaps' is given twice"):
            self.assertIn(fault, output)

    def test_missing_case(self):
        output = self.refused("case:=" + self.out("nowhere.yaml"))
        self.assertIn("nowhere.yaml: neither a shipped case", output)
        self.assertIn("climb_fwuav", output)

    def test_earlier_results_are_not_overwritten(self):
        os.mkdir(self.out())
        with open(self.out() + "/precious", "w") as f:
            f.write("x")
        self.assertIn("holds something already", self.refused("out:=" + self.out()))
        self.assertEqual(os.listdir(self.out()), ["precious"])

    def test_a_folder_that_cannot_be_made(self):
        for keys in (["in_process:=true"], []):
            code, output = self.fly("fluid:=quasi_steady", "flaps:=1", "out:=/proc/nowhere", *keys)
            self.assertEqual(code, 2, output)
            self.assertIn("out = /proc/nowhere: cannot be created", output)

    def test_a_folder_that_is_no_run(self):
        output = self.refused("resume:=" + self.out("nowhere"))
        self.assertIn("nowhere: not the folder of a run (it has no case.yaml)", output)
        self.assertEqual(output.count("fly: "), 2, output)  # and where help is

    def test_plan_tells_and_writes_nothing(self):
        code, output = self.fly("case:=tethered_fwuav", "plan:=true", "out:=" + self.out())
        self.assertEqual(code, 0, output)
        self.assertNotIn("may end on it", output)
        for word in ("million cells", "cells a mean chord", "Courant number", "memory:", "time: set-up"):
            self.assertIn(word, output)
        self.assertFalse(os.path.exists(self.out()))

    def test_plan_says_how_many_steps_it_takes(self):
        code, output = self.fly("case:=tethered_fwuav", "steps_per_flap:=130", "plan:=true")
        self.assertEqual(code, 0, output)
        self.assertRegex(output, r"this run may end on it; take .*steps_per_flap >= \d+")

    def test_plan_refuses_what_cannot_be(self):
        code, output = self.fly("case:=tethered_fwuav", "plan:=true", "ranks:=1000", "out:=" + self.out())
        self.assertEqual(code, 2, output)
        self.assertIn("ranks = 1000: must be at most", output)

    def test_quasi_steady_air_has_no_fields(self):
        code, output = self.fly("fluid:=quasi_steady", "fields_every:=5", "in_process:=true", "out:=" + self.out())
        self.assertEqual(code, 2, output)
        self.assertIn("output/fields_every = 5: quasi_steady has no flow field", output)
        self.assertFalse(os.path.exists(self.out()))

    def bad_case(self):
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_printed.yaml")) as f:
            text = f.read()
        path = os.path.join(self.folder, "bad.yaml")
        with open(path, "w") as f:
            f.write(text.replace("  preset: monarch_paper",
                                 "  preset: monarch_paper\n  body: {mass: -1}")
                    .replace("  flaps: 2", "  flaps: 2\n  flapps: 3"))
        return path

    def check_case_faults(self, *keys):
        code, output = self.fly("case:=" + self.bad_case(), "fluid:=quasi_steady",
                                "out:=" + self.out(), *keys)
        self.assertEqual(code, 2, output)
        self.assertIn("insect/body/mass = -1", output)
        self.assertRegex(output, r"time/flapps is not a known key: .*; did you mean 'flaps'\?")
        self.assertFalse(os.path.exists(self.out()))

    def test_faults_of_the_case_file_in_one_process(self):
        self.check_case_faults("in_process:=true")

    def test_faults_of_the_case_file_with_nodes(self):
        self.check_case_faults()

    def test_second_run_on_the_same_master(self):
        core = subprocess.Popen(
            ["roscore", "-p", self.master.rsplit(":", 1)[1]], stdout=subprocess.DEVNULL,
            env=self.environment(ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost",
                                 PATH="/usr/bin:" + os.environ["PATH"]))
        self.addCleanup(self.end, core)
        self.wait_for(lambda: master.answers(self.master), 30, "roscore")
        common = dict(ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost")
        first = self.start("case:=tethered_fwuav", "fluid:=quasi_steady", "flaps:=2000",
                           "out:=" + self.out("first"), **common)
        table = os.path.join(self.out("first"), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table), 120, "the first flight to begin")
        code, output = self.fly("fluid:=quasi_steady", "flaps:=1", "out:=" + self.out("second"),
                                **common)
        self.assertEqual(code, 1, output)
        self.assertIn("a flight is running on %s already" % self.master, output)
        self.assertFalse(os.path.exists(self.out("second")))
        size = os.path.getsize(table)  # the first has not been disturbed
        self.wait_for(lambda: os.path.getsize(table) > size, 30, "the first flight to go on")
        first.send_signal(signal.SIGINT)
        code, output = self.finish(first, 60)
        self.assertEqual(code, 130, output)
        # roslaunch interrupts its nodes one after the other: the coordinator may see a solver go first.
        self.assertRegex(flying.summary(self.out("first"))["failure"], "interrupted|is lost")


if __name__ == "__main__":
    unittest.main()
