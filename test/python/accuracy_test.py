#!/usr/bin/python3
"""Loads of the plates of monarch bench accuracy, and what their runs say beside each other."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight.trials import accuracy, accuracy_table, bench  # noqa: E402


def run(grid, error, cpu_s, limit=1.0):
    """Of a force whose error is that share of its limit."""
    history = limit * (1 + error) * np.array([3.0, 4.0])
    return {"grid": grid, "cells": 1000 * grid, "steps": accuracy.steps_of(grid), "cpu_s": cpu_s, "mean": history.mean(),
            "peak": history.max(), "history": history.tolist()}


def runs(factor, order, cost, grids, limit=1.0):
    return [run(grid, factor * grid ** -order, cost * grid ** 4, limit) for grid in grids]


def rows_of(ours, theirs):
    """{name: row of bench.json} of a plate's runs, and what is printed."""
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as printed:
        table = bench.Table(pathlib.Path(folder, "bench.json"))
        accuracy.rows(table, "heaving", accuracy.compared({"ours": ours, "theirs": theirs}))
    return {row["name"]: row for row in table.rows}, printed.getvalue()


class Loads(unittest.TestCase):
    def test_of_the_window(self):
        time = np.arange(1, 161) / 320
        found = accuracy.loads(time, 2 + np.cos(2 * np.pi * (time - 0.2512)))
        self.assertAlmostEqual(found["peak"], 3, 4)
        self.assertAlmostEqual(found["mean"], 2 + (np.sin(2 * np.pi * 0.2488) + np.sin(2 * np.pi * 0.1512)) / (0.8 * np.pi), 3)
        self.assertEqual(len(found["history"]), 17)

    def test_of_openfoam_in_axes_of_the_plate(self):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder)
            (case / "postProcessing/forces/0").mkdir(parents=True)
            (case / "constant").mkdir()
            (case / "constant/motion.dat").write_text("2\n(\n(0 ((0 0 0) (0 0 0)))\n(1 ((0 0 0) (90 0 0)))\n)\n", encoding="utf-8")
            (case / "postProcessing/forces/0/force.dat").write_text("# Time\n0 (1 2 3) (0 0 0)\n1 (1 2 3) (0 0 0)\n", encoding="utf-8")
            np.testing.assert_allclose(accuracy.normal_force(case)[1], [3, -2])


class Solves(unittest.TestCase):
    LOG = "DICPCG:  Solving for p, Initial residual = 1, Final residual = 1e-3, No Iterations %d\n" \
          "smoothSolver:  Solving for Ux, Initial residual = 1, Final residual = 1e-8, No Iterations 76\n"

    def test_within_their_iterations_pass(self):
        accuracy.refuse_stopped_solves(self.LOG % 49 + self.LOG % 7, "maxIter 50;", "here")

    def test_at_the_limit_fail(self):
        with self.assertRaisesRegex(SystemExit, "here: 1 of 2 pressure solves .* limit of 50 iterations"):
            accuracy.refuse_stopped_solves(self.LOG % 7 + self.LOG % 50, "maxIter 50;", "here")

    def test_of_a_log_without_any_fail(self):
        with self.assertRaisesRegex(SystemExit, "no pressure solve"):
            accuracy.refuse_stopped_solves("", "maxIter 50;", "here")

    def test_have_a_limit_in_the_case(self):
        root = pathlib.Path(accuracy.__file__).resolve().parents[3]
        accuracy.refuse_stopped_solves(self.LOG % 999, (root / "bench/openfoam_plate/system/fvSolution").read_text(encoding="utf-8"), "here")


