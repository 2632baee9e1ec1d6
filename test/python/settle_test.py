"""Whether a led flight has settled, and the case of its periodic flight, from made-up flights."""
import contextlib
import io
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import led_flights as made  # noqa: E402
from monarch_flight import case_files  # noqa: E402
from monarch_flight.command.main import main as monarch  # noqa: E402
from monarch_flight.settling import settle, settled_case, settled_motion  # noqa: E402
from monarch_flight.settling.led_flight import LedFlight  # noqa: E402

MEANS = dict(amplitude=0.04, deviation_mean=0.02, flapping_mean=-0.03, rest_angle=0.05, abdomen_mean=0.01, abdomen_amplitude=0.1)


class Folder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def flight(self, columns=None, case=None, name="run"):
        return LedFlight(made.write(self.folder / name, case or made.case(), columns or made.columns()))

    def command(self, *arguments):
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            code = monarch(["settle", *(str(argument) for argument in arguments)])
        return code, out.getvalue() + errors.getvalue()


class Flaps(Folder):
    def test_figures_of_a_flap(self):
        columns = made.columns(means=dict(amplitude=0.03))
        columns["applied_amplitude"] += 0.01 * np.cos(2 * np.pi * columns["phase"])
        flaps = self.flight(columns).flaps
        self.assertEqual([flap.number for flap in flaps], [1, 2, 3, 4, 5, 6])
        self.assertEqual([flap.free for flap in flaps], [False] + 5 * [True])
        flap = flaps[2]
        self.assertEqual((flap.first, flap.last), (40, 60))
        self.assertAlmostEqual(flap.speed, math.hypot(1.2, 0.4), places=12)
        self.assertAlmostEqual(flap.climb, math.atan2(0.4, 1.2), places=12)
        self.assertAlmostEqual(flap.theta_B_mean, 0.3, places=12)
        self.assertAlmostEqual(flap.means["amplitude"], 0.03, places=12)
        np.testing.assert_allclose([flap.lows["amplitude"], flap.highs["amplitude"]], [0.02, 0.04], atol=1e-12)
        self.assertLess(flap.change, 1e-10)

    def test_change_is_scaled(self):
        columns = made.columns()
        columns["theta_B_dot"] = columns["theta_B_dot"] + 0.25 * columns["phase"]  # 0.05 of 5 rad/s a flap
        columns["vx"] = columns["vx"] + 0.003 * columns["phase"]  # 0.03 of 0.1 m/s
        self.assertAlmostEqual(self.flight(columns).flaps[1].change, 0.05, places=10)

    def test_flaps_of_the_phase_clock(self):
        """A faster wingbeat: flaps begin between the rows, and states there follow Hermite's cubic."""
        columns = made.columns()
        t = columns["t"]
        columns["phase"] = 1.07 * made.F * t
        columns["applied_frequency"] += 0.07
        columns["vx"], columns["ax"] = 3 * t ** 3 - t, 9 * t ** 2 - 1
        flight = self.flight(columns)
        self.assertEqual(len(flight.flaps), 6)
        begin = 2 / (1.07 * made.F)
        self.assertAlmostEqual(flight.flaps[2].start[0], 3 * begin ** 3 - begin, places=12)
        self.assertAlmostEqual(flight.flaps[2].means["frequency"], 0.07, places=12)
        fault = self.command(self.folder / "run", f"out:={self.folder}/new.yaml")
        self.assertEqual(fault[0], 2)
        self.assertIn("applied_frequency of 0.07 at the end: must be 0", fault[1])


