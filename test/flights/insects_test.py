#!/usr/bin/python3
"""The insects beside the monarch fly, and lift what docs/insects.md says, in quasi-steady air."""
import os
import re
import unittest

import yaml

import flying

CASES = {"fruit fly, hovering": "hover_fruit_fly", "bumblebee, 2.5 m/s": "cruise_bumblebee",
         "hawkmoth, hovering": "hover_hawkmoth"}


class Insects(flying.FlightTest):
    def told(self, insect):
        """(weight [mN], lift over weight, forward force over weight) of the document."""
        with open(os.path.join(flying.ROOT, "docs", "insects.md"), encoding="utf-8") as f:
            row = re.search(rf"(?m)^\| {insect} \| (\S+) mN \| (\S+) \|[^|]*\| (\S+);", f.read())
        self.assertTrue(row, insect)
        return tuple(map(float, row.groups()))

    def flown(self, case):
        """The same of a flap."""
        code, output = self.fly("case:=" + case, "fluid:=quasi_steady", "in_process:=true", "record:=false",
                                "flaps:=1", "out:=" + self.out(case))
        self.assertEqual(code, 0, output)
        with open(self.out(case) + "/case.yaml", encoding="utf-8") as f:
            insect = yaml.safe_load(f)["insect"]
        mass = sum(n * float(insect[part]["mass"]) for part, n in (("body", 1), ("abdomen", 1), ("wing", 2)))
        columns, rows = flying.table(self.out(case), "flight.csv")
        mean = {name: sum(row[columns.index(name)] for row in rows[1:]) / len(rows[1:]) for name in ("FX", "FZ")}
        weight = 9.81 * mass
        return 1e3 * weight, -mean["FZ"] / weight, mean["FX"] / weight

    def test_lift_against_weight(self):
        for insect, case in CASES.items():
            weight, lift, thrust = self.told(insect)
            flown = self.flown(case)
            self.assertAlmostEqual(flown[0] / weight, 1.0, delta=1e-3, msg=insect)
            self.assertAlmostEqual(flown[1], lift, delta=0.006, msg=insect)
            self.assertAlmostEqual(flown[2], thrust, delta=0.006, msg=insect)


if __name__ == "__main__":
    unittest.main()
