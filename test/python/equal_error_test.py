#!/usr/bin/python3
"""Limits of runs on several grids, and their cost at equal error."""
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight.trials import equal_error  # noqa: E402

H = [1 / 8, 1 / 12, 1 / 16, 1 / 24]


class Limits(unittest.TestCase):
    def test_of_a_number_and_of_a_history(self):
        for p in (0.8, 1.0, 2.0):
            value, order = equal_error.limit(H, [3 - 2 * h ** p for h in H])
            self.assertAlmostEqual(value, 3)
            self.assertAlmostEqual(order, p)
            history, way = np.array([1.0, -2.0, 4.0]), np.array([0.5, 1.0, -0.2])
            found, order = equal_error.limit(H, [history + h ** p * way for h in H])
            np.testing.assert_allclose(found, history)
            self.assertAlmostEqual(order, p)

    def test_without_convergence_have_no_order(self):
        value, order = equal_error.limit(H, [1.0, 1.0, 1.2, 1.1])
        self.assertIsNone(order)
        self.assertAlmostEqual(value, 0.9)  # first order from the two finest

    def test_without_an_observed_order_take_the_assumed(self):
        value, order = equal_error.limit(H, [1.0, 1.0, 1.2, 1.1], 2.0)
        self.assertIsNone(order)
        self.assertAlmostEqual(value, 1.1 - 0.1 * 0.8)
        slow = [3 - 2 * h ** 0.2 for h in H]
        value, order = equal_error.limit(H, slow)
        self.assertAlmostEqual(order, 0.2)
        share = H[3] ** 0.5 / (H[2] ** 0.5 - H[3] ** 0.5)  # 0.2 is below those that count: 0.5
        self.assertAlmostEqual(value, slow[3] + share * (slow[3] - slow[2]))
        self.assertAlmostEqual(equal_error.limit(H, slow, 1.0)[0], slow[3] + 2 * (slow[3] - slow[2]))
        self.assertAlmostEqual(equal_error.limit(H, [3 - 2 * h ** 1.5 for h in H], 2.0)[0], 3)  # 1.5 is observed

    def test_of_equal_runs(self):
        value, order = equal_error.limit(H, [2.0] * 4)
        self.assertEqual((value, order), (2.0, None))


class Costs(unittest.TestCase):
    def test_errors_by_the_size_of_the_reference(self):
        np.testing.assert_allclose(equal_error.errors([1.1, 0.8], 1.0), [0.1, 0.2])
        np.testing.assert_allclose(equal_error.errors([[3.0, 5.0]], np.array([3.0, 4.0])), [0.2])
        np.testing.assert_allclose(equal_error.errors([1.1], 1.0, scale=0.5), [0.2])

    def test_chance_counts_for_nothing(self):
        self.assertEqual(equal_error.lasting([0.1, 0.001, 0.02, 0.01]), [0.1, 0.02, 0.02, 0.01])

    def test_between_runs_in_logarithms(self):
        costs, errors = [1.0, 100.0], [0.1, 0.001]
        self.assertAlmostEqual(equal_error.cost_at(0.01, costs, errors), 10.0)
        self.assertAlmostEqual(equal_error.cost_at(0.001, costs, errors), 100.0)
        self.assertIsNone(equal_error.cost_at(0.2, costs, errors))
        self.assertIsNone(equal_error.cost_at(0.0005, costs, errors))
        self.assertAlmostEqual(equal_error.cost_at(0.02, [1, 10, 100, 1000], [0.1, 0.001, 0.02, 0.01]), 10)

    def test_ratios_with_bounds(self):
        theirs = [50.0, 500.0, 5000.0], [1.0, 0.01, 1e-5]
        ours = [1.0, 100.0], [0.1, 0.001]
        found = equal_error.ratios(theirs, ours)
        self.assertEqual([bound for _, _, bound in found], [">=", "", "<="])
        np.testing.assert_allclose([ratio for _, ratio, _ in found], [50, 50, 50])


if __name__ == "__main__":
    unittest.main()
