"""Vortex rings on a plate without thickness.

Nodes are an array (chordwise, spanwise, 3), from the leading edge back and from the root to the tip; ring i, j lies
between nodes i, i + 1 and j, j + 1. The plate's normal is +z of the wing axes (x to the leading edge, y to the tip), and
circulation is positive where it drives air along the normal. The jump of the potential across the plate (side of the
normal less the other side) is minus the circulation. SI units."""
import numpy as np

MIRROR = np.array([1.0, -1.0, 1.0])  # the plane y = 0


def grid(leading, trailing, y_root, y_tip, chordwise, spanwise, kutta=False):
    """Nodes and collocation points, wing axes, of the outline whose edges are the functions leading(y), trailing(y).
    Nodes lie at the cosines of evenly spaced angles, points at those of the angles between: a sum over them
    is Gauss's and Chebyshev's for a flow that is singular at the rim. With `kutta` it is Lan's along the chord: the last
    point on the trailing edge, the last row as far behind it as the one before is ahead: there the wake begins."""
    if kutta:
        rows, between = cosines(chordwise)[1], cosines(chordwise)[0][1:]
        rows = np.append(rows, 2.0 - rows[-1])
    else:
        rows, between = cosines(chordwise)
    columns, middles = (y_root + part * (y_tip - y_root) for part in cosines(spanwise))
    points = surface(leading, trailing, between, columns)  # on the straight sides of the rings, not on the outline
    part = ((middles - columns[:-1]) / np.diff(columns))[None, :, None]
    return surface(leading, trailing, rows, columns), (1.0 - part) * points[:, :-1] + part * points[:, 1:]


def cosines(cells):
    """Ends and middles of so many cells of [0, 1], in angle."""
    at = np.arange(2 * cells + 1) * np.pi / (2 * cells)
    part = 0.5 * (1.0 - np.cos(at))
    return part[::2], part[1::2]


def surface(leading, trailing, part, y):
    """Points at these parts of the chord behind the leading edge, at these y."""
    front, back = leading(y), trailing(y)
    x = front[None, :] + part[:, None] * (back - front)[None, :]
    return np.stack([x, np.broadcast_to(y, x.shape), np.zeros_like(x)], axis=-1)


def normals_and_areas(nodes):
    """Of each ring: unit normal (+z for a plate in wing axes) and area [m2]."""
    a = nodes[1:, 1:] - nodes[:-1, :-1]
    b = nodes[:-1, 1:] - nodes[1:, :-1]
    cross = 0.5 * np.cross(b, a)
    area = np.linalg.norm(cross, axis=-1)
    return cross / area[..., None], area


def segments(start, end, points, core=0.0):
    """Velocity at the points (first axis) by straight vortices of unit circulation (second axis), law of Biot and
    Savart. `core` [m], one or one a vortex: within about this distance of the line the velocity falls to zero."""
    shape = (len(points), len(start))
    near = np.empty((3, *shape))
    far = np.empty((3, *shape))
    for k in range(3):
        near[k] = points[:, None, k] - start[None, :, k]
        far[k] = points[:, None, k] - end[None, :, k]
    cross = np.stack([near[1] * far[2] - near[2] * far[1], near[2] * far[0] - near[0] * far[2],
                      near[0] * far[1] - near[1] * far[0]])
    r1 = np.sqrt((near * near).sum(axis=0))
    r2 = np.sqrt((far * far).sum(axis=0))
    dot = (near * far).sum(axis=0)
    if np.any(core):
        soft = core ** 2 * ((end - start) ** 2).sum(axis=-1)[None, :]
        strength = (r1 + r2) * (r1 * r2 - dot) / (r1 * r2 * ((cross * cross).sum(axis=0) + soft) + 1e-300)
    else:
        strength = (r1 + r2) / (r1 * r2 * (r1 * r2 + dot))
    return np.moveaxis(cross * (strength / (4.0 * np.pi)), 0, -1)


def rings(nodes, points):
    """Velocity at the points by each ring of unit circulation: (points, rings, 3)."""
    m, n = nodes.shape[0] - 1, nodes.shape[1] - 1
    points = points.reshape(-1, 3)
    along_y = segments(nodes[:, :-1].reshape(-1, 3), nodes[:, 1:].reshape(-1, 3), points)
    along_x = segments(nodes[:-1].reshape(-1, 3), nodes[1:].reshape(-1, 3), points)
    along_y = along_y.reshape(len(points), m + 1, n, 3)
    along_x = along_x.reshape(len(points), m, n + 1, 3)
    return (along_y[:, :-1] - along_y[:, 1:] + along_x[:, :, 1:] - along_x[:, :, :-1]).reshape(len(points), m * n, 3)


def sheet(nodes, circulation, points, core):
    """Velocity at the points by rings of these circulations (chordwise, spanwise): (points, 3). `core` of each row of
    nodes."""
    m, n = circulation.shape
    gap = np.zeros((1, n))
    along_y = np.concatenate([circulation, gap]) - np.concatenate([gap, circulation])
    gap = np.zeros((m, 1))
    along_x = np.concatenate([gap, circulation], axis=1) - np.concatenate([circulation, gap], axis=1)
    start = np.concatenate([nodes[:, :-1].reshape(-1, 3), nodes[:-1].reshape(-1, 3)])
    end = np.concatenate([nodes[:, 1:].reshape(-1, 3), nodes[1:].reshape(-1, 3)])
    strength = np.concatenate([along_y.ravel(), along_x.ravel()])
    cores = np.concatenate([np.repeat(core, n), np.repeat(core[:-1], n + 1)])
    return np.einsum("psk,s->pk", segments(start, end, points.reshape(-1, 3), cores), strength)


def with_mirror(velocity, points, mirrored):
    """velocity(points), with that of the image behind the plane y = 0 where `mirrored`: a mirror image moves the
    air at a point as the wing moves it at the mirrored point, mirrored."""
    points = points.reshape(-1, 3)
    here = velocity(points)
    return here + MIRROR * velocity(points * MIRROR) if mirrored else here


def influence(nodes, points, mirrored):
    return with_mirror(lambda at: rings(nodes, at), points, mirrored)


def unit_solutions(nodes, points, columns, mirrored=False):
    """Circulations (rings, columns) for normal velocities (rings, columns) of the plate, without a wake."""
    normal, _ = normals_and_areas(nodes)
    matrix = np.einsum("prk,pk->pr", influence(nodes, points, mirrored), normal.reshape(-1, 3))
    return np.linalg.solve(matrix, columns)


def added_mass(nodes, points, density):
    """3x3, of a flat plate alone, wing axes, for its velocity along z and its rates about x and y."""
    flat = points.reshape(-1, 3)
    modes = np.stack([np.ones(len(flat)), flat[:, 1], -flat[:, 0]], axis=1)
    _, area = normals_and_areas(nodes)
    return density * (modes * area.reshape(-1, 1)).T @ unit_solutions(nodes, points, modes)
