"""Loads of a moving wing beside its mirror image: vortex rings with Kutta's condition and the wake that they leave.

Attached potential flow of a plate without edge suction: the circulation follows from the motion alone. The wake stays in
the air where it was left. The plane of the image is y = 0."""
import numpy as np

from monarch_flight.neighbours import lattice

BEHIND = 0.25  # where the vortex of a step stands, between the trailing edge's places now and a step ago
OLD = 20  # steps until a vortex of the wake has its whole core: at the trailing edge none, or Kutta's condition fails


class Wing:
    """A wing that is led step by step: nodes and points in the air (y = 0: the plane of the mirror)."""

    def __init__(self, density, core, mirrored, kutta=True, rows=120):
        self.density, self.core, self.mirrored, self.kutta, self.rows = density, core, mirrored, kutta, rows
        self.rear = None  # the last row of nodes at the step before
        self.shed = None  # nodes of the wake, newest first
        self.strength = None  # circulation of its rings
        self.before = None  # circulation of the wing at the step before

    def step(self, nodes, points, velocity, dt, stream=None):
        """Loads after dt at this place: force [N] on each ring along its normal, and the normals.
        velocity: of the points; stream: velocity of the air at the points that others cause."""
        normal, area = lattice.normals_and_areas(nodes)
        m, n = area.shape
        flat = points.reshape(-1, 3)
        matrix = lattice.influence(nodes, flat, self.mirrored)
        air = np.zeros_like(flat) if stream is None else stream.reshape(-1, 3).copy()
        trails = self.kutta and self.rear is not None
        if trails:
            self.lead(nodes[-1])
            newest = np.stack([nodes[-1], self.shed[0]])
            matrix[:, -n:] += lattice.influence(newest, flat, self.mirrored)
            core = self.core * np.minimum(1.0, np.arange(len(self.shed)) / OLD)
            air += lattice.with_mirror(lambda at: lattice.sheet(self.shed, self.strength, at, core), flat,
                                       self.mirrored)
        across = np.einsum("prk,pk->pr", matrix, normal.reshape(-1, 3))
        wanted = ((velocity.reshape(-1, 3) - air) * normal.reshape(-1, 3)).sum(axis=-1)
        circulation = np.linalg.solve(across, wanted).reshape(m, n)
        air += np.einsum("prk,r->pk", matrix, circulation.ravel())
        relative = (air - velocity.reshape(-1, 3)).reshape(m, n, 3)
        force = self.pressure(nodes, circulation, relative, normal, area, dt, trails)
        last = circulation[-1:]
        self.strength = last if self.strength is None else np.concatenate([last, self.strength])[:self.rows]
        self.rear, self.before = nodes[-1], circulation
        return force, normal

    def lead(self, rear):
        """A new row of nodes of the wake."""
        born = rear + BEHIND * (self.rear - rear)
        self.shed = (self.rear[None] if self.shed is None else self.shed)[:self.rows]
        self.shed = np.concatenate([born[None], self.shed])

    def pressure(self, nodes, circulation, relative, normal, area, dt, trails):
        """Bernoulli's equation: minus density times D(circulation)/Dt, on each ring."""
        before = circulation if self.before is None else self.before
        force = -self.density * (circulation - before) / dt * area
        last = circulation[-1:] if trails else np.zeros_like(circulation[:1])  # of what lies behind the last ring
        rows = np.diff(np.concatenate([np.zeros_like(circulation[:1]), circulation, last]), axis=0)
        edge = np.zeros_like(circulation[:, :1])
        columns = np.diff(np.concatenate([edge, circulation, edge], axis=1), axis=1)
        along_y = nodes[:, 1:] - nodes[:, :-1]
        along_x = nodes[1:] - nodes[:-1]
        for front, part in shares(len(rows)):
            vortex = part[:, None, None] * (rows[front][..., None] * along_y[front])
            force += self.density * (np.cross(relative, vortex) * normal).sum(axis=-1)
        for side, part in shares(columns.shape[1]):
            vortex = part[None, :, None] * (columns[:, side][..., None] * along_x[:, side])
            force -= self.density * (np.cross(relative, vortex) * normal).sum(axis=-1)
        return force


def shares(count):
    """How the vortices between rings bear on the rings of either side: half and half, at a rim all on one."""
    first, second = np.full(count - 1, 0.5), np.full(count - 1, 0.5)
    first[0], second[-1] = 1.0, 1.0
    return (slice(0, -1), first), (slice(1, None), second)
