"""Numbers behind the figures: forces in body axes, measured forces, strokes of a hinge run, recorded flights, sweeps."""
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rosbag
import yaml
from genpy.dynamic import generate_dynamic

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import case_files  # noqa: E402
from monarch_flight.figures import data  # noqa: E402
from monarch_flight.runs import sweep  # noqa: E402


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


OTHERS = {"std_msgs/Header": "uint32 seq\ntime stamp\nstring frame_id",
          "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z",
          "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
          "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
          "geometry_msgs/Wrench": "Vector3 force\nVector3 torque"}


def message_text(name):
    """Definition of one of our messages with those of its parts, as a bag holds it."""
    ours = ("BodyMotion", "WingJoints", "JointMotion", "WingLoads", "RoleTimes", "GuidanceState", "WingbeatCommand")
    parts = {f"monarch_flight/{part}": (ROOT / f"msg/{part}.msg").read_text(encoding="utf-8") for part in ours}
    return (ROOT / f"msg/{name}.msg").read_text(encoding="utf-8") + "".join(
        f"\n{'=' * 80}\nMSG: {part}\n{text}" for part, text in {**OTHERS, **parts}.items())


class Runs(unittest.TestCase):
    def test_strokes(self):
        t = np.arange(401) / 100 / 50.0  # four strokes at 50 Hz
        phase = 2 * np.pi * 50 * t
        flight = dict(t=t, theta_R=0.7 * np.cos(phase - 2 * np.pi * 0.15), FZ=-2.0 - np.cos(2 * phase))
        swing, fundamental, behind, mean, peak = data.strokes(flight, 50, 2)
        np.testing.assert_allclose([swing, fundamental, behind, mean, peak], [0.7, 0.7, 0.15, 2.0, 3.0], atol=1e-9)
        with self.assertRaises(SystemExit):
            data.strokes(flight, 50, 5)

    def test_flight_from_its_bag(self):
        State = generate_dynamic("monarch_flight/FlightState", message_text("FlightState"))["monarch_flight/FlightState"]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            with self.assertRaises(SystemExit):
                data.flight(folder)
            with rosbag.Bag(str(folder / "flight.bag"), "w") as bag:
                for n in range(5):
                    m = State()
                    m.t, m.body.position.x, m.body.position.z = 0.1 * n, 1.0 * n, -2.0 * n
                    m.body.pitch.position, m.right_wing.theta.position, m.force.z = 0.3, -0.1 * n, -4e-3
                    bag.write("/monarch_flight/state", m)
            flight = data.flight(folder)
        np.testing.assert_allclose(flight["z"], [0, -2, -4, -6, -8])
        np.testing.assert_allclose(flight["theta_R"], [0, -0.1, -0.2, -0.3, -0.4])
        np.testing.assert_allclose(flight["FZ"], -4e-3)

    def test_numbers_of_a_case(self):
        with tempfile.TemporaryDirectory() as name:
            (pathlib.Path(name) / "case.yaml").write_text("{a: 9e-05, b: 3.5e-05, c: -1e3, d: e5, e: 7}", encoding="utf-8")
            self.assertEqual(data.case_of(pathlib.Path(name)), dict(a=9e-5, b=3.5e-5, c=-1e3, d="e5", e=7))

    def test_other_options_and_another_case_are_another_run(self):
        with tempfile.TemporaryDirectory() as name:
            case = pathlib.Path(name) / "mine.yaml"
            case.write_text("name: mine", encoding="utf-8")
            one = case_files.run_name(str(case), "fluid:=quasi_steady", "flaps:=6")
            self.assertRegex(one, "^mine_quasi_steady_6_[0-9a-f]{8}$")
            self.assertNotEqual(one, case_files.run_name(str(case), "fluid:=quasi_steady", "flaps:=7"))
            self.assertEqual(one, case_files.run_name(str(case), "fluid:=quasi_steady", "flaps:=6"))
            case.write_text("name: changed", encoding="utf-8")
            self.assertNotEqual(one, case_files.run_name(str(case), "fluid:=quasi_steady", "flaps:=6"))

    def test_measured_flight_is_at_no_distance_from_itself(self):
        real = data.measured()["columns"]
        flight = {k: real[k] + shift for k, shift in (("t", 3.0), ("x", 1.0), ("z", -2.0))}
        self.assertLess(data.distance_to_measured(flight), 1e-12)
        flight["x"] = flight["x"] + 0.01 * (flight["t"] > 3.0)
        self.assertAlmostEqual(data.distance_to_measured(flight), 0.01, places=3)


class Sweep(unittest.TestCase):
    def test_cases(self):
        shipped = yaml.safe_load((ROOT / "config/cases/climb_printed.yaml").read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            sweep.write_cases(ROOT / "config/cases/climb_printed.yaml", "wing/mass=3.6e-5", folder)
            old = folder / "cases/climb_printed_wing_mass_3.6e-5.yaml"
            before = old.stat().st_mtime_ns
            sweep.write_cases(ROOT / "config/cases/climb_printed.yaml", "wing/mass=3.6e-5,3.7e-5", folder)
            self.assertEqual(old.stat().st_mtime_ns, before)  # not touched: Snakemake would fly it again
            changed = yaml.safe_load((folder / "cases/climb_printed_wing_mass_3.7e-5.yaml").read_text(encoding="utf-8"))
            self.assertEqual(changed["insect"].pop("wing"), {"mass": 3.7e-5})
            self.assertEqual(changed.pop("name"), "climb_printed_wing_mass_3.7e-5")
            shipped.pop("name")
            self.assertEqual(changed, shipped)

    def test_files_of_the_case_are_found_from_elsewhere(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            sweep.write_cases(ROOT / "config/cases/hinge.yaml", "wing/mass=6e-7", folder)
            hinge = yaml.safe_load((folder / "cases/hinge_wing_mass_6e-7.yaml").read_text(encoding="utf-8"))
            file = pathlib.Path(hinge["insect"]["wing"]["planform"]["file"])
            self.assertTrue(file.is_absolute() and file.is_file(), file)

    @unittest.skipUnless(shutil.which("snakemake"), "scripts/install sweep has not been run")
    def test_other_options_are_flown_again(self):
        """The workflow itself, with a flight that only writes its options down."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "out/cases").mkdir(parents=True)
            (folder / "out/cases/a_1.yaml").write_text("name: a", encoding="utf-8")
            fly = folder / "monarch"
            fly.write_text('#!/bin/bash\nmkdir -p "${3#out:=}"; echo "$*" >"${3#out:=}/summary.json"\n', encoding="utf-8")
            fly.chmod(0o755)
            flown = []
            for options in ("flaps:=2", "flaps:=2", "flaps:=3"):
                subprocess.run(["snakemake", "--snakefile", str(ROOT / "config/sweep.smk"), "--directory", str(folder / "out"),
                                "--cores", "1", "runs/a_1/summary.json", "--nolock", "--quiet", "rules", "--config",
                                f"monarch={fly}", f"options= {options}"], check=True, capture_output=True)
                summary = folder / "out/runs/a_1/summary.json"
                flown.append((summary.read_text(encoding="utf-8").split()[-1], summary.stat().st_mtime_ns))
        self.assertEqual(flown[0], flown[1])
        self.assertEqual(flown[2][0], "flaps:=3")


if __name__ == "__main__":
    unittest.main()