class Verdicts(Folder):
    def verdict(self, columns, case=None, **bounds):
        return settle.judge(self.flight(columns, case), settle.Bounds(**bounds))

    def test_settled(self):
        verdict = self.verdict(made.columns(means=MEANS))
        self.assertEqual(verdict.reasons, [])
        self.assertEqual(verdict.span, "flaps 4 to 6")
        self.assertAlmostEqual(verdict.mean("deviation_mean"), 0.02, places=12)
        self.assertEqual(self.command(self.folder / "run")[0], 0)

    def test_each_bound(self):
        columns = made.columns(means=MEANS)
        late = np.floor(columns["phase"])
        columns["theta_R"] += 0.001 * columns["phase"]  # 0.01 of 0.1 rad a flap
        columns["applied_deviation_mean"] += math.radians(0.09) * late
        columns["applied_amplitude"] += 0.0018 * late
        self.assertEqual(self.verdict(columns).reasons, [])
        for bound, word in ((dict(repeat=0.009), "repeats within 0.01"), (dict(angle=0.08), "deviation_mean changes by 0.09 deg"),
                            (dict(relative=0.0017), "amplitude changes by 0.18 %")):
            reasons = self.verdict(columns, **bound).reasons
            self.assertEqual(len(reasons), 1)
            self.assertIn(word, reasons[0])

    def test_only_the_last_flaps_count(self):
        columns = made.columns()
        columns["vx"] = columns["vx"] + 0.1 * np.maximum(0.0, 3.0 - columns["phase"])
        self.assertEqual(self.verdict(columns).reasons, [])
        self.assertNotEqual(self.verdict(columns, flaps=4).reasons, [])

    def test_prescribed_lost_and_not_finite(self):
        self.assertIn("3 whole free flaps: flaps:=3 needs 4", self.verdict(made.columns(flaps=4)).reasons[0])
        self.assertEqual(self.verdict(made.columns(flaps=5)).reasons, [])
        columns = made.columns()
        columns["lost"][45:] = 1
        self.assertEqual(self.verdict(columns).reasons, ["the controller gave up in flap 3"])
        columns = made.columns()
        columns["theta_B"][-1] = math.nan
        self.assertNotEqual(self.verdict(columns).reasons, [])


