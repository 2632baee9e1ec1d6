#!/usr/bin/python3
"""Loads of the plates of monarch bench accuracy, and what their runs say beside each other."""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight.trials import accuracy, accuracy_table  # noqa: E402


def run(grid, error, cpu_s):
    """Of a force whose error is that share of it."""
    course = (1 + error) * np.array([3.0, 4.0])
    return {"grid": grid, "cells": 1000 * grid, "steps": accuracy.steps_of(grid), "cpu_s": cpu_s, "mean": course.mean(),
            "peak": course.max(), "course": course.tolist()}


def runs(factor, order, cost, grids):
    return [run(grid, factor * grid ** -order, cost * grid ** 4) for grid in grids]


class Loads(unittest.TestCase):
    def test_of_the_window(self):
        time = np.arange(1, 161) / 320
        found = accuracy.loads(time, 2 + np.cos(2 * np.pi * (time - 0.2512)))
        self.assertAlmostEqual(found["peak"], 3, 4)
        self.assertAlmostEqual(found["mean"], 2 + (np.sin(2 * np.pi * 0.2488) + np.sin(2 * np.pi * 0.1512)) / (0.8 * np.pi), 3)
        self.assertEqual(len(found["course"]), 17)

    def test_of_openfoam_in_axes_of_the_plate(self):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder)
            (case / "postProcessing/forces/0").mkdir(parents=True)
            (case / "constant").mkdir()
            (case / "constant/motion.dat").write_text("2\n(\n(0 ((0 0 0) (0 0 0)))\n(1 ((0 0 0) (90 0 0)))\n)\n", encoding="utf-8")
            (case / "postProcessing/forces/0/force.dat").write_text("# Time\n0 (1 2 3) (0 0 0)\n1 (1 2 3) (0 0 0)\n", encoding="utf-8")
            np.testing.assert_allclose(accuracy.normal_force(case)[1], [3, -2])


class Comparison(unittest.TestCase):
    def setUp(self):
        self.runs = {"ours": runs(1, 2, 1e-4, accuracy.GRIDS + accuracy.FINER), "theirs": runs(2, 2, 1e-2, accuracy.GRIDS)}

    def test_twice_the_error_at_a_hundred_times_the_cost(self):
        found = accuracy.compared(self.runs)["course"]
        self.assertLess(found["limits_apart"], 1e-9)
        for order in found["orders"].values():
            self.assertAlmostEqual(order, 2)
        ratios = [ratio for _, ratio, bound in found["ratios"]["own"] if not bound]
        self.assertGreater(len(ratios), 1)
        np.testing.assert_allclose(ratios, 400, rtol=0.02)  # half the error: 2 ** 0.5 of the cells, 4 times the cost

    def test_table(self):
        text = accuracy_table.figures({"processor": "one", "runs": {"heaving": self.runs}})
        self.assertIn("| heaving | 8 | 0.008 M, 40 | 40.96 | 0.41 | 100 |", text)
        self.assertIn("| heaving, mean | ", text)
        self.assertEqual(accuracy_table.ratio_list([(0.1, 57.3, ">="), (0.01, 9.61, ""), (0.001, 3, "<=")], floor=0.002), "> 57, 9.6, -")


if __name__ == "__main__":
    unittest.main()
