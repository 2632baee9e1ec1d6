"""The film of a flight: what its frames show, and what it refuses. The frames themselves: test/flights/film_test.py."""
import pathlib
import sys
import tempfile
import types
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight import keys  # noqa: E402
from monarch_flight.command import film as command  # noqa: E402
from monarch_flight.film import flight as recorded  # noqa: E402
from monarch_flight.film import views  # noqa: E402


def message(**fields):
    return types.SimpleNamespace(**fields)


def block(value, size=(2, 2, 2)):
    n = int(np.prod(size))
    return recorded.Block(message(size=size, origin=message(x=0.1, y=0.2, z=0.3), spacing=0.5, step=2.0,
                                  q_root=(value,) * n, vorticity=(-value,) * n))


def transform(parent, child, place, yaw=0.0):
    turned = message(x=0.0, y=0.0, z=np.sin(yaw / 2), w=np.cos(yaw / 2))
    return message(header=message(frame_id=parent), child_frame_id=child,
                   transform=message(translation=message(x=place[0], y=place[1], z=place[2]), rotation=turned))


def climb(steps=101, period=0.1):
    """A flight to the north at 1 m/s with a bob of every flap, its wing half a metre before the turned body."""
    flight = object.__new__(recorded.Flight)
    flight.parents, flight.fixed, flight.prefix = {}, {}, "a/"
    flight.poses, flight.pressure, flight.flow = recorded.Series(), {}, {}
    flight.case = {"motion": {"frequency": 1 / period}}
    for i in range(steps):
        t = i * 3 * period / (steps - 1)
        place = (0.0, t, 0.02 * np.sin(2 * np.pi * t / period))
        moving = message(_type="tf2_msgs/TFMessage",
                         transforms=[transform("world", "a/base_link", place, np.pi / 2),
                                     transform("a/base_link", "a/right_wing", (0.5, 0.0, 0.0))])
        flight.take("/tf", moving, t)
    return flight


class RecordedFlight(unittest.TestCase):
    def test_poses_are_chained_to_world(self):
        flight = climb()
        pose = flight.pose("right_wing", 0.3)
        np.testing.assert_allclose(pose[:3, 3], (0.0, 0.3 + 0.5, 0.0), atol=1e-12)
        np.testing.assert_allclose(pose[:3, 0], (0.0, 1.0, 0.0), atol=1e-12)

    def test_between_two_pictures_lies_their_mean(self):
        series = recorded.Series()
        series.add(1.0, "a")
        series.add(2.0, "b")
        self.assertEqual(("a", "b", 0.25), series.around(1.25))
        self.assertEqual("b", series.around(2.5)[1])
        self.assertEqual("a", series.nearest(1.4))
        mean = block(10).towards(block(30), 0.25)
        np.testing.assert_allclose(mean.q_root, 2.0 * 15.0)
        np.testing.assert_allclose(mean.omega, -2.0 * 15.0)
        other = block(7, size=(1, 2, 2))
        self.assertIs(other, block(10).towards(other, 0.75))  # points elsewhere are not mixed

    def test_a_mirrored_wing_has_the_image_of_the_right_one(self):
        flight = climb()
        rows = np.zeros((1, 8), dtype=np.float32)
        rows[0] = 1, 2, 0, 3, 4, 5, 6, -1
        flight.pressure["right_wing"] = recorded.Series()
        flight.pressure["right_wing"].add(0.0, message(data=rows.tobytes()))
        np.testing.assert_allclose(flight.facets("right_wing", 0.1), [[1, 2, 3, 4, 5, 6]])
        np.testing.assert_allclose(flight.facets("left_wing", 0.1), [[1, -2, 3, 4, 5, 6]])
        self.assertIsNone(flight.block("right_wing", 0.1))


class Camera(unittest.TestCase):
    def test_follows_the_body_without_the_wingbeat(self):
        flight = climb()
        focus, position, up = views.Camera(flight, "side", 2.0).at(0.15)
        np.testing.assert_allclose(focus[:2], (0.0, 0.15), atol=0.005)
        self.assertAlmostEqual(focus[2], -2.0 * views.BELOW, delta=0.002)  # of a bob of 20 mm
        self.assertAlmostEqual(2.0, np.linalg.norm(position - focus), places=9)
        self.assertGreater(position[0], 1.9)  # to the right of a flight to the north
        np.testing.assert_allclose(up, (0, 0, 1))
        self.assertLess(views.Camera(flight, "chase", 2.0).at(0.15)[1][1], -1.0)

    def test_smoothing_keeps_a_straight_line(self):
        line = np.arange(20.0)[:, None]
        for width in (1, 4, 7, 100):
            np.testing.assert_allclose(views.smooth(line, width), line, atol=1e-12)


class Words(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.run = pathlib.Path(self.folder.name)
        (self.run / "flight.bag").write_bytes(b"")

    def tearDown(self):
        self.folder.cleanup()

    def refused(self, *words):
        with self.assertRaises(keys.Refused) as caught:
            command.settings(list(words))
        return "\n".join(caught.exception.faults)

    def test_the_film_stands_beside_the_bag(self):
        bag, out, wanted = command.settings([str(self.run), "size:=320x180", "from:=1"])
        self.assertEqual((self.run / "flight.bag", self.run / "film.mp4"), (bag, out))
        self.assertEqual(((320, 180), 1.0, "oblique"), (wanted["size"], wanted["from"], wanted["view"]))
        self.assertEqual((640, 360), command.settings([str(self.run), str(self.run / "a.gif")])[2]["size"])

    def test_faults_are_told_together(self):
        told = self.refused(str(self.run), str(self.run / "film.avi"), "opacity:=2", "size:=321x180", "to:=1",
                            "from:=2")
        for words in ("must end with .mp4 or .gif", "opacity:=2: must be above 0, up to 1", "two even numbers",
                      "to:=1: must be above from:=2"):
            self.assertIn(words, told)
        self.assertIn("does not exist", self.refused(str(self.run / "nothing")))


if __name__ == "__main__":
    unittest.main()
