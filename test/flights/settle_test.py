#!/usr/bin/python3
"""A controlled flight settles; the case that monarch settle writes goes on with it, and needs smaller commands."""
import math
import os
import re
import subprocess
import unittest

import flying

KEYS = ("fluid:=quasi_steady", "in_process:=true", "record:=false")
WIDE = ("flaps:=2", "repeat:=0.5", "angle:=0.5", "relative:=0.02")
STEPS = 250
STATE = ("vx", "vz", "theta_B", "theta_B_dot", "theta_R", "theta_R_dot")


class Settle(flying.FlightTest):
    def flown(self, name, case, flaps):
        code, output = self.fly(*KEYS, "case:=" + case, "flaps:=%d" % flaps, "out:=" + self.out(name))
        self.assertEqual(code, 0, output)
        self.assertRegex(output, r"guidance +controller, \d+ commands? cut to .* bounds, 0 refused\n")

    def settle(self, name, *keys):
        """Exit code, output."""
        done = subprocess.run([flying.MONARCH, "settle", self.out(name), *keys], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        return done.returncode, done.stdout

    def state(self, name, row):
        columns, rows = flying.table(self.out(name), "flight.csv")
        return [rows[row][columns.index(one)] for one in STATE]

    def means(self, output):
        """Mean commands, amplitude [%] and deviation [deg]."""
        found = re.search(r"amplitude ([-+.0-9]+) %, deviation_mean ([-+.0-9]+) deg", output)
        return [abs(float(one)) for one in found.groups()]

    def test_a_round(self):
        self.flown("first", "climb_controlled", 12)
        case = self.out("periodic.yaml")
        code, output = self.settle("first", "out:=" + case)
        self.assertEqual(code, 1, output)
        self.assertIn("not settled", output)
        self.assertFalse(os.path.exists(case))
        code, before = self.settle("first", "out:=" + case, *WIDE)
        self.assertEqual(code, 0, before)
        self.flown("second", case, 8)
        for found, *ends in zip(self.state("second", STEPS), self.state("first", 10 * STEPS), self.state("first", 11 * STEPS)):
            self.assertTrue(math.isclose(found, sum(ends) / 2, rel_tol=1e-6, abs_tol=1e-6), (found, ends))
        code, after = self.settle("second", *WIDE)
        self.assertEqual(code, 0, after)
        self.assertLess(self.means(after)[0], 0.5 * self.means(before)[0], after)
        self.assertEqual(flying.summary(self.out("second"))["guidance"]["type"], "controller")


if __name__ == "__main__":
    unittest.main()
