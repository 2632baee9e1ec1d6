"""The estimate of what the neighbours change, against exact solutions; monarch verify neighbours."""
import numpy as np

from monarch_flight.neighbours import lattice, spheroid, wake

LIMITS = dict(chordwise=20, spanwise=20)


def row(quantity, resolution, computed, reference, bound):
    error = abs(computed / reference - 1.0) if reference else abs(computed)
    return dict(case="neighbours", quantity=quantity, resolution=resolution, computed=float(computed),
                reference=float(reference), error=float(error), bound=bound, **{"pass": bool(error <= bound)})


def ellipse(half_span, half_chord, chordwise, spanwise, kutta=False):
    def front(y):
        return half_chord * np.sqrt(np.maximum(0.0, 1.0 - (y / half_span) ** 2))

    return lattice.grid(front, lambda y: -front(y), -half_span, half_span, chordwise, spanwise, kutta)


def rectangle(chord, span, chordwise, spanwise, kutta=False):
    return lattice.grid(lambda y: 0.5 * chord + 0.0 * y, lambda y: -0.5 * chord + 0.0 * y, -0.5 * span, 0.5 * span,
                        chordwise, spanwise, kutta)


def facing(points, distance):
    """Points of a wing in its own axes, turned to face the plane y = 0 at this distance."""
    return np.stack([points[..., 0], points[..., 2] + distance, -points[..., 1]], axis=-1)


def broadside(nodes, points, distance=None):
    """Added mass over density against motion along the normal; with a distance: towards the mirror image."""
    if distance is not None:
        nodes, points = facing(nodes, distance), facing(points, distance)
    _, area = lattice.normals_and_areas(nodes)
    return float(area.ravel() @ lattice.unit_solutions(nodes, points, np.ones((area.size, 1)), distance is not None)[:, 0])


def elliptic_integral(square):
    """Complete, second kind, of this squared modulus."""
    angle = (np.arange(2000) + 0.5) * np.pi / 4000
    return 0.5 * np.pi * float(np.mean(np.sqrt(1.0 - square * np.sin(angle) ** 2)))


def plate_beside_wall(chord, distance, points=400):
    """Added mass over density and span of a plate in two dimensions, towards a wall: singular integral equation of
    its vortex sheet by Gauss's and Chebyshev's sum, which converges faster than any power."""
    ends = np.arange(points + 1) * np.pi / points
    sources, weights = 0.5 * chord * np.cos(ends), np.full(points + 1, np.pi / points)
    weights[[0, -1]] *= 0.5
    at = 0.5 * chord * np.cos((np.arange(points) + 0.5) * np.pi / points)
    gap = at[:, None] - sources[None, :]
    kernel = (1.0 / gap - gap / (gap ** 2 + 4.0 * distance ** 2)) / (2.0 * np.pi)
    sheet = np.linalg.solve(np.vstack([kernel * weights, weights]), np.append(np.ones(points), 0.0))
    return -float((sheet * weights) @ sources)


def alone():
    rows = []
    for ratio in (1.0, 2.0, 3.0):
        nodes, points = ellipse(ratio, 1.0, **LIMITS)
        exact = 4.0 * np.pi / 3.0 * ratio / elliptic_integral(1.0 - 1.0 / ratio ** 2)
        rows.append(row(f"ellipse {ratio:g}:1, heave", "20 x 20", broadside(nodes, points), exact, 0.01))
    matrix = lattice.added_mass(*ellipse(1.0, 1.0, **LIMITS), 1.0)
    rows.append(row("disc, roll", "20 x 20", matrix[1, 1], 16.0 / 45.0, 0.01))
    rows.append(row("disc, pitch", "20 x 20", matrix[2, 2], 16.0 / 45.0, 0.01))
    for ratio, table in ((1, 0.579), (2, 0.757), (4, 0.872)):
        mass = broadside(*rectangle(1.0, ratio, 12, 12)) / (0.25 * np.pi * ratio)
        rows.append(row(f"rectangle, aspect ratio {ratio}, heave", "12 x 12", mass, table, 0.005))
    return rows


def beside_the_mirror():
    rows = []
    for distance in (1.0, 0.5, 0.25, 0.1):
        nodes, points = rectangle(1.0, 200.0, 12, 8)
        mass = broadside(nodes, points, distance) / 200.0
        rows.append(row(f"two long plates, {2 * distance:g} chords apart", "12 x 8", mass,
                        plate_beside_wall(1.0, distance), 0.01))
    # squeezed air between two plates: rho c^3 / (12 h) and what flows round the rims beyond
    squeezed = plate_beside_wall(1.0, 0.002, 1600) * 12.0 * 0.002
    rows.append(row("the same, gap 0.004: over c^3/(12 h)", "exact", squeezed, 1.0, 0.05))
    nodes, points = ellipse(1.0, 1.0, **LIMITS)
    free = broadside(nodes, points)
    for distance in (4.0, 2.0):
        rows.append(row(f"two discs, {2 * distance:g} radii apart: gain", "20 x 20",
                        broadside(nodes, points, distance) / free - 1.0, 1.0 / (6.0 * np.pi * distance ** 3),
                        0.05 if distance > 3 else 0.15))
    image = broadside(*ellipse(1.0, 1.0, 8, 8), 0.5)
    rows.append(row("two discs, both solved, against the image", "8 x 8", two_wings(1.0), image, 1e-10))
    for distance in (1.0, 0.5, 0.25):
        rows.append(row(f"two discs, {2 * distance:g} radii apart, approaching: force", "14 x 14",
                        *force_and_energy(distance), 0.01))
    return rows


