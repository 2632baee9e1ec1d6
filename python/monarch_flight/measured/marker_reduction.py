"""Body attitude, wing angles and flight path of a butterfly from motion-capture markers.

Frames and angles are those of the package (docs/architecture.md): NED with x along the mean horizontal
velocity; theta_B body pitch, phi flapping, psi deviation, theta_R wing pitch, theta_A abdomen to body;
Q_R = exp(beta e2) exp(phi e1) exp(-psi e3) exp(theta e2). SI units and radians.
"""
import csv

import numpy as np

RATE = 200.0  # frames a second
MARKERS = ["LW1", "LW2", "LW3", "RW1", "RW2", "RW3", "T1", "T2", "A1", "A2"]
ANGLES = ["theta_B", "phi", "psi", "theta_R", "theta_A"]


class InputError(Exception):
    """The marker file is wrong: file, place and remedy."""


def read_markers(path):
    """Time [s] from the first frame and {marker: positions [m], rows of (north, east, down)}, north being
    the laboratory's x."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if line.strip() and not line.startswith("#")))
    wanted = [f"{name}_{axis}_mm" for name in MARKERS for axis in "xyz"]
    missing = [column for column in ["frame"] + wanted if not rows or column not in rows[0]]
    if missing:
        raise InputError(f"{path}: no column {', '.join(missing)}; give a file like config/measured/monarch_markers.csv")
    try:
        numbers = np.array([[float(cell) for cell in row] for row in rows[1:]])
    except ValueError as error:
        raise InputError(f"{path}: {error}; every cell must be a number") from None
    if len(numbers) < 30 or not np.isfinite(numbers).all():
        raise InputError(f"{path}: {len(numbers)} frames; at least 30 frames of finite numbers are needed")
    column = {name: numbers[:, i] for i, name in enumerate(rows[0])}
    if not (np.diff(column["frame"]) == 1).all():
        raise InputError(f"{path}: frames are missing; the column frame must count up by one")
    t = (column["frame"] - column["frame"][0]) / RATE
    signs = dict(x=1e-3, y=-1e-3, z=-1e-3)  # z up to z down about x
    return t, {name: np.stack([signs[a] * column[f"{name}_{a}_mm"] for a in "xyz"], axis=1) for name in MARKERS}


def unit(a):
    return a / np.linalg.norm(a, axis=-1, keepdims=True)


def along_flight(t, markers):
    """The markers with x along the mean horizontal velocity of the thorax, and that velocity's (vx, 0, vz)."""
    thorax = 0.5 * (markers["T1"] + markers["T2"])
    v = np.polyfit(t, thorax, 1)[0]
    forward = np.hypot(v[0], v[1])
    c, s = v[0] / forward, v[1] / forward
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return {name: p @ turn.T for name, p in markers.items()}, np.array([forward, 0.0, v[2]])


def pitch_of(direction):
    """Angle of a direction above the horizontal [rad]."""
    return np.arcsin(-unit(direction)[:, 2])


def to_body(markers, origin, theta_B):
    """Markers from `origin` in body axes: pitch theta_B, heading square to the line between the wings."""
    across = sum(markers["R" + w] - markers["L" + w] for w in ("W1", "W2", "W3"))
    yaw = np.arctan2(-across[:, 0], across[:, 1])
    ct, st, cy, sy = np.cos(theta_B), np.sin(theta_B), np.cos(yaw), np.sin(yaw)
    x = np.stack([cy * ct, sy * ct, -st], axis=1)
    y = np.stack([-sy, cy, 0 * yaw], axis=1)
    axes = np.stack([x, y, np.cross(x, y)], axis=2)
    return {name: np.einsum("nij,ni->nj", axes, p - origin) for name, p in markers.items()}


def wing_axes(points):
    """Span direction and normal (e2 and e3 of the wing) of a right wing in body axes from its markers about
    the root: the span points to the markers' centroid, the plane is the best through root and markers."""
    root = np.zeros_like(points[0])
    cloud = np.stack([root, *points], axis=1)
    normal = np.linalg.svd(cloud - cloud.mean(axis=1, keepdims=True))[2][:, 2, :]
    span = unit(sum(points))
    normal -= (normal * span).sum(axis=1, keepdims=True) * span
    to_leading = points[0] - points[2]  # marker 1 lies ahead of marker 3
    side = np.sign((normal * np.cross(to_leading, span)).sum(axis=1, keepdims=True))
    return span, unit(normal) * side


