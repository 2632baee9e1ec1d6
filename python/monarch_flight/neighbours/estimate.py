"""A flown motion of the wings once more in potential flow: alone, beside the other wing, beside the body.

Each variant is the same motion; the differences are what a flow solver of one wing leaves out. The motion is that of
flight.csv. Wings that cross the mid-plane would meet there: they are bent so that they stay `gap` away from it."""
import numpy as np

from monarch_flight.neighbours import lattice, spheroid, wake

VARIANTS = {  # the other wing, the body, Kutta's condition, roots moved to the mid-plane
    "alone": dict(), "wing": dict(mirrored=True), "body": dict(body=True), "both": dict(mirrored=True, body=True),
    "sealed": dict(mirrored=True, sealed=True),
    "alone, no wake": dict(kutta=False), "wing, no wake": dict(kutta=False, mirrored=True)}


def bent(points, gap):
    """Points in body axes, none nearer than half the gap to the mid-plane; a point on it goes to 0.8 gaps, one three
    gaps away moves by a tenth of a gap."""
    s = points[..., 1] - 0.5 * gap
    moved = points.copy()
    moved[..., 1] = 0.5 * gap + 0.5 * (s + np.sqrt(s * s + gap * gap))
    return moved


class Estimate:
    """The last two flaps of a flight, again in potential flow."""

    def __init__(self, flight, chordwise=6, spanwise=10, steps=63, gap=1e-3, core=0.1):
        """core: of the wake's vortices, in mean chords; steps: of a flap."""
        self.flight, self.gap = flight, gap
        outline = flight.outline
        self.core = core * outline.area / (outline.y_tip - outline.y_root)
        self.lattices = {kutta: lattice.grid(outline.leading, outline.trailing, outline.y_root, outline.y_tip, chordwise,
                                             spanwise, kutta) for kutta in (True, False)}
        per_flap = int(round(1.0 / (flight.phase[-1] - flight.phase[-2])))
        stride = max(1, round(per_flap / steps))
        last = len(flight.t) - 2
        self.flap = per_flap // stride  # steps of a flap
        self.rows = np.arange(last - 2 * self.flap * stride, last + 1, stride)
        self.rows = self.rows[self.rows > 0]
        self.dt = flight.t[self.rows[1]] - flight.t[self.rows[0]]

    def place(self, points, row, sealed=False):
        """Points of the wing in body axes, bent aside where they would meet the other wing."""
        placed = self.flight.in_body(points, row)
        if sealed:
            placed[..., 1] -= self.flight.root[1] - self.gap
        return bent(placed, self.gap)

    def moving(self, points, row, sealed):
        """Points in the air and their velocities, by central differences of the rows beside."""
        flight = self.flight
        before, after = (flight.in_air(self.place(points, k, sealed), k) for k in (row - 1, row + 1))
        here = flight.in_air(self.place(points, row, sealed), row)
        return here, (after - before) / (flight.t[row + 1] - flight.t[row - 1])

    def drives(self, points, row):
        """Velocity of the air, NED, at points (in the air) that thorax and abdomen drive aside as one spheroid."""
        flight, insect = self.flight, self.flight.case["insect"]
        length = insect["body"]["length"] + insect["abdomen"]["length"]
        centre = np.array([0.5 * (insect["body"]["length"] - length), 0.0, 0.0])
        place = np.stack([flight.x, flight.y, flight.z], axis=-1)
        velocity = (place[row + 1] - place[row - 1]) / (flight.t[row + 1] - flight.t[row - 1])
        local = (points - place[row]) @ flight.R_IB[row] - centre
        air = spheroid.stream(local, velocity @ flight.R_IB[row], length, insect["body"]["width"])
        return air @ flight.R_IB[row].T

    def fly(self, mirrored=False, body=False, kutta=True, sealed=False):
        """Of the last flap, a row a step: force of the right wing, NED [N], and moment about its hinge line [N m]."""
        nodes, points = self.lattices[kutta]
        wing = wake.Wing(self.flight.density, self.core, mirrored, kutta, rows=int(1.5 * self.flap))
        loads = []
        for row in self.rows:
            here, velocity = self.moving(points, row, sealed)
            rings, _ = self.moving(nodes, row, sealed)
            stream = self.drives(here, row) if body else None
            force, normal = wing.step(rings, here, velocity, self.dt, stream)
            vector = force[..., None] * normal
            arm = here - self.flight.in_air(self.place(np.zeros(3), row, sealed), row)
            axis = self.flight.R_IB[row] @ self.flight.R_BW[row][:, 1]
            hinge = np.cross(arm, vector).sum(axis=(0, 1)) @ axis
            loads.append([*vector.sum(axis=(0, 1)), hinge])
        return np.array(loads)[-self.flap:]

    def all(self, variants):
        return {name: self.fly(**VARIANTS[name]) for name in variants}