class Comparison(unittest.TestCase):
    def setUp(self):
        self.runs = {"ours": runs(1, 2, 1e-4, accuracy.GRIDS + accuracy.FINER), "theirs": runs(2, 2, 1e-2, accuracy.GRIDS)}

    def test_twice_the_error_at_a_hundred_times_the_cost(self):
        found = accuracy.compared(self.runs)["history"]
        self.assertLess(found["limits_apart"], 1e-9)
        for order in found["orders"].values():
            self.assertAlmostEqual(order, 2)
        ratios = [ratio for _, ratio, bound in found["ratios"]["own"] if not bound]
        self.assertGreater(len(ratios), 1)
        np.testing.assert_allclose(ratios, 400, rtol=0.02)  # half the error: 2 ** 0.5 of the cells, 4 times the cost

    def test_with_limits_apart(self):
        """Ours comes to 1 from below, theirs to 1.02 from below: through the mean of both limits, 1.01."""
        ours = runs(-1, 2, 1e-4, accuracy.GRIDS + accuracy.FINER)
        theirs = runs(-2, 2, 1e-2, accuracy.GRIDS, limit=1.02)
        found = accuracy.compared({"ours": ours, "theirs": theirs})["history"]
        self.assertAlmostEqual(found["limits_apart"], 0.02)
        np.testing.assert_allclose(found["lines"]["ours"]["common"][:4], [0.01 + grid ** -2 for grid in accuracy.GRIDS])
        np.testing.assert_allclose(found["lines"]["theirs"]["common"], [abs(0.01 - 2.04 * grid ** -2) for grid in accuracy.GRIDS])
        self.assertEqual([bound for _, _, bound in found["ratios"]["own"]], [">=", "", "", ""])
        self.assertEqual([bound for _, _, bound in found["ratios"]["common"]], ["", "<=", "<=", "<="])
        part = np.log((0.01 + 1 / 64) / (2.04 / 64 - 0.01)) / np.log((0.01 + 1 / 64) / (0.01 + 1 / 144))  # of the way from our 8 to 12
        self.assertAlmostEqual(found["ratios"]["common"][0][1], 100 / 1.5 ** (4 * part))
        text = accuracy_table.figures({"processor": "one", "runs": {"heaving": {"ours": ours, "theirs": theirs}}})
        self.assertRegex(text, r"\| heaving, history \| .* \| 2.0, 2.0 \| 2 % \| > 100, .* \| \d+, -, -, - \|")
        self.assertNotIn("*", text)

    def test_without_an_order_tries_two(self):
        """Their error rises from 12 to 16 cells a chord and falls to 20."""
        theirs = [run(grid, error, 1e-2 * grid ** 4) for grid, error in zip(accuracy.GRIDS, (0.3, 0.1, 0.12, 0.11))]
        found = accuracy.compared({"ours": self.runs["ours"], "theirs": theirs})["history"]
        self.assertIsNone(found["orders"]["theirs"])
        self.assertEqual([one["order"] for one in found["assumed"]], [1, 2])
        for one in found["assumed"]:
            p = one["order"]
            limit = 1.11 - 0.01 * 20 ** -p / (16 ** -p - 20 ** -p)
            np.testing.assert_allclose(one["limits"]["theirs"], [3 * limit, 4 * limit])
            self.assertAlmostEqual(one["limits_apart"], limit - 1)
        text = accuracy_table.figures({"processor": "one", "runs": {"heaving": {"ours": self.runs["ours"], "theirs": theirs}}})
        self.assertIn("| none*, 2.0 | 7 %* |", text)
        self.assertIn("| heaving, history | OpenFOAM | 4 %, 1.8 % | 7 %, 9.2 % |", text)

    def test_with_an_assumed_order_meets_no_bar(self):
        theirs = [run(grid, error, 10 * grid ** 4) for grid, error in zip(accuracy.GRIDS, (0.3, 0.1, 0.12, 0.11))]
        row = rows_of(self.runs["ours"], theirs)[0]["accuracy_heaving_history_cost_ratio"]
        tried = accuracy.compared({"ours": self.runs["ours"], "theirs": theirs})["history"]["assumed"]
        self.assertEqual(row["value"], min(one["ratios"]["own"][-1][1] for one in tried))
        self.assertGreater(row["value"], accuracy.BAR)
        self.assertEqual((row["pass"], row["doubt"]), (False, "an order is assumed"))

    def test_bound_from_above_meets_no_bar(self):
        rows, printed = rows_of(runs(50, 2, 1e-7, accuracy.GRIDS + accuracy.FINER), self.runs["theirs"])
        row = rows["accuracy_heaving_history_cost_ratio"]
        self.assertAlmostEqual(row["value"], 6250)
        self.assertEqual((row["bound"], row["pass"]), ("<=", False))
        self.assertRegex(printed, r"accuracy_heaving_history_cost_ratio +<= 6250 +>= 100 +MISSED: only a bound\n")

    def test_bound_from_below_meets_the_bar(self):
        rows, printed = rows_of(runs(1e-3, 2, 1e-4, accuracy.GRIDS + accuracy.FINER), self.runs["theirs"])
        row = rows["accuracy_heaving_history_cost_ratio"]
        self.assertEqual((row["bound"], row["pass"], row["unit"]), (">=", True, ""))
        self.assertRegex(printed, r"accuracy_heaving_history_cost_ratio +>= 3906.2 +>= 100 +ok\n")

    def test_table(self):
        text = accuracy_table.figures({"processor": "one", "runs": {"heaving": self.runs}})
        self.assertIn("| heaving | 8 | 0.008 M, 40 | 40.96 | 0.41 | 100 |", text)
        self.assertIn("| heaving, mean | ", text)
        self.assertEqual(accuracy_table.ratio_list([(0.1, 57.3, ">="), (0.01, 9.61, ""), (0.001, 3, "<=")], floor=0.002), "> 57, 9.6, -")


if __name__ == "__main__":
    unittest.main()