class Folding(Folder):
    def settled(self, columns, case=None):
        flight = self.flight(columns, case)
        return settled_case.settled(flight, settle.judge(flight, settle.Bounds()), "new")[0]

    def test_motion_and_hinge(self):
        new, old = self.settled(made.columns(means=MEANS)), made.case()
        s, phase = old["motion"]["phi_deg"], np.linspace(0, 1, 7)
        series = [(one["A0"], one["AN"], one["BN"]) for one in (s, new["motion"]["phi_deg"], new["motion"]["theta_A_deg"])]
        phi, folded, abdomen = (made.wave(one, phase) for one in series)
        np.testing.assert_allclose(folded, phi + 0.04 * (phi - 1.0) - math.degrees(0.03), atol=1e-10)
        np.testing.assert_allclose(abdomen, phi + 0.1 * (phi - 1.0) + math.degrees(0.01), atol=1e-10)
        self.assertAlmostEqual(new["motion"]["psi_deg"]["A0"], -2.0 + math.degrees(0.02), places=10)
        self.assertAlmostEqual(new["insect"]["wing"]["theta_0"], 0.06, places=12)

    def test_prescribed_flap_is_the_flown_one(self):
        new = self.settled(made.columns())
        motion = new["motion"]
        self.assertEqual((new["coupling"]["prescribed_flaps"], "prescribed_steps" in new["coupling"], "initial" in new), (1, False, False))
        np.testing.assert_allclose(motion["body"]["velocity"], [1.2, 0, -0.4], atol=1e-12)
        timed = made.case() | {"time": dict(t_start=0, dt=1 / (made.F * made.STEPS), duration=6 / made.F)}
        coupling = self.settled(made.columns(), timed)["coupling"]
        self.assertEqual((coupling["prescribed_steps"], "prescribed_flaps" in coupling), (made.STEPS, False))
        body, degrees = motion["body"], 180 / math.pi
        for found, series, unit in ((body["sway_x"], made.X, 1), (body["sway_z"], made.Z, 1),
                                    (motion["theta_B_deg"], made.THETA_B, degrees), (motion["theta_R_deg"], made.THETA_R, degrees)):
            np.testing.assert_allclose(found["AN"][:2], unit * np.array(series[1]), atol=1e-9)
            np.testing.assert_allclose(found["BN"][:2], unit * np.array(series[2]), atol=1e-9)
            np.testing.assert_allclose(found["AN"][2:] + found["BN"][2:], 0, atol=1e-9)
        self.assertAlmostEqual(motion["theta_B_deg"]["A0"], math.degrees(0.3), places=9)

    def test_flaps_that_differ_are_averaged(self):
        columns = made.columns()
        columns["theta_R"] += 0.001 * columns["phase"]
        mean = self.settled(columns)["motion"]["theta_R_deg"]["A0"]  # of flaps that begin at 3, 4, 5
        self.assertAlmostEqual(mean, math.degrees(0.05 + 0.004), places=9)

    def test_release_is_exact_beyond_the_harmonics(self):
        columns = made.columns()
        shape = 0.01 * np.cos(2 * np.pi * 9 * columns["phase"]) + 0.02 * np.sin(2 * np.pi * 9 * columns["phase"])
        columns["theta_B"] += shape
        columns["theta_B_dot"] += 0.02 * 2 * np.pi * 9 * made.F * np.cos(2 * np.pi * 9 * columns["phase"])
        columns["vx"] += 0.005
        motion = self.settled(columns)["motion"]
        found = np.radians(settled_motion.at_start(motion["theta_B_deg"], made.F))
        np.testing.assert_allclose(found, [columns["theta_B"][-21], columns["theta_B_dot"][-21]], rtol=1e-9)
        rate = settled_motion.at_start(motion["body"]["sway_x"], made.F)[1]
        self.assertAlmostEqual(motion["body"]["velocity"][0] + rate, columns["vx"][-21], places=9)

    def test_law_is_the_same_about_the_folded_motion(self):
        means = {name: MEANS[name] for name in ("amplitude", "deviation_mean")}
        new, old = self.settled(made.columns(means=means)), made.case()
        rng, mean = np.random.default_rng(2), np.array([0.04, 0.02])
        unit = np.array([1 / 1.04, 1.0])
        for phase in (0, 7):
            deviation, filters, integral = rng.normal(size=6), rng.normal(size=(2, 3)), rng.normal(size=2)
            commands = []
            for case, c in ((old, filters), (new, filters * unit[:, None])):
                gains = case["guidance"]["controller"]["gains"]
                rows = slice(2 * phase, 2 * phase + 2)
                state, filter_, integral_ = (np.array(gains[key])[rows] for key in ("state", "filter", "integral"))
                commands.append(-state @ deviation - filter_ @ c.ravel() - integral_ @ integral)
            np.testing.assert_allclose(commands[1], commands[0] * unit, rtol=1e-9)
        low, high = (np.array(old["guidance"]["limits"]["amplitude"]) - mean[0]) * unit[0]
        np.testing.assert_allclose(new["guidance"]["limits"]["amplitude"], [low, high], atol=1e-12)
        np.testing.assert_allclose(new["guidance"]["limits"]["deviation_mean"], [-0.32, 0.18], atol=1e-12)

    def test_set_point_needs_no_command_and_the_flown_states(self):
        wind = (0.2, -0.1)
        columns = made.columns(means=MEANS, wind=wind)
        new, old = (case["guidance"]["controller"] for case in (self.settled(columns), made.case()))
        self.assertEqual(new["set_points"], dict(flaps=[0], speeds=[made.SET_POINT[0]], climbs_deg=[made.SET_POINT[1]]))
        wanted = settled_case.velocity(made.SET_POINT[0], math.radians(made.SET_POINT[1])) - wind
        commands, states = settled_case.reference(new, wanted)
        np.testing.assert_allclose(commands, 0, atol=1e-11)
        np.testing.assert_allclose(states[3, :4], [columns["vx"][6] - 0.2, columns["vz"][6] + 0.1, columns["theta_B"][6],
                                                   columns["theta_B_dot"][6]], atol=1e-9)
        moved = [np.array(one["table"]["states"]).reshape(4, made.SAMPLES, 6) for one in (new, old)]
        moved = moved[0] - moved[1]
        np.testing.assert_allclose(moved, np.broadcast_to(moved[:1], moved.shape), atol=1e-9)  # all points alike

        slope = np.diff(old["table"]["commands"], axis=0) * [1 / 1.04, 1.0]  # in units of the new commands
        np.testing.assert_allclose(np.diff(new["table"]["commands"], axis=0), slope, atol=1e-11)

    def test_reference_between_the_points_has_the_velocity_asked_for(self):
        controller = made.case()["guidance"]["controller"]
        table, wanted = controller["table"], settled_case.velocity(1.25, math.radians(15.0))
        corners = [settled_case.velocity(speed, math.radians(climb)) for speed in (1.0, 1.5) for climb in (10.0, 30.0)]
        share = np.array([0.375, 0.125, 0.375, 0.125])
        commands, states = settled_case.reference(controller, wanted)
        np.testing.assert_allclose(commands, share @ np.array(table["commands"]), atol=1e-12)
        mixture = np.tensordot(share, np.array(table["states"]).reshape(4, made.SAMPLES, 6), 1)
        np.testing.assert_allclose(states[:, 2:], mixture[:, 2:], atol=1e-12)
        moved = states[:, :2] - mixture[:, :2]
        np.testing.assert_allclose(moved, np.tile(wanted - share @ corners, (made.SAMPLES, 1)), atol=1e-12)

    def test_reference_at_a_point_of_the_table(self):
        controller = made.case()["guidance"]["controller"]
        commands, states = settled_case.reference(controller, settled_case.velocity(1.5, math.radians(10.0)))
        np.testing.assert_allclose(commands, controller["table"]["commands"][2], atol=1e-12)
        np.testing.assert_allclose(states, controller["table"]["states"][20:30], atol=1e-12)


