#!/usr/bin/python3
"""A node that is lost in flight ends the run: soon, with its name, and with a non-zero exit code."""
import glob
import os
import re
import signal
import subprocess
import unittest

import flying

CASE = "tethered_fwuav"
LIMIT = 60.0  # seconds: the watchdog of the shipped cases


class LostNode(flying.FlightTest):
    def airborne(self, case=CASE):
        """A long flight under way, and the process ids of its nodes."""
        process = self.start("case:=" + case, "fluid:=quasi_steady", "flaps:=2000",
                             "out:=" + self.out())
        table = os.path.join(self.out(), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table) and os.path.getsize(table) > 20000, 120,
                      "the flight to begin; so far: " + self.output(process))
        pids = dict(re.findall(r"process\[monarch_flight/(\w+)-\d+\]: started with pid \[(\d+)\]",
                               self.output(process)))
        self.assertEqual(set(pids), {"coordinator", "fluid", "flight", "wing"})
        return process, {name: int(pid) for name, pid in pids.items()}

    def assert_ended(self, pids):
        for name, pid in pids.items():
            try:
                with open("/proc/%d/stat" % pid) as f:
                    state = f.read().rpartition(")")[2].split()[0]
            except OSError:
                continue
            self.assertEqual(state, "Z", name + " is still there")  # an orphan that nobody asked about

    def kill(self, name):
        process, pids = self.airborne()
        os.kill(pids[name], signal.SIGKILL)
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)
        self.assertIn("fly: the node monarch_flight/%s died" % name, output)
        self.assert_ended(pids)
        return output

    def kill_solver(self, name):
        output = self.kill(name)
        summary = flying.summary(self.out())
        self.assertEqual(summary["status"], "failed")
        self.assertIn("the %s node" % name, summary["failure"])
        self.assertRegex(summary["failure"], r"step \d+, sub-iteration \d+, (ITERATE|COMMIT)")
        self.assertIn(summary["failure"], output)
        self.assertEqual(glob.glob(self.out() + "/*.active"), [])

    def test_fluid(self):
        self.kill_solver("fluid")

    def test_flight(self):
        self.kill_solver("flight")

    def test_wing(self):
        self.kill_solver("wing")

    def test_coordinator(self):
        self.kill("coordinator")
        self.assertFalse(os.path.exists(self.out() + "/summary.json"))
        self.assertFalse(os.path.exists(self.out() + "/flight.bag"))  # half a bag has another name

    def test_launcher(self):
        """What the launcher leaves behind when it is killed is ended, and its last step kept."""
        process, pids = self.airborne()
        launcher = subprocess.run(["pgrep", "-f", "runs.launcher.*" + re.escape(self.out())], check=True,
                                  capture_output=True, text=True).stdout.split()
        for pid in launcher:
            os.kill(int(pid), signal.SIGKILL)
        code, output = self.finish(process, LIMIT)
        self.assertNotEqual(code, 0, output)
        self.assertIn("fly: the launcher is gone; ending its nodes", output)
        self.assert_ended(pids)
        self.assertIn("is the last one committed", flying.summary(self.out())["failure"])

    def test_frozen_node_meets_the_watchdog(self):
        """A node that lives but does not answer: found by the time limit, here 3 s."""
        with open(os.path.join(flying.ROOT, "config", "cases", CASE + ".yaml")) as f:
            text = f.read() + "\nwatchdog_s: 3\n"
        case = os.path.join(self.folder, "impatient.yaml")
        with open(case, "w") as f:
            f.write(text)
        process, pids = self.airborne(case)
        os.kill(pids["wing"], signal.SIGSTOP)
        self.addCleanup(self.go_on, pids["wing"])
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)
        failure = flying.summary(self.out())["failure"]
        self.assertIn("the wing node", failure)
        self.assertIn("within 3.0 s (watchdog)", failure)

    def test_interrupt_ends_cleanly(self):
        process, pids = self.airborne()
        process.send_signal(signal.SIGINT)
        code, output = self.finish(process, LIMIT)
        self.assertEqual(code, 130, output)
        self.assert_ended(pids)
        self.assertEqual(flying.summary(self.out())["status"], "failed")
        self.assertEqual(glob.glob(self.out() + "/*.active"), [])


if __name__ == "__main__":
    unittest.main()
