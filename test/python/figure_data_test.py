"""Numbers behind the figures: forces in body axes, measured forces, strokes of a hinge run, case files of a sweep."""
import csv
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import figure_data as data  # noqa: E402


class Forces(unittest.TestCase):
    def test_body_axes(self):
        upward = dict(FX=np.zeros(2), FZ=np.full(2, -3.0), theta_B=np.array([0.0, math.pi / 2]))
        thrust, lift = data.body_forces(upward)
        np.testing.assert_allclose(thrust, [0, 3], atol=1e-12)  # nose up: thrust is upward
        np.testing.assert_allclose(lift, [3, 0], atol=1e-12)

    def test_straight_flight_carries_the_weight(self):
        t = np.linspace(0, 0.5, 101)
        series = dict(A0=0.3, AN=[0.0], BN=[0.0], frequency=10.0)
        flight = dict(columns=dict(t=t, x=1.3 * t, z=-0.4 * t), series=dict(theta_B=series))
        thrust, lift = data.measured_forces(flight, 0.002, 10.0)
        np.testing.assert_allclose(thrust, 0.02 * math.sin(0.3), atol=1e-9)
        np.testing.assert_allclose(lift, 0.02 * math.cos(0.3), atol=1e-9)


class Runs(unittest.TestCase):
    def test_strokes(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            t = np.arange(401) / 100 / 50.0  # four strokes at 50 Hz
            with open(folder / "flight.csv", "w", encoding="utf-8", newline="") as file:
                writer = csv.writer(file)
                writer.writerow(["t", "theta_R", "FZ"])
                phase = 2 * np.pi * 50 * t
                writer.writerows(zip(t, 0.7 * np.cos(phase - 2 * np.pi * 0.15), -2.0 - np.cos(2 * phase)))
            (folder / "case.yaml").write_text("motion: {frequency: 50}\n", encoding="utf-8")
            swing, fundamental, behind, mean, peak = data.strokes(folder, 2)
            np.testing.assert_allclose([swing, fundamental, behind, mean, peak], [0.7, 0.7, 0.15, 2.0, 3.0], atol=1e-9)
            with self.assertRaises(SystemExit):
                data.strokes(folder, 5)

    def test_case_with_another_wing_mass(self):
        with tempfile.TemporaryDirectory() as name:
            path = data.with_wing_mass("climb", 3.7e-5, pathlib.Path(name))
            changed = yaml.safe_load(path.read_text(encoding="utf-8"))
            shipped = yaml.safe_load((ROOT / "config/cases/climb.yaml").read_text(encoding="utf-8"))
            self.assertEqual(changed["insect"].pop("wing"), {"mass": 3.7e-5})
            self.assertEqual(changed.pop("name"), "climb_37.00mg")
            shipped.pop("name")
            self.assertEqual(changed, shipped)


if __name__ == "__main__":
    unittest.main()
