"""The mirror in which a fluid in Python sees the left wing."""
import pathlib
import sys
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight import mirror  # noqa: E402


def vector(*values):
    return types.SimpleNamespace(**dict(zip("xyzw", values)))


def request():
    def body():
        return types.SimpleNamespace(
            position=vector(1, 2, 3), velocity=vector(1, 2, 3), acceleration=vector(1, 2, 3),
            orientation=vector(1, 2, 3, 4), angular_velocity=vector(1, 2, 3), angular_acceleration=vector(1, 2, 3), pitch=5)

    return types.SimpleNamespace(
        interface=types.SimpleNamespace(body=body(), theta_right="right", theta_left="left"),
        prescribed=types.SimpleNamespace(body=body(), right_wing="right", left_wing="left", wind=vector(1, 2, 3),
                                         wind_change=vector(1, 2, 3)),
        right_loads="right", left_loads="left")


class Mirror(unittest.TestCase):
    def test_polar_and_axial_vectors(self):
        seen = mirror.mirrored(request())
        body = seen.interface.body
        self.assertEqual(vars(body.velocity), dict(x=1, y=-2, z=3))
        self.assertEqual(vars(body.angular_velocity), dict(x=-1, y=2, z=-3))
        self.assertEqual(vars(body.orientation), dict(x=-1, y=2, z=-3, w=4))
        self.assertEqual(vars(seen.prescribed.wind_change), dict(x=1, y=-2, z=3))
        self.assertEqual((seen.interface.theta_right, seen.prescribed.right_wing, seen.right_loads), ("left",) * 3)

    def test_twice_is_nothing_and_the_request_stays(self):
        given = request()
        self.assertEqual(repr(mirror.mirrored(mirror.mirrored(given))), repr(request()))
        self.assertEqual(repr(given), repr(request()))

    def test_a_wing_of_its_own(self):
        case = {"insect": {"wing": {"mass": 1, "planform": {"a": 1, "b": 2}}, "left_wing": {"planform": {"b": 3}}}}
        self.assertEqual(mirror.case_of_wing(case, True)["insect"]["wing"], {"mass": 1, "planform": {"a": 1, "b": 3}})
        self.assertEqual(mirror.case_of_wing(case, False), case)
        self.assertEqual(case["insect"]["wing"]["planform"]["b"], 2)


if __name__ == "__main__":
    unittest.main()
