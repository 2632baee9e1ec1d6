"""The estimate of what the other wing and the body would change: exact solutions, and the geometry of a flight."""
import contextlib
import csv
import io
import pathlib
import sys
import tempfile
import unittest

try:
    import numpy as np
    import yaml
except ModuleNotFoundError:  # scripts/install check brings them
    np = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
if np:
    from monarch_flight import keys
    from monarch_flight.neighbours import estimate, exact, flown, lattice, table


@unittest.skipUnless(np, "needs scripts/install check")
class Exact(unittest.TestCase):
    def check(self, rows):
        self.assertTrue(rows)
        for row in rows:
            self.assertTrue(row["pass"], row)

    def test_a_plate_alone(self):
        self.check(exact.alone())

    def test_a_plate_and_its_mirror_image(self):
        self.check(exact.beside_the_mirror())

    def test_lift_slope_and_sudden_start(self):
        self.check(exact.with_a_wake())

    def test_the_body(self):
        self.check(exact.the_body())

    def test_it_converges(self):
        coarse, middle, fine, finest = (exact.broadside(*exact.rectangle(1.0, 2.0, n, n)) for n in (4, 8, 16, 24))
        self.assertGreater(abs(coarse - finest), 2.0 * abs(middle - finest))
        self.assertGreater(abs(middle - finest), 2.0 * abs(fine - finest))

    def test_an_image_far_away_is_none(self):
        nodes, points = exact.ellipse(1.0, 1.0, 6, 6)
        self.assertAlmostEqual(exact.broadside(nodes, points, 1e3), exact.broadside(nodes, points), delta=1e-8)

    def test_no_air_passes_the_mirror(self):
        nodes, _ = exact.ellipse(1.0, 1.0, 4, 4)
        place = np.array([[0.3, 0.0, 0.2], [2.0, 0.0, -1.0]])
        air = lattice.influence(exact.facing(nodes, 0.7), place, True)
        self.assertLess(np.abs(air[..., 1]).max(), 1e-14)


