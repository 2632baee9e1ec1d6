#!/usr/bin/python3
"""A controlled flight through a gust that stands in its way goes on, and is flown again, bit for bit."""
import os
import unittest

import yaml

import flying

FLAP = 100  # steps; the first flap follows the motion


class ControlledGust(flying.FlightTest):
    def case(self):
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_controlled.yaml")) as f:
            case = yaml.safe_load(f)
        case["fluid"]["wind"] = {"gusts": [
            {"kind": "place", "start": 0.15, "length": 0.4, "amplitude": [-0.2, 0, 0.1]}]}
        path = os.path.join(self.folder, "gust.yaml")
        with open(path, "w") as f:
            yaml.safe_dump(case, f)
        return ("case:=" + path, "fluid:=quasi_steady", "steps_per_flap:=%d" % FLAP)

    def complete(self, name, *keys):
        code, output = self.fly(*keys, "in_process:=true", "record:=false")
        self.assertEqual(code, 0, output)
        self.assertEqual(flying.summary(self.out(name))["status"], "complete", output)

    def test_resumed_in_the_gust_and_flown_again(self):
        case = self.case()
        self.complete("whole", *case, "flaps:=4", "out:=" + self.out("whole"))
        self.complete("cut", *case, "flaps:=2.35", "out:=" + self.out("cut"))
        columns, rows = flying.table(self.out("cut"), "flight.csv")
        self.assertNotEqual(rows[-1][columns.index("wx")], 0)  # in the gust
        self.complete("cut", "resume:=" + self.out("cut"), "flaps:=4")
        self.complete("again", "replay:=" + self.out("whole"), "out:=" + self.out("again"))
        whole = flying.table(self.out("whole"), "flight.csv")
        for name in ("cut", "again"):
            self.assertEqual(flying.summary(self.out(name))["state_sha256"],
                             flying.summary(self.out("whole"))["state_sha256"], name)
            self.assertEqual(flying.table(self.out(name), "flight.csv"), whole, name)
        self.assertEqual(flying.summary(self.out("cut"))["resumed"][0]["step"], 235)
        columns, rows = whole
        led = [row[columns.index("command_amplitude")] for row in rows]
        self.assertGreater(len(set(led[2 * FLAP:])), 10)  # the controller answers


if __name__ == "__main__":
    unittest.main()
