#!/usr/bin/python3
"""What a run says on the screen and in its summary beside the figures, and spellings of numbers."""
import os
import unittest

import flying

KEYS = ("case:=climb_printed", "fluid:=quasi_steady", "in_process:=true", "record:=false")


class PlainWords(flying.FlightTest):
    def flown(self, name, *keys):
        code, output = self.fly(*KEYS, *keys, "out:=" + self.out(name))
        self.assertEqual(code, 0, output)
        return flying.summary(self.out(name)), output

    def written(self, name, text):
        with open(os.path.join(self.folder, name), "w") as f:
            f.write(text)
        return os.path.join(self.folder, name)

    def test_numbers_with_an_exponent(self):
        plain, _ = self.flown("plain", "flaps:=0.1")
        for i, spelling in enumerate(("1e-1", "1E-1", "0.01e+1", ".1", "100e-3")):
            spelt, _ = self.flown("spelt_%d" % i, "flaps:=" + spelling)
            self.assertEqual((spelt["steps"], spelt["state_sha256"]), (50, plain["state_sha256"]))
        for wrong in ("0e5", "1e", "e1", "0.0"):
            code, output = self.fly(*KEYS, "flaps:=" + wrong, "out:=" + self.out())
            self.assertEqual(code, 2, output)
            self.assertIn("flaps:=%s: must be a number > 0" % wrong, output)

    def test_a_run_in_which_nothing_is_ever_free(self):
        told, output = self.flown("short", "flaps:=0.02")
        words = "nothing is ever free: all 10 steps follow the motion, as the first 10 of this case do"
        self.assertEqual(output.count(words), 2, output)  # before and after
        self.assertEqual((told["steps"], told["free_steps"]), (10, 0))
        self.assertIn(words, told["remarks"][0])
        told, output = self.flown("longer", "flaps:=0.022")
        self.assertEqual((told["steps"], told["free_steps"]), (11, 1))
        self.assertNotIn("ever free", output)
        [remark] = told["remarks"]  # at the top of the stroke, where this flight begins
        self.assertIn("the wings pass through the insect's mid-plane by up to ", remark)
        self.assertEqual(output.count(remark), 1, output)

    def test_a_remainder_of_a_step(self):
        told, output = self.flown("odd", "flaps:=0.333")
        self.assertEqual(told["steps"], 166)
        self.assertEqual(len([remark for remark in told["remarks"] if "remainder" in remark]), 1)
        self.assertEqual(output.count("the remainder of 0.5 steps is not flown"), 2, output)

    def test_a_body_that_tumbles(self):
        told, output = self.flown("tumbling", "flaps:=6")
        columns, rows = flying.table(self.out("tumbling"), "flight.csv")
        pitch = columns.index("theta_B")
        first = next(i for i, row in enumerate(rows) if abs(row[pitch]) > 1.0471975512)
        self.assertEqual(told["tumbled_from_step"], first)
        self.assertEqual(told["tumbled_from_flap"], (first - 1) // 500 + 1)
        self.assertRegex(output, r"tumbled +from flap %d on" % told["tumbled_from_flap"])

    def test_a_table_without_commas(self):
        self.written("m.csv", "t;x;y;z;theta_B;phi;psi;theta_R;theta_A\n0;0;0;0;0,3;0;0;0;0\n")
        case = self.written("case.yaml", "name: commas\ninsect: {preset: monarch_fwuav}\nfluid: {solver: quasi_steady}\n"
                            "motion: {type: table, kind: body, file: m.csv, frequency: 10}\n"
                            "free: {x: false, z: false, pitch: false, wing_pitch: false}\ntime: {dt: 0.001, duration: 0.1}\n")
        code, output = self.fly("case:=" + case, "in_process:=true", "out:=" + self.out())
        self.assertEqual(code, 2, output)
        self.assertIn("columns must be separated by commas, not semicolons", output)


if __name__ == "__main__":
    unittest.main()