@unittest.skipUnless(np, "needs scripts/install check")
class Flights(unittest.TestCase):
    def folder(self, phi, flaps=2.0, wings="mirrored", **angles):
        """A flight whose right wing, a rectangle of 40 mm by 20 mm, stands still at this angle in a body that glides."""
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        folder = pathlib.Path(place.name)
        planform = {"type": "rectangle", "chord": 0.02, "span": 0.04, "hinge": 0.25, "root_offset": 0.0}
        part = {"mass": 1e-4, "length": 0.01, "width": 0.005}
        case = {"wings": wings, "fluid": {"density": 1.2, "gravity": 9.81}, "insect": {
            "kind": "butterfly", "beta": 0.0, "body": part, "abdomen": part,
            "wing": {"mass": 1e-5, "root": [0.0, 0.003, 0.0], "planform": planform}}}
        (folder / "case.yaml").write_text(yaml.safe_dump(case), encoding="utf-8")
        with open(folder / "flight.csv", "w", encoding="utf-8") as file:
            lines = csv.DictWriter(file, flown.NAMES)
            lines.writeheader()
            for k in range(int(round(40 * flaps)) + 1):
                state = dict(t=k / 400, phase=k / 40, qw=1.0, phi=phi, x=k / 400, z=k / 4000)
                lines.writerow(dict.fromkeys(flown.NAMES, 0.0) | state | angles)
        return str(folder)

    def test_where_the_wing_is(self):
        flight = flown.Flight(self.folder(np.radians(-60.0)))
        self.assertAlmostEqual(flight.outline.area, 8e-4, delta=1e-9)
        tip = flight.in_body(np.array([0.0, 0.04, 0.0]), 0)
        np.testing.assert_allclose(tip, [0.0, 0.003 + 0.02, -0.04 * np.sin(np.radians(60.0))], atol=1e-12)
        self.assertAlmostEqual(flown.clearance(flight, [3])[0], 0.003, delta=1e-12)
        self.assertAlmostEqual(flown.clearance(flown.Flight(self.folder(np.radians(-100.0))), [3])[0],
                               0.003 - 0.04 * np.sin(np.radians(10.0)), delta=1e-12)

    def test_deviation_leads_the_tip_forward_and_pitch_lifts_the_leading_edge(self):
        flight = flown.Flight(self.folder(0.0, psi=0.3, theta_R=0.2))
        ahead, tip = (flight.in_body(np.array(place), 0) - flight.root for place in ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
        np.testing.assert_allclose(tip, [np.sin(0.3), np.cos(0.3), 0.0], atol=1e-12)
        self.assertAlmostEqual(ahead[2], -np.sin(0.2), delta=1e-12)

    def test_the_shipped_outline_has_the_size_of_the_paper(self):
        insects = ROOT / "config" / "insects"
        planform = yaml.safe_load((insects / "monarch_paper.yaml").read_text(encoding="utf-8"))["wing"]["planform"]
        with open(insects / planform["file"], encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        planform["stations"] = {key: [float(row[key]) for row in rows] for key in ("y", "leading", "trailing")}
        outline = flown.Outline(planform)
        self.assertAlmostEqual(outline.y_tip - outline.y_root, planform["scale_span"], delta=1e-9)
        self.assertAlmostEqual(outline.area, planform["scale_area"], delta=1e-9)
        swept = flown.Outline({**planform, "sweep": np.arctan(0.2)})
        self.assertAlmostEqual(float(swept.leading(0.03) - outline.leading(0.03)), -0.006, delta=1e-12)
        self.assertAlmostEqual(swept.area, outline.area, delta=1e-12)

    def test_wings_that_glide_side_by_side_lift_more(self):
        fly = estimate.Estimate(flown.Flight(self.folder(0.0)), chordwise=4, spanwise=6, steps=20, gap=1e-4)
        alone, beside = (fly.fly(mirrored=mirrored, kutta=False)[1:] for mirrored in (False, True))
        self.assertLess(np.abs(alone[:, :3]).max(), 1e-9)  # at constant speed no force without a wake
        self.assertEqual(alone.shape, beside.shape)
        alone, beside = (fly.fly(mirrored=mirrored)[-1] for mirrored in (False, True))
        self.assertLess(alone[2], 0.0)  # NED: up
        self.assertLess(beside[2], 1.05 * alone[2])
        self.assertGreater(beside[2], 2.0 * alone[2])

    def test_bent_aside(self):
        y = np.array([-0.01, 0.0, 0.003, 0.02])
        moved = estimate.bent(np.stack([0 * y, y, 0 * y], axis=-1), 1e-3)[:, 1]
        self.assertTrue((moved > 0.5e-3).all() and (np.diff(moved) > 0).all())
        self.assertLess(moved[3] - y[3], 2e-5)

    def test_what_cannot_be_estimated_is_refused(self):
        for options, fault in ((dict(flaps=1.0), "2 or more"), (dict(wings="independent"), "wings:=mirrored"),
                               (dict(wx=1.0), "still air")):
            with self.assertRaisesRegex(keys.Refused, fault):
                flown.Flight(self.folder(0.0, **options))
        with self.assertRaisesRegex(keys.Refused, "give the folder of a flight"):
            flown.Flight("/nowhere")

    def test_a_flight_that_was_lost_is_refused(self):
        folder = pathlib.Path(self.folder(0.0))
        for text in ("", ",".join(flown.NAMES) + "\n", "t,phase\n0,2\n"):
            (folder / "flight.csv").write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(keys.Refused, "fly it again"):
                flown.Flight(str(folder))

    def test_the_table(self):
        folder = self.folder(0.0, FZ=-1e-3, my=1e-5)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(table.told(folder, dict(chordwise=3, spanwise=4, steps=20)), 0)
        for title in table.TITLES.values():
            self.assertIn(title, said.getvalue())
        self.assertNotIn("nan", said.getvalue())
        with open(folder + "/neighbours.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 20)
        for name in ("FZ_alone", "hinge_sealed", "FX_wing_no_wake"):
            self.assertIn(name, rows[0])
        self.assertLess(float(rows[-1]["FZ_wing"]), float(rows[-1]["FZ_alone"]))  # NED: up


if __name__ == "__main__":
    unittest.main()
