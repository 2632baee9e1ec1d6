"""Wing and body of a recorded flight, from its case.yaml and flight.csv (docs/run_files.md). SI units."""
import csv
import os

import numpy as np
import yaml

from monarch_flight.keys import Refused

NAMES = "t phase x y z qw qx qy qz phi psi theta_R my FX FZ wx wy wz".split()


class Outline:
    """Edges of a wing over y, wing axes: functions leading and trailing from y_root to y_tip; area."""

    def __init__(self, planform):
        kind = planform["type"]
        if kind in ("rectangle", "ellipse"):
            self.shape(planform, kind)
        else:
            self.stations(planform, kind)
        self.sweep(np.tan(planform.get("sweep", 0.0)))
        y = np.linspace(self.y_root, self.y_tip, 2001)
        self.area = float(np.sum((self.leading(y) - self.trailing(y))[:-1])) * (y[1] - y[0])

    def sweep(self, slope):
        """Moves every chord back by slope times y."""
        front, back = self.leading, self.trailing
        self.leading, self.trailing = (lambda y: front(y) - slope * y), (lambda y: back(y) - slope * y)

    def shape(self, planform, kind):
        chord, span, hinge = (planform[key] for key in ("chord", "span", "hinge"))
        self.y_root = planform["root_offset"]
        self.y_tip = self.y_root + span

        def edge(y, part):
            s = 2.0 * (y - self.y_root) / span - 1.0
            half = 0.5 * chord * (np.sqrt(np.maximum(0.0, 1.0 - s * s)) if kind == "ellipse" else np.ones_like(s))
            return (hinge - 0.5) * chord + part * half

        self.leading, self.trailing = (lambda y: edge(y, 1.0)), (lambda y: edge(y, -1.0))

    def stations(self, planform, kind):
        y, front, back = (np.array(planform["stations"][key], float) for key in ("y", "leading", "trailing"))
        unit = planform["unit"]
        y = (y + planform["root_offset"]) * unit
        front, back = (front - planform["hinge"]) * unit, (back - planform["hinge"]) * unit
        self.y_root, self.y_tip = y[0], y[-1]
        if kind == "polynomial_csv":
            fits = [np.polynomial.Polynomial.fit(y, edge, planform["order"]) for edge in (front, back)]
        else:
            fits = [lambda at, edge=edge: np.interp(at, y, edge) for edge in (front, back)]
        self.leading = lambda at: np.where(fits[0](at) < fits[1](at), 0.5 * (fits[0](at) + fits[1](at)), fits[0](at))
        self.trailing = lambda at: np.where(fits[0](at) < fits[1](at), 0.5 * (fits[0](at) + fits[1](at)), fits[1](at))
        self.scale(planform)

    def scale(self, planform):
        span, area = planform.get("scale_span", "none"), planform.get("scale_area", "none")
        if span == "none" and area == "none":
            return
        y = np.linspace(self.y_root, self.y_tip, 2001)
        now = float(np.sum((self.leading(y) - self.trailing(y))[:-1])) * (y[1] - y[0])
        along = span / (self.y_tip - self.y_root) if span != "none" else 1.0
        across = area / (now * along) if area != "none" else 1.0
        front, back = self.leading, self.trailing
        self.leading, self.trailing = (lambda at: across * front(at / along)), (lambda at: across * back(at / along))
        self.y_root, self.y_tip = along * self.y_root, along * self.y_tip


def turned(axis, angle):
    """Rotations about x, y or z by these angles: (..., 3, 3)."""
    c, s, one, nil = np.cos(angle), np.sin(angle), np.ones_like(angle), np.zeros_like(angle)
    rows = {"x": [one, nil, nil, nil, c, -s, nil, s, c], "y": [c, nil, s, nil, one, nil, -s, nil, c],
            "z": [c, -s, nil, s, c, nil, nil, nil, one]}[axis]
    return np.stack(rows, axis=-1).reshape(*np.shape(angle), 3, 3)


class Flight:
    """A recorded flight: rows of flight.csv, attitude of body (R_IB) and right wing (R_BW)."""

    def __init__(self, folder):
        for name in ("case.yaml", "flight.csv"):
            if not os.path.isfile(os.path.join(folder, name)):
                raise Refused(f"{folder}: no {name} in it; give the folder of a flight")
        with open(os.path.join(folder, "case.yaml"), encoding="utf-8") as file:
            self.case = yaml.safe_load(file)
        with open(os.path.join(folder, "flight.csv"), encoding="utf-8") as file:
            table = list(csv.DictReader(file))
        missing = [name for name in NAMES if not table or name not in table[0]]
        if missing:
            raise Refused(f"{folder}: flight.csv has no row with {missing[0]}; fly it again")
        for name in NAMES:
            setattr(self, name, np.array([float(row[name]) for row in table]))
        self.require(folder)
        insect = self.case["insect"]
        self.outline = Outline(insect["wing"]["planform"])
        self.root = np.array(insect["wing"]["root"], float)
        self.density = self.case["fluid"]["density"]
        self.weight = self.case["fluid"]["gravity"] * (
            insect["body"]["mass"] + insect["abdomen"]["mass"] + 2 * insect["wing"]["mass"])
        w, x, y, z = self.qw, self.qx, self.qy, self.qz
        self.R_IB = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                              2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                              2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1).reshape(-1, 3, 3)
        self.R_BW = (turned("y", np.float64(insect["beta"])) @ turned("x", self.phi) @ turned("z", -self.psi)
                     @ turned("y", self.theta_R))

    def require(self, folder):
        faults = []
        if self.case["insect"]["kind"] != "butterfly":
            faults.append(f"{folder}: a bare wing has no neighbour")
        if self.case["wings"] != "mirrored":
            faults.append(f"{folder}: flown with wings:=independent; fly it with wings:=mirrored")
        if self.phase[-1] < 2.0:
            faults.append(f"{folder}: {self.phase[-1]:g} flaps: 2 or more are needed; fly it with flaps:=2")
        if np.any(self.wx) or np.any(self.wy) or np.any(self.wz):
            faults.append(f"{folder}: flown in wind; fly it in still air")
        if faults:
            raise Refused(*faults)

    def in_body(self, points, row):
        """Points of the right wing, wing axes, in body axes from the body's mass centre."""
        return self.root + points @ self.R_BW[row].T

    def in_air(self, points, row):
        """Points in body axes in NED."""
        return np.array([self.x[row], self.y[row], self.z[row]]) + points @ self.R_IB[row].T


def clearance(flight, rows, inner=0.0):
    """Smallest distance of the wing's outline from the body's mid-plane at each row [m], negative where it crosses
    it; of what lies farther out than this part of the span."""
    outline = flight.outline
    y = np.linspace(outline.y_root + inner * (outline.y_tip - outline.y_root), outline.y_tip, 60)
    rim = np.concatenate([np.stack([edge(y), y, 0.0 * y], axis=-1) for edge in (outline.leading, outline.trailing)])
    return np.array([flight.in_body(rim, row)[:, 1].min() for row in rows])
