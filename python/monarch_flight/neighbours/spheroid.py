"""Air that a slender body drives aside: exact potential of a prolate spheroid (Lamb, Hydrodynamics, articles 105, 106).
Body axes, the spheroid's centre at the origin, its long axis x. SI units."""
import numpy as np


def coordinates(points, focus):
    ahead = np.sqrt((points[..., 0] - focus) ** 2 + points[..., 1] ** 2 + points[..., 2] ** 2)
    behind = np.sqrt((points[..., 0] + focus) ** 2 + points[..., 1] ** 2 + points[..., 2] ** 2)
    return (behind - ahead) / (2.0 * focus), (behind + ahead) / (2.0 * focus)


def legendre(zeta):
    """Q1, its slope, and q with q sqrt(zeta^2 - 1) = -Q1^1."""
    log = 0.5 * np.log((zeta + 1.0) / (zeta - 1.0))
    pole = zeta / (zeta * zeta - 1.0)
    return zeta * log - 1.0, log - pole, log - pole


def potential(points, velocity, length, width):
    """Of the air at rest far away through which the spheroid moves with this velocity."""
    a, b = 0.5 * length, 0.5 * width
    focus = np.sqrt(a * a - b * b)
    rim = a / focus
    _, slope, q = legendre(rim)
    axial = velocity[0] * focus / slope
    # d/dzeta (sqrt(zeta^2 - 1) q) at the surface
    turn = rim / np.sqrt(rim * rim - 1.0) * q + np.sqrt(rim * rim - 1.0) * 2.0 / (rim * rim - 1.0) ** 2
    across = focus * rim / np.sqrt(rim * rim - 1.0) / turn
    mu, zeta = coordinates(points, focus)
    zeta = np.maximum(zeta, rim)  # inside: as on the surface
    q1, _, q = legendre(zeta)
    return axial * mu * q1 + across * q * (points[..., 1] * velocity[1] + points[..., 2] * velocity[2]) / focus


def stream(points, velocity, length, width, step=1e-7):
    """Velocity of the air there; `step` is the finite difference's, in lengths."""
    gradient = []
    for axis in np.eye(3) * step * length:
        gradient.append((potential(points + axis, velocity, length, width)
                         - potential(points - axis, velocity, length, width)) / (2.0 * step * length))
    return np.stack(gradient, axis=-1)
