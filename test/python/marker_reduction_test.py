"""Reduction of markers: an invented flight of known angles, and the shipped measured flight."""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight.measured import marker_reduction as reduction  # noqa: E402

MARKERS = ROOT / "config/measured/monarch_markers.csv"
BETA = math.radians(25.0)


def turn(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array({"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
                     "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis])


def invented(t, heading):
    """Markers of a rigid insect whose angles are Fourier series, and these angles."""
    w = 2 * np.pi * 10.0
    angles = dict(theta_B=0.3 + 0.15 * np.sin(w * t), phi=1.0 * np.cos(w * t) + 0.1, psi=0.05 * np.sin(2 * w * t) - 0.03,
                  theta_R=-0.1 + 0.6 * np.sin(w * t), theta_A=0.3 - 0.2 * np.cos(w * t))
    # In wing axes about the root: the markers' centroid on the span.
    wing = 1e-3 * np.array([[8.0, 35.0, 0.0], [-3.0, 42.0, 0.0], [-5.0, 30.0, 0.0]])
    out = {name: np.zeros((len(t), 3)) for name in reduction.MARKERS}
    for n, time in enumerate(t):
        a = {name: values[n] for name, values in angles.items()}
        body = turn("z", heading) @ turn("y", a["theta_B"])
        root = turn("z", heading) @ np.array([1.3 * time, 0, -0.5 * time])
        Q = turn("y", BETA) @ turn("x", a["phi"]) @ turn("z", -a["psi"]) @ turn("y", a["theta_R"])
        for side, mirror in (("R", np.diag([1, 1, 1])), ("L", np.diag([1, -1, 1]))):
            for k, point in enumerate(wing, 1):
                out[f"{side}W{k}"][n] = root + body @ mirror @ Q @ point
        out["T2"][n], out["T1"][n] = root, root + body @ [0.0036, 0, 0]
        tail = turn("y", a["theta_A"])
        for k, length in (("A1", 0.020), ("A2", 0.024)):
            out[k][n] = root + body @ tail @ [-length, 0, 0]
    return out, angles


class Invented(unittest.TestCase):
    def test_every_angle_comes_back(self):
        t = np.arange(100) / 200.0
        for heading in (0.0, 2.5):
            markers, angles = invented(t, heading)
            result = reduction.reduce(t, markers, BETA)
            for name, values in angles.items():
                self.assertLess(np.abs(result["columns"][name] - values).max(), 1e-6, name)
            for name, frequency in (("theta_B", 10.0), ("psi", 20.0), ("theta_R", 10.0)):
                self.assertAlmostEqual(result["series"][name]["frequency"], frequency, places=5)

    def test_mean_velocity_and_stroke_plane(self):
        t = np.arange(120) / 200.0  # six whole flaps
        markers, _ = invented(t, -1.0)
        result = reduction.reduce(t, markers, BETA)
        # The thorax point between T1 and T2 swings about the root by 1.8 mm times theta_B.
        self.assertLess(np.abs(result["velocity"] - [1.3, 0, -0.5]).max(), 2e-3)
        self.assertLess(abs(result["climb"] - math.atan2(0.5, 1.3)), 2e-3)
        self.assertLess(abs(math.degrees(result["beta"] - BETA)), 1.5)  # psi bends the path in the plane


class Measured(unittest.TestCase):
    """Published: config/insects/monarch_kinematics.yaml; fitted frequencies of the same source [Hz]."""

    @classmethod
    def setUpClass(cls):
        cls.result = reduction.reduce(*reduction.read_markers(MARKERS), math.radians(25.4292))
        with open(ROOT / "config/insects/monarch_kinematics.yaml", encoding="utf-8") as file:
            cls.published = yaml.safe_load(file)

    def test_series_within_a_degree_of_the_published_ones(self):
        t = self.result["columns"]["t"]
        for name, frequency in dict(theta_B=10.2213, phi=10.2247, psi=20.2767, theta_R=10.1838, theta_A=10.1756).items():
            ours = self.result["series"][name]
            difference = np.degrees(reduction.evaluate(ours, t, ours["frequency"])) - reduction.evaluate(
                self.published[name + "_deg"], t, frequency)
            self.assertLess(math.sqrt(np.mean(difference**2)), 1.0, name)

    def test_velocity_and_stroke_plane(self):
        self.assertLess(np.abs(self.result["velocity"] - [1.287, 0, -0.390]).max(), 1e-3)
        self.assertLess(abs(math.degrees(self.result["beta"]) - 25.4292), 1.0)


class WrongInput(unittest.TestCase):
    def message(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "markers.csv"
            path.write_text(text, encoding="utf-8")
            run = subprocess.run([ROOT / "scripts/monarch", "reduce-vicon", path, "--out", folder + "/out"], check=False,
                                 capture_output=True, text=True)
            self.assertNotEqual(run.returncode, 0)
            self.assertNotIn("Traceback", run.stderr)
            self.assertFalse((pathlib.Path(folder) / "out").exists())
            return run.stderr

    def test_faults_are_named(self):
        good = MARKERS.read_text(encoding="utf-8")
        self.assertIn("no column T1_x_mm", self.message(good.replace("T1_x_mm", "T9_x_mm")))
        self.assertIn("must be a number", self.message(good.replace("568.051", "", 1)))
        lines = good.splitlines()
        self.assertIn("frames are missing", self.message("\n".join(lines[:40] + lines[41:])))
        self.assertIn("at least 30 frames", self.message("\n".join(lines[:20])))


if __name__ == "__main__":
    unittest.main()