def wing_angles(span, normal, beta):
    """phi, psi, theta of a right wing (rad) whose e2 and e3 have these body components."""
    c, s = np.cos(beta), np.sin(beta)
    stroke = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    e2, e3 = span @ stroke, normal @ stroke
    phi, psi = np.arctan2(e2[:, 2], e2[:, 1]), np.arcsin(e2[:, 0])
    # Columns 1 and 3 of exp(phi e1) exp(-psi e3).
    first = np.stack([np.cos(psi), -np.sin(psi) * np.cos(phi), -np.sin(psi) * np.sin(phi)], axis=1)
    third = np.stack([0 * phi, -np.sin(phi), np.cos(phi)], axis=1)
    theta = np.arctan2((e3 * first).sum(axis=1), (e3 * third).sum(axis=1))
    return phi, psi, theta


def stroke_plane(spans):
    """beta [rad]: tilt about b_y of the plane in which the span directions (body axes) move."""
    x, z = spans[:, 0] - spans[:, 0].mean(), spans[:, 2] - spans[:, 2].mean()
    values, vectors = np.linalg.eigh(np.cov(x, z))
    along = vectors[:, np.argmax(values)]
    return float(np.arctan(along[0] / along[1]))


def design(t, frequency, order):
    columns = [np.ones_like(t)]
    for n in range(1, order + 1):
        columns += [np.cos(2 * np.pi * n * frequency * t), np.sin(2 * np.pi * n * frequency * t)]
    return np.stack(columns, axis=1)


def fit(t, y, guess, order):
    """Fourier series of y by least squares, its frequency [Hz] included: {frequency, A0, AN, BN, rms}."""
    from scipy.optimize import least_squares  # which readers of the histories alone do without

    def residual(f):
        a = design(t, f[0], order)
        return a @ np.linalg.lstsq(a, y, rcond=None)[0] - y
    solution = least_squares(residual, [guess], x_scale=[0.01])
    frequency = float(solution.x[0])
    c = np.linalg.lstsq(design(t, frequency, order), y, rcond=None)[0]
    return dict(frequency=frequency, A0=float(c[0]), AN=c[1::2].tolist(), BN=c[2::2].tolist(),
                rms=float(np.sqrt(np.mean(solution.fun**2))))


def evaluate(series, t, frequency):
    """Value of a series {A0, AN, BN} at times t."""
    y = series["A0"] + 0 * t
    for n, (a, b) in enumerate(zip(series["AN"], series["BN"]), 1):
        y = y + a * np.cos(2 * np.pi * n * frequency * t) + b * np.sin(2 * np.pi * n * frequency * t)
    return y


def histories(t, markers, beta):
    """Time histories of angles, path and velocity of the thorax; its mean velocity; span directions of each side."""
    markers, velocity = along_flight(t, markers)
    theta_B = pitch_of(markers["T1"] - markers["T2"])
    theta_A = pitch_of(markers["T2"] - 0.5 * (markers["A1"] + markers["A2"])) - theta_B
    body = to_body(markers, markers["T2"], theta_B)
    sides = {}
    for side, mirror in (("L", [1, -1, 1]), ("R", [1, 1, 1])):
        sides[side] = wing_axes([body[side + w] * mirror for w in ("W1", "W2", "W3")])
    angles = {side: [np.unwrap(q) for q in wing_angles(*axes, beta)] for side, axes in sides.items()}
    phi, psi, theta_R = (0.5 * (left + right) for left, right in zip(angles["L"], angles["R"]))
    thorax = 0.5 * (markers["T1"] + markers["T2"])
    columns = dict(t=t, theta_B=theta_B, phi=phi, psi=psi, theta_R=theta_R, theta_A=theta_A)
    for side in "LR":
        for name, q in zip(("phi", "psi", "theta_R"), angles[side]):
            columns[f"{name}_{side}"] = q
    columns.update(zip(("x", "y", "z"), (thorax - thorax[0]).T))
    columns.update(zip(("vx", "vy", "vz"), np.gradient(thorax, t, axis=0).T))
    return columns, velocity, [axes[0] for axes in sides.values()]


def reduce(t, markers, beta):
    """Everything about the flight: time histories, series, velocity, climb angle, stroke plane."""
    columns, velocity, spans = histories(t, markers, beta)
    orders = dict(theta_B=(10.2, 1), phi=(10.2, 5), psi=(20.4, 1), theta_R=(10.2, 5), theta_A=(10.2, 1))
    return dict(columns=columns, series={k: fit(t, columns[k], *orders[k]) for k in ANGLES},
                velocity=velocity, climb=float(np.arctan2(-velocity[2], velocity[0])),
                speed=float(np.linalg.norm(velocity)), beta=stroke_plane(np.concatenate(spans)))
