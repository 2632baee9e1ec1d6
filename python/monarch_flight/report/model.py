"""The shape of a run's insect: links, joints and surfaces, as insect_model writes them of its case."""
import os
import subprocess
import tempfile
import xml.etree.ElementTree

import numpy as np

from monarch_flight import places
from monarch_flight.keys import Refused
from monarch_flight.runs import environment

# Columns of flight.csv that turn the joints of the URDF; the left wing is told as the mirror image of a right one there and here.
ANGLES = dict(right_flap="phi", right_deviation="psi", right_pitch="theta_R", left_flap="phi_L", left_deviation="psi_L",
              left_pitch="theta_L", abdomen_joint="theta_A")
ALONG, ACROSS = 40, 9  # points of a wing's surface, from root to tip and from the trailing to the leading edge


def triangles(path):
    """Corners of a binary STL file, an array (n, 3, 3) [m]."""
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    return np.fromfile(path, kind, offset=84)["corners"]


def wing_points(corners):
    """Points of a flat wing, an array (ALONG, ACROSS, 2) of x and y in its axes, between the edges of its outline."""
    x, y = corners[..., 0].ravel(), corners[..., 1].ravel()
    stations = np.unique(y)
    stations = stations[np.argsort(np.abs(stations))]
    trailing, leading = (np.array([limit(x[y == station]) for station in stations]) for limit in (np.min, np.max))
    kept = np.linspace(0, len(stations) - 1, ALONG)  # the stations lie closer at root and tip
    place = np.arange(len(stations))
    s = np.linspace(0, 1, ACROSS)
    back, front, along = (np.interp(kept, place, values) for values in (trailing, leading, stations))
    return np.stack([back[:, None] + s * (front - back)[:, None], np.repeat(along[:, None], ACROSS, 1)], axis=-1)


def numbers(text):
    return [float(word) for word in text.split()]


def joints(urdf):
    """[{name, parent, child, xyz, rpy, axis}] from the body outwards."""
    found = []
    for joint in xml.etree.ElementTree.fromstring(urdf).iter("joint"):
        origin, axis = joint.find("origin"), joint.find("axis")
        found.append(dict(name=joint.get("name"), parent=joint.find("parent").get("link"), child=joint.find("child").get("link"),
                          xyz=numbers(origin.get("xyz", "0 0 0")), rpy=numbers(origin.get("rpy", "0 0 0")),
                          axis=numbers(axis.get("xyz")) if axis is not None else None))
    return found


class Model:
    """`joints`; `solids`: {link: corners} of thorax and abdomen; `wings`: {link: wing_points}; `span` [m]; `mass` of
    all [kg]."""

    def __init__(self, folder):
        with tempfile.TemporaryDirectory() as place:
            out = os.path.join(place, "model")
            command = [places.program("insect_model"), f"case:={folder / 'case.yaml'}", f"out:={out}"]
            try:
                done = subprocess.run([str(word) for word in command], env=environment.of_flight(os.environ), check=False,
                                      capture_output=True, text=True, timeout=60)
            except (OSError, subprocess.TimeoutExpired) as error:
                raise Refused(f"the shape of the insect: insect_model does not answer: {error}") from None
            if done.returncode:
                raise Refused(f"{folder / 'case.yaml'}: no shape of the insect: {done.stderr.strip()}")
            self.joints = joints(done.stdout)
            masses = xml.etree.ElementTree.fromstring(done.stdout).iter("mass")
            self.mass = sum(float(mass.get("value")) for mass in masses)
            surfaces = {name[:-4]: triangles(os.path.join(out, name)) for name in sorted(os.listdir(out))}
        self.wings = {name: wing_points(corners) for name, corners in surfaces.items() if name.endswith("_wing")}
        links = dict(thorax="body_frd", abdomen="abdomen")
        self.solids = {links[name]: corners for name, corners in surfaces.items() if name in links}
        self.span = float(np.ptp(self.wings["right_wing"][..., 1]))
