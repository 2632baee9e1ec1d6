"""Identification of parameters: what the fit knows, the search over made-up flights, what it refuses."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import case_files  # noqa: E402
from monarch_flight.command.main import main as monarch  # noqa: E402
from monarch_flight.identification import confidence, fit, flights, picture, report, study  # noqa: E402
from monarch_flight.keys import Refused  # noqa: E402

KAPPA, REST = "insect/wing/kappa", "insect/wing/theta_0"
STEPS, FREQUENCY = 40, 10.2


def angle(kappa, rest, t):
    """Made up [deg]: nonlinear in kappa, linear in the rest angle."""
    x = 2 * np.pi * FREQUENCY * t
    return 30 * np.cos(x - 1e4 * kappa) / (1 + 1e4 * kappa) + 50 * rest * (1 + np.sin(2 * x))


def body(root, t):
    """Made up [deg]: linear in where the wing roots are [m]."""
    return 18 + 4000 * root * np.sin(2 * np.pi * FREQUENCY * t)


class Made(flights.Flights):
    """Flies `angle` and `body` instead of a butterfly; fails where kappa is above `breaks`."""
    breaks = np.inf

    def fly(self, texts):
        for name, text in texts.items():
            case = yaml.load(text, case_files.CaseLoader)
            wing = case["insect"]["wing"]
            t = np.arange(case["time"]["flaps"] * STEPS + 1) / (STEPS * FREQUENCY)
            self.flown += 1
            if wing["kappa"] > self.breaks:
                self.put(name + ".failed", "the flow blew up")
                continue
            flown = zip(t, angle(wing["kappa"], wing["theta_0"], t), body(wing.get("root", [0])[0], t))
            rows = "\n".join(f"{a:.17g},{np.radians(b):.17g},{np.radians(c):.17g}" for a, b, c in flown)
            self.put(name + ".csv", f"# made up\nt,theta_R,theta_B\n{rows}\n")


class Folder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def content(self, **more):
        t = np.arange(0, 4 * STEPS + 1) / (STEPS * FREQUENCY)
        rows = "\n".join(f"{a:.17g},{b:.17g}" for a, b in zip(t, angle(7e-5, -0.2, t)))
        (self.folder / "measured.csv").write_text(f"t,theta_R_deg\n{rows}\n", encoding="utf-8")
        return dict(dict(name="found", case="passive_pitch",
                         unknown={KAPPA: dict(start=1e-4, range=[2e-5, 2e-4]), REST: dict(start=0.1, range=[-0.5, 0.4])},
                         measured=dict(angle="theta_R", file="measured.csv"), compare=[2, 3],
                         stages=[dict(name="made up", fluid="quasi_steady", steps_per_flap=STEPS)]), **more)

    def written(self, **more):
        path = self.folder / "study.yaml"
        path.write_text(yaml.safe_dump(self.content(**more)), encoding="utf-8")
        return path

    def faults(self, **more):
        with self.assertRaises(Refused) as refusal:
            study.read(self.written(**more))
        return "\n".join(refusal.exception.faults)

    def search(self, flown=None, **more):
        told = []
        wanted = study.read(self.written(**more))
        return wanted, fit.search(wanted, flown or Made(self.folder / "out", ["theta_R"], 2, 2), 20, told.append), told


class Confidence(unittest.TestCase):
    """Linear problems, where everything is known exactly."""

    def test_straight_line(self):
        x = np.linspace(-1, 2, 30)
        rng = np.random.default_rng(5)
        noise = rng.normal(size=30)
        J = np.column_stack([x, np.ones(30)])
        r = noise - J @ np.linalg.lstsq(J, noise, rcond=None)[0]
        known = confidence.confidence(J, r, independent=30)
        variance, spread = r @ r / 28, np.sum((x - x.mean()) ** 2)
        np.testing.assert_allclose(known.deviations, np.sqrt([variance / spread, variance * (1 / 30 + x.mean() ** 2 / spread)]), rtol=1e-12)
        np.testing.assert_allclose(known.correlation[0, 1], -x.mean() / np.sqrt(np.mean(x ** 2)), rtol=1e-12)
        _, covariance = np.polyfit(x, noise, 1, cov=True)
        np.testing.assert_allclose(known.covariance, covariance, rtol=1e-10)
        fewer = confidence.confidence(J, r, independent=10)
        np.testing.assert_allclose(fewer.covariance / known.covariance, np.full((2, 2), 28 / 8), rtol=1e-12)

    def test_what_two_unknowns_do_alike_is_not_determined(self):
        column = np.sin(np.arange(50.0))
        known = confidence.confidence(np.column_stack([column, column]), 0.01 * np.cos(np.arange(50.0)), independent=50)
        self.assertEqual(list(known.determined), [True, False])
        np.testing.assert_allclose(np.abs(known.combinations), np.full((2, 2), np.sqrt(0.5)), rtol=1e-12)
        self.assertLess(known.combinations[1, 0] * known.combinations[1, 1], 0)
        np.testing.assert_allclose(known.singular_values[0], np.sqrt(2 * np.mean(column ** 2)), rtol=1e-12)
        self.assertLess(known.singular_values[1], 1e-12)

    def test_correlation_time(self):
        self.assertEqual(confidence.correlation_time([1.0, -1.0] * 20), 1.0)
        rng, rho, r = np.random.default_rng(1), 0.8, [0.0]
        for value in rng.normal(size=50000):
            r.append(rho * r[-1] + value)
        self.assertAlmostEqual(confidence.correlation_time(r) / ((1 + rho) / (1 - rho)), 1.0, delta=0.1)

    def test_angles_off_by_different_amounts_are_counted_one_by_one(self):
        rng = np.random.default_rng(2)

        def noise(mean):
            t = np.arange(500.0)
            return fit.Comparison("theta_R", 1.0, t, t, mean + rng.normal(size=500), np.zeros(500), float("nan"))
        together = fit.Comparisons([noise(3.0), noise(0.0)])
        self.assertLess(1000 / confidence.correlation_time(together.residuals), 100)
        self.assertGreater(together.independent, 600)


class Search(Folder):
    def test_known_values_are_found(self):
        wanted, [found], _ = self.search()
        np.testing.assert_allclose(found.values, [7e-5, -0.2], rtol=1e-5)
        [comparison] = found.comparisons.angles
        self.assertLess(comparison.rms, 1e-3)
        self.assertEqual(len(comparison.t), 2 * STEPS)
        ratio, ahead = comparison.fundamental()
        self.assertAlmostEqual(ratio, 1.0, places=5)
        self.assertAlmostEqual(ahead, 0.0, places=3)
        self.assertLess(comparison.repeats, 1e-9)
        self.assertTrue(found.ended)
        self.assertEqual(list(found.active), [0, 0])
        self.assertEqual(wanted.content(found.stage, found.values)["insect"]["wing"]["kappa"], found.values[0])

    def test_each_stage_starts_where_the_last_one_ended(self):
        stages = [dict(name="first", fluid="quasi_steady", steps_per_flap=STEPS), dict(name="second", grid="standard")]
        wanted, found, told = self.search(stages=stages)
        self.assertEqual(found[1].stage.changes, {"fluid/solver": "quasi_steady", "time/steps_per_flap": STEPS, "grid": dict(level="standard")})
        self.assertRegex(told[told.index("second (2 of 2)") + 1], "point 1: kappa 7e-05, theta_0 -0.2: rms 0.000 deg")

    def test_a_search_goes_on_without_flying_again(self):
        first = Made(self.folder / "out", ["theta_R"], 2, 2)
        self.search(first)
        self.assertGreater(first.flown, 10)
        second = Made(self.folder / "out", ["theta_R"], 2, 2)
        self.search(second)
        self.assertEqual(second.flown, 0)

    def test_a_flight_that_fails_makes_steps_shorter(self):
        flown = Made(self.folder / "out", ["theta_R"], 2, 2)
        flown.breaks = 1.0001e-4  # behind the start, where the first difference goes
        _, [found], told = self.search(flown)
        np.testing.assert_allclose(found.values, [7e-5, -0.2], rtol=1e-5)
        flown = Made(self.folder / "other", ["theta_R"], 2, 2)
        flown.breaks = 1e-5
        with self.assertRaisesRegex(fit.NoWay, "start values failed: the flow blew up; change unknown"):
            self.search(flown)

    def test_an_end_of_a_range_is_told(self):
        _, [found], _ = self.search(unknown={KAPPA: dict(start=1e-4, range=[9e-5, 2e-4]), REST: dict(start=0.1, range=[-0.5, 0.4])})
        self.assertEqual(list(found.active), [-1, 0])
        self.assertAlmostEqual(found.values[0], 9e-5, delta=1e-9)

    def test_a_table_that_ends_too_soon(self):
        with self.assertRaisesRegex(fit.NoWay, "measured.csv does not cover"):
            self.search(compare=[4, 5])

    def test_one_flap_that_repeats(self):
        content = self.content()
        lines = (self.folder / "measured.csv").read_text(encoding="utf-8").splitlines()
        (self.folder / "flap.csv").write_text("\n".join(lines[:STEPS + 1]) + "\n", encoding="utf-8")
        _, [found], _ = self.search(measured=dict(content["measured"], file="flap.csv", repeats=True), compare=[9])
        np.testing.assert_allclose(found.values, [7e-5, -0.2], rtol=1e-5)

    def test_several_angles_and_a_place_in_a_list(self):
        t = np.arange(0, 4 * STEPS + 1) / (STEPS * FREQUENCY)
        rows = "\n".join(f"{a:.17g},{b:.17g}" for a, b in zip(t, body(-1.5e-3, t) + 0.5))
        (self.folder / "body.csv").write_text(f"t,theta_B_deg\n{rows}\n", encoding="utf-8")
        place = "insect/wing/root/0"
        unknown = dict(self.content()["unknown"], **{place: dict(start=1e-3, range=[-4e-3, 4e-3])})
        told = [dict(angle="theta_R", file="measured.csv"), dict(angle="theta_B", file="body.csv", weight=0.5)]
        flown = Made(self.folder / "out", ["theta_R", "theta_B"], 2, 2)
        wanted, [found], words = self.search(flown, set={"insect/wing/root": [0.0, 2e-3, 0.0]}, unknown=unknown, measured=told)
        np.testing.assert_allclose(found.values, [7e-5, -1.5e-3, -0.2], rtol=1e-4)  # in the order of the file
        wing, turned = found.comparisons.angles
        self.assertLess(wing.rms, 1e-3)
        self.assertAlmostEqual(turned.rms, 0.5, places=4)  # what was added to what was measured
        self.assertAlmostEqual(found.comparisons.rms, 0.5 * 0.5 / np.sqrt(2), places=4)
        self.assertRegex(words[1], r"root/0 0.001, theta_0 0.1: rms \S+ deg \(theta_R \S+, theta_B \S+\)")
        case = wanted.content(found.stage, found.values)
        self.assertEqual(case["insect"]["wing"]["root"], [found.values[1], 2e-3, 0.0])
        known = confidence.confidence(found.jacobian, found.comparisons.residuals, found.comparisons.independent)
        text = report.case(wanted, [found], known)
        self.assertIn("theta_R of measured.csv and theta_B (weight 0.5) of body.csv", text)
        self.assertIn("# status: place 0, fitted within -0.004 to 0.004", text)
        record = yaml.safe_load(report.record(wanted, [found], known))
        self.assertAlmostEqual(record["stages"][0]["angles"]["theta_B"]["swing_deg"], np.ptp(body(-1.5e-3, t)), places=2)
        self.assertIn("root/0", report.text(wanted, [found], known))
        picture.draw(wanted, [found], self.folder / "residual.png")
        self.assertGreater((self.folder / "residual.png").stat().st_size, 10000)

    def test_the_case_tells_where_its_values_come_from(self):
        wanted, found, _ = self.search()
        known = confidence.confidence(found[-1].jacobian, found[-1].comparisons.residuals, found[-1].comparisons.independent)
        text = report.case(wanted, found, known)
        path = self.folder / "found.yaml"
        path.write_text(text, encoding="utf-8")
        read = case_files.read(path)
        self.assertEqual(read["name"], "found")
        self.assertAlmostEqual(read["insect"]["wing"]["kappa"], 7e-5, delta=1e-9)
        self.assertEqual(read["time"], dict(steps_per_flap=STEPS, flaps=3))
        comments, heading = case_files.comments(path)
        self.assertIn("Made by monarch identify", heading)
        self.assertRegex(comments[KAPPA], r"^status: fitted within 2e-05 to 0.0002, standard deviation ")
        self.assertIn("Table 1; status: given", comments["motion/frequency"])
        record = yaml.safe_load(report.record(wanted, found, known))
        self.assertEqual(record["unknowns"][KAPPA]["at_end"], "none")
        self.assertIn("determined", report.text(wanted, found, known))


class Faults(Folder):
    def test_all_at_once(self):
        text = self.faults(case="pasive_pitch", compare=[0], difference=2, unknown={KAPPA: dict(start=1, range=[2, 3]), REST: 5},
                           measured=dict(angle="theta", series="monarch"), stages=[dict(air="thin")], unknwn={})
        for part in ("case: 'pasive_pitch': neither a shipped case nor a file; did you mean 'passive_pitch'?", "unknwn: unknown; did you mean",
                     "compare: [0]: must be a list of flaps", "difference: 2: must be in [1e-6, 0.1]",
                     f"unknown/{KAPPA}: start = 1: must lie within its range, 2 to 3", f"unknown/{REST}: must be {{start: number",
                     "measured: angle = theta: must be one of theta_R", "stages[1]: has air: must have name, fluid, grid, steps_per_flap only"):
            self.assertIn(part, text)

    def test_measured(self):
        self.assertIn("series = moth: there is none of this name; known are bumblebee, fruit_fly, hawkmoth, monarch", self.faults(measured=dict(angle="theta_R", series="moth")))
        self.assertIn("series = monarch: has no yaw_deg", self.faults(measured=dict(angle="yaw", series="monarch")))
        self.assertIn("has columns t, theta_R_deg: must have t [s] and phi", self.faults(measured=dict(angle="phi", file="measured.csv")))
        self.assertIn("nowhere.csv cannot be read", self.faults(measured=dict(angle="phi", file="nowhere.csv")))
        (self.folder / "short.csv").write_text("t,phi\n0,1\n1,2\n", encoding="utf-8")
        self.assertIn("six rows or more", self.faults(measured=dict(angle="phi", file="short.csv")))

    def test_several_measured(self):
        wing = dict(angle="theta_R", series="monarch")
        self.assertIn("angle = theta_R: stands twice", self.faults(measured=[wing, wing]))
        self.assertIn("weight = 0: must be a number above 0", self.faults(measured=[dict(wing, weight=0)]))
        self.assertIn("must be {angle, series}", self.faults(measured=[]))

    def test_a_place_that_the_list_has_not(self):
        self.assertIn("3 is no place in this list of 3", self.faults(set={"insect/wing/root": [0, 0, 0]},
                                                                     unknown={"insect/wing/root/3": dict(start=1, range=[0, 2])}))

    def test_a_key_below_a_number(self):
        self.assertIn("insect/wing/root/0: root is no list of the case",
                      self.faults(unknown={"insect/wing/root/0": dict(start=0, range=[-1, 1])}))
        self.assertIn("insect/preset/x: preset is no section", self.faults(unknown={"insect/preset/x": dict(start=1, range=[0, 2])}))

    def test_the_command(self):
        for words, told in ((["nowhere.yaml"], "neither a study of config/studies nor a file"), ([], None),
                            (["passive_pitch", "jobs:=0"], "jobs:=0: must be a whole number from 1 to 1024")):
            errors = io.StringIO()
            with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
                if told is None:
                    with self.assertRaises(SystemExit):
                        monarch(["identify", *words])
                    continue
                self.assertEqual(monarch(["identify", *words]), 2)
            self.assertIn(told, errors.getvalue())

    def test_shipped_studies_are_read(self):
        for path in (ROOT / "config/studies").glob("*.yaml"):
            self.assertTrue(study.read(path).stages, path)


if __name__ == "__main__":
    unittest.main()
