#!/usr/bin/python3
"""Independent wings over nodes: a fluid for each, all six degrees of freedom, a damaged left wing."""
import glob
import os
import re
import signal
import unittest

import yaml

import flying

KEYS = ("fluid:=quasi_steady", "flaps:=0.6", "steps_per_flap:=400", "checkpoint_every:=50")


class TwoWings(flying.FlightTest):
    def case(self):
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_printed.yaml")) as f:
            case = yaml.safe_load(f)
        case["wings"] = "independent"
        case["free"].update(y=True, roll=True, yaw=True)
        case["insect"]["left_wing"] = {"tip_lost": 0.2}
        path = os.path.join(self.folder, "damaged.yaml")
        with open(path, "w") as f:
            yaml.safe_dump(case, f)
        return "case:=" + path

    def test_lost_left_fluid_is_named_and_the_flight_goes_on(self):
        case = self.case()
        code, output = self.fly(case, *KEYS, "in_process:=true", "out:=" + self.out("whole"))
        self.assertEqual(code, 0, output)
        process = self.start(case, *KEYS, "out:=" + self.out("cut"), MONARCH_ANSWER_DELAY_MS="6")
        self.wait_for(lambda: glob.glob(self.out("cut") + "/checkpoints/step_0000000[0-9]?0"), 120,
                      "a checkpoint; so far: " + self.output(process))
        pids = dict(re.findall(r"process\[monarch_flight/(\w+)-\d+\]: started with pid \[(\d+)\]",
                               self.output(process)))
        self.assertEqual(set(pids), {"coordinator", "fluid", "fluid_left", "flight", "wing"})
        os.kill(int(pids["fluid_left"]), signal.SIGKILL)
        code, output = self.finish(process, 60)
        self.assertNotIn(code, (0, 130), output)
        self.assertIn("the fluid_left node", flying.summary(self.out("cut"))["failure"])
        code, output = self.fly("resume:=" + self.out("cut"))
        self.assertEqual(code, 0, output)
        whole, cut = (flying.summary(self.out(name)) for name in ("whole", "cut"))
        self.assertEqual(cut["state_sha256"], whole["state_sha256"])
        columns, rows = flying.table(self.out("cut"), "flight.csv")
        self.assertEqual((columns, rows), flying.table(self.out("whole"), "flight.csv"))
        self.assertGreater(abs(rows[-1][columns.index("roll")]), 0.01)  # it does roll
        self.assertNotEqual(rows[-1][columns.index("fz")], rows[-1][columns.index("fz_L")])

    def test_refused(self):
        for keys, words in (
                (("wings:=sideways",), "wings:=sideways: must be mirrored or independent"),
                ((self.case(), "wings:=mirrored"), "left_wing: must not be given while one wing is")):
            code, output = self.fly(*keys, "in_process:=true" if "case" in keys[0] else "flaps:=1")
            self.assertEqual(code, 2, output)
            self.assertIn(words, output)


if __name__ == "__main__":
    unittest.main()