def two_wings(apart):
    """Added mass over density of one of two discs that approach each other, both solved."""
    nodes, points = (facing(part, 0.5 * apart) for part in ellipse(1.0, 1.0, 8, 8))
    other, others = nodes * lattice.MIRROR, points * lattice.MIRROR
    normal, area = lattice.normals_and_areas(nodes)
    count = area.size
    far = normal.reshape(-1, 3) * lattice.MIRROR
    matrix = np.empty((2 * count, 2 * count))
    for i, (at, n) in enumerate(((points, normal.reshape(-1, 3)), (others, far))):
        for j, of in enumerate((nodes, other)):
            matrix[i * count:(i + 1) * count, j * count:(j + 1) * count] = np.einsum(
                "prk,pk->pr", lattice.rings(of, at), n)
    return float(area.ravel() @ np.linalg.solve(matrix, np.ones(2 * count))[:count])


def force_and_energy(distance, dt=1e-3, change=1e-3):
    """Force that drives two discs apart which approach at a constant speed of 1: by the pressure, and by Lagrange's
    equations from the added mass's slope."""
    nodes, points = ellipse(1.0, 1.0, 14, 14)
    wing = wake.Wing(1.0, 0.0, True, kutta=False)
    velocity = np.zeros_like(points)
    velocity[..., 1] = -1.0
    for k in (0, 1):
        place = distance - dt * (k - 0.5)
        force, normal = wing.step(facing(nodes, place), facing(points, place), velocity, dt)
    slope = (broadside(nodes, points, distance + change) - broadside(nodes, points, distance - change)) / (2 * change)
    return (force * normal[..., 1]).sum(), -0.5 * slope


def towed(nodes, points, step, steps, incidence=0.01):
    """Normal force of each ring over dynamic pressure and incidence, at each step from rest."""
    wing = wake.Wing(1.0, 0.0, False, rows=steps)
    velocity = np.array([np.cos(incidence), 0.0, np.sin(incidence)])
    speeds = np.broadcast_to(velocity, points.shape)
    loads = [-wing.step(nodes + velocity * step * k, points + velocity * step * k, speeds, step)[0] for k in range(steps)]
    return np.array(loads) / (0.5 * np.sin(incidence))


def with_a_wake():
    rows = []
    nodes, points = ellipse(1.0, 1.0, 10, 14, kutta=True)
    lift = towed(nodes, points, 0.6, 40)[-1].sum() / np.pi
    rows.append(row("circular wing, lift slope", "10 x 14", lift, 1.7900, 0.01))
    nodes, points = rectangle(1.0, 400.0, 10, 3, kutta=True)
    loads = towed(nodes, points, 0.05, 81)[:, :, 1].sum(axis=1) / (nodes[0, 2, 1] - nodes[0, 1, 1]) / (2.0 * np.pi)
    for travelled in (1.0, 2.0, 8.0):
        s = travelled - 0.05  # a step's loads are of its middle
        wagner = 1.0 - 0.165 * np.exp(-0.0455 * s) - 0.335 * np.exp(-0.3 * s)
        rows.append(row(f"sudden start, {travelled:g} half chords", "10 x 3", loads[int(round(10 * travelled))], wagner,
                        0.06))
    return rows


def the_body():
    rows = []
    for length, width in ((2.0, 0.6), (32.0, 5.68)):
        at = np.random.default_rng(1).normal(size=(200, 3))
        at *= 0.5 * np.array([length, width, width]) / np.linalg.norm(at, axis=1)[:, None]
        normal = at / np.array([length, width, width]) ** 2
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        velocity = np.array([1.0, 0.7, -0.4])
        air = spheroid.stream(at * (1.0 + 1e-5), velocity, length, width)
        through = np.abs((air * normal).sum(axis=1) - normal @ velocity).max()
        rows.append(row(f"spheroid {length / width:.3g}:1, air through its surface", "exact", through, 0.0, 2e-3))
    place, velocity = np.array([3.0, 4.0, 1.0]), np.array([0.0, 1.0, 0.0])
    r = np.linalg.norm(place)
    dipole = -0.5 * (velocity / r ** 3 - 3.0 * place * (place @ velocity) / r ** 5)
    sphere = spheroid.stream(place[None], velocity, 2.0, 1.9998, step=1e-4)[0]
    off = np.linalg.norm(sphere - dipole) / np.linalg.norm(dipole)
    rows.append(row("sphere, against its dipole", "exact", off, 0.0, 2e-3))
    return rows


def rows():
    return alone() + beside_the_mirror() + with_a_wake() + the_body()
