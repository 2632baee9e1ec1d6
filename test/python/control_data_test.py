"""What the figures of controlled flights are drawn from, and the summary's line of guidance."""
import math
import pathlib
import sys
import tempfile
import types
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import led_flights as made  # noqa: E402
from monarch_flight.figures import control_data as control  # noqa: E402
from monarch_flight.runs import summary  # noqa: E402
from monarch_flight.settling.led_flight import LedFlight  # noqa: E402


class Controlled(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def flight(self, name, columns=None, kind="controller", **changes):
        case = made.case() | changes
        case["guidance"]["type"] = kind
        return LedFlight(made.write(self.folder / name, case, columns or made.columns()))

    def tumbling(self):
        columns = made.columns()
        columns["theta_B"] = np.where(columns["phase"] > 2.5, 2.0, 0.3)
        return columns

    def test_pairs(self):
        led, alone = self.flight("led"), self.flight("alone", kind="motion")
        other = self.flight("other", kind="motion", insect=dict(kind="moth"))
        windy = self.flight("windy", kind="motion", fluid=dict(solver="quasi_steady", wind=[1, 0, 0]))
        flow = self.flight("flow", fluid=dict(solver="navier_stokes"))
        pairs = control.pairs([other, windy, flow, alone, led])
        self.assertEqual(pairs, {"control_quasi_steady": (led, alone), "control_navier_stokes": (flow, None)})
        again = self.flight("again")
        self.assertEqual(set(control.pairs([led, again])), {"control_quasi_steady_led", "control_quasi_steady_again"})

    def test_given_runs(self):
        self.flight("led")
        settings = types.SimpleNamespace(given=[self.folder / "led"])
        self.assertEqual([flight.folder.name for flight in control.flights(settings)], ["led"])
        settings.given.append(self.folder / "nowhere")
        with self.assertRaisesRegex(SystemExit, "nowhere/case.yaml: does not exist"):
            control.flights(settings)

    def test_flap_means_end_with_the_tumbling(self):
        middles, climbs, speeds = control.flap_means(self.flight("steady"))
        np.testing.assert_allclose(middles, np.arange(6) + 0.5)
        np.testing.assert_allclose(climbs, math.degrees(math.atan2(0.4, 1.2)), atol=1e-9)
        np.testing.assert_allclose(speeds, math.hypot(0.4, 1.2), atol=1e-9)
        flight = self.flight("tumbling", self.tumbling(), kind="motion")
        self.assertEqual(control.tumbled_from(flight), 51)
        phase = flight.columns["phase"][control.rows_shown(flight)]
        self.assertAlmostEqual(phase[-1], 3.55)
        np.testing.assert_allclose(control.flap_means(flight)[0], [0.5, 1.5, 2.5])

    def test_turns_are_counted_whole_and_the_speed_is_that_in_space(self):
        c = made.columns(velocity=(1.2, 0.0))
        c["y"], c["vy"] = 0.9 * c["t"], c["vy"] + 0.9
        c["yaw"] = np.angle(np.exp(1j * 1.3 * c["phase"]))
        case_ = made.case()
        case_["free"] = dict(case_["free"], y=True, roll=True, yaw=True)
        case_["guidance"]["controller"]["set_points"]["headings_deg"] = [0, 90]
        case_["guidance"]["controller"]["lateral"] = dict(inputs="differential_rest_angle")
        flight = LedFlight(made.write(self.folder / "turning", case_, c))
        self.assertTrue(flight.turns)
        np.testing.assert_allclose(flight.heading(), 1.3 * c["phase"], atol=1e-9)
        self.assertAlmostEqual(flight.flaps[2].speed, 1.5, places=9)
        self.assertEqual(flight.headings(), [(0, 0), (1, 90)])
        self.assertIn("differential_rest_angle", flight.used)

    def test_set_points_commands_wind(self):
        flight = self.flight("led", made.columns(means=dict(amplitude=0.04, deviation_mean=0.02), wind=(0.5, 0.1)))
        self.assertEqual(control.set_point_steps(flight), ([0, 1, 6], [0, 20], [1.0, 1.3]))
        values, limits = control.command(flight, "amplitude")
        np.testing.assert_allclose(values, 4.0)
        np.testing.assert_allclose(limits, [-30, 20])
        np.testing.assert_allclose(control.command(flight, "deviation_mean")[0], math.degrees(0.02))
        x, east, up = control.wind(flight)
        np.testing.assert_allclose([x[0], up[0]], [0.5, -0.1])
        self.assertIsNone(control.wind(self.flight("still")))
        self.assertEqual(control.set_point_steps(self.flight("alone", kind="motion")), ([], [], []))


class Summary(unittest.TestCase):
    def test_guidance(self):
        told = dict(type="controller", clipped=3, refused=1, lost_from_flap=None)
        self.assertEqual(summary.guidance(told), "controller, 3 commands cut to their bounds, 1 refused")
        self.assertEqual(summary.guidance(told | dict(clipped=1, refused=0, lost_from_flap=7)),
                         "controller, 1 command cut to its bounds, 0 refused, lost from flap 7")
        spread, figures = dict(min=0, mean=0, max=0), dict(sub_iterations={}, fluid_evaluations={}, added_mass_ratio={})
        whole = {key: value | spread for key, value in figures.items()} | dict(
            steps=1, flaps=1, retried_steps=0, climb_angle_deg=0, speed_m_s=0, theta_B_deg=spread, theta_R_deg=spread, cells=0,
            wall_s=dict.fromkeys(("total", "fluid", "flight", "wing", "exchange", "coupling", "outputs"), 0), state_sha256="")
        for guidance, lines in ((told, 1), (told | dict(type="motion"), 0), (None, 0)):
            shown = dict(summary.table(whole | (dict(guidance=guidance) if guidance else {})))
            self.assertEqual("guidance" in shown, bool(lines))


if __name__ == "__main__":
    unittest.main()
