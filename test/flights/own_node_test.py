#!/usr/bin/python3
"""A fluid node of one's own, in Python (examples/drag_fluid.py), flies with the other nodes."""
import math
import os
import subprocess
import unittest

import flying

KEYS = ("case:=climb_printed", "fluid:=quasi_steady", "fluid_node:=drag_fluid.py", "flaps:=0.1",
        "steps_per_flap:=500")


class OwnNode(flying.FlightTest):
    def test_the_example_flies_twice_the_same(self):
        for name in ("first", "second"):
            code, output = self.fly(*KEYS, "out:=" + self.out(name), limit=120)
            self.assertEqual(code, 0, output)
        first, second = (flying.summary(self.out(name)) for name in ("first", "second"))
        self.assertEqual(first["status"], "complete")
        self.assertEqual((first["steps"], first["retried_steps"]), (50, 0))
        self.assertEqual(first["state_sha256"], second["state_sha256"])
        self.assertEqual(first["ignored_messages"]["forged"], 0)
        # Its Jacobian is exact, so Newton's method needs few trials.
        self.assertLessEqual(first["sub_iterations"]["mean"], 3.5)
        self.check_loads()

    def check_loads(self):
        """Drag: no force in the wing's plane, and the air takes work from the wing."""
        columns, rows = flying.table(self.out("first"), "flight.csv")
        flight = {name: [row[i] for row in rows[1:]] for i, name in enumerate(columns)}
        self.assertEqual(set(flight["fx"] + flight["fy"] + flight["mz"]), {0.0})
        self.assertGreater(max(map(abs, flight["fz"])), 1e-4)
        self.assertTrue(all(map(math.isfinite, flight["fz"])))
        work = flying.summary(self.out("first"))["air_work_J"]
        self.assertLess(work["fluid"], 0.0)
        self.assertLess(work["largest_error_of_a_step"], 1e-6 * work["largest_step"])

    def test_the_same_program_is_the_air_of_the_left_wing(self):
        """Of a symmetric flight, so that both wings have the same numbers."""
        for name, wings in (("two", "independent"), ("one", "mirrored")):
            code, output = self.fly(*KEYS[:3], "flaps:=0.04", "steps_per_flap:=500", "wings:=" + wings,
                                    "out:=" + self.out(name), limit=120)
            self.assertEqual(code, 0, output)
        (columns, two), (_, one) = (flying.table(self.out(name), "flight.csv") for name in ("two", "one"))
        at = columns.index
        for row, alone in zip(two, one, strict=True):
            self.assertEqual(row[at("fz")], row[at("fz_L")])
            self.assertEqual((row[at("roll")], row[at("y")]), (0.0, 0.0))
            self.assertAlmostEqual(row[at("fz")], alone[at("fz")], delta=1e-7)
        self.assertGreater(max(abs(row[at("fz_L")]) for row in two), 1e-4)

    def test_to_import_the_solver_changes_nothing(self):
        """The environment belongs to the program, which may be no node at all."""
        code = "import os; before = dict(os.environ); import monarch_flight.solver_node; assert before == dict(os.environ)"
        line = 'source "$0/devel/setup.bash" && exec /usr/bin/python3 -c "$1"'
        subprocess.run(["bash", "-c", line, flying.BUILD, code], env=self.environment(), check=True, timeout=60)

    def test_what_it_cannot_fly_is_said(self):
        code, output = self.fly("case:=hinge", *KEYS[1:], "out:=" + self.out())
        self.assertNotEqual(code, 0, output)
        self.assertIn("this fluid needs a planform with scale_span", output)
        self.assertFalse(os.path.exists(self.out() + "/flight.bag.active"))


if __name__ == "__main__":
    unittest.main()