class Files(Folder):
    def test_case_is_written_and_reads_back(self):
        flight = self.flight(made.columns(means=MEANS))
        out = self.folder / "new/periodic.yaml"
        code, text = self.command(self.folder / "run", f"out:={out}")
        self.assertEqual(code, 0, text)
        written = out.read_text(encoding="utf-8")
        for words in ("# Made by monarch settle", "amplitude +4 %", "# status: flown, mean of the flaps 4 to 6 of run/flight.csv",
                      "name: periodic\n"):
            self.assertIn(words, written)
        expected = settled_case.settled(flight, settle.judge(flight, settle.Bounds()), "periodic")[0]
        self.assertEqual(case_files.read(out), expected)
        code, text = self.command(self.folder / "run", f"out:={out}")
        self.assertEqual((code, "exists already" in text), (2, True))

    def test_not_settled_is_not_written(self):
        columns = made.columns()
        columns["vx"] = columns["vx"] + 0.01 * columns["phase"]
        self.flight(columns)
        code, text = self.command(self.folder / "run", f"out:={self.folder}/new.yaml")
        self.assertEqual((code, (self.folder / "new.yaml").exists()), (1, False))
        self.assertIn("not settled: a flap repeats within 0.1 (scaled): must be 0.02", text)

    def test_refusals(self):
        case = made.case()
        case["guidance"]["type"] = "motion"
        self.flight(case=case)
        code, text = self.command(self.folder / "run")
        self.assertEqual(code, 2)
        self.assertIn("guidance/type = motion: must be controller, commands or node", text)
        code, text = self.command(self.folder / "nowhere", "flaps:=x", "repeat:=-1", "bound:=2", "out:=new")
        self.assertEqual(code, 2)
        for words in ("flaps:=x: must be a whole number", "repeat:=-1: must be a number > 0", "unknown key 'bound'",
                      "must end in .yaml"):
            self.assertIn(words, text)
        self.assertIn("case.yaml: does not exist", self.command(self.folder / "nowhere")[1])
        case = made.case()
        case["motion"]["type"] = "table"
        self.flight(case=case)
        code, text = self.command(self.folder / "run", f"out:={self.folder}/new.yaml")
        self.assertIn("motion/type = table: must be fourier", text)

    def test_text_of_a_case(self):
        content = dict(a=True, b=dict(c=[1, 2.5e-9], d=[[1, 2], [3, 4]]), e="x: y", f="a, b", g=[dict(k="in, out", v=[0, 1])],
                       h="none", i=-3)
        path = self.folder / "case.yaml"
        path.write_text(case_files.text(content, {"b/d": "why\nso"}), encoding="utf-8")
        self.assertEqual(case_files.read(path), content)
        self.assertIn("  # why\n  # so\n  d:\n    - [1, 2]\n", path.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
