"""Where the camera of a film stands: it follows the body, and does not turn with it but for `chase`."""
import numpy as np

# Towards the camera, seen from the body: to its right, forward, up. Views are told for a flight to the north.
BELOW = 0.04  # of the distance: the body stands above the middle of the picture, its wake below
VIEWS = {
    "oblique": (0.80, 0.62, 0.42),
    "side": (1.0, 0.0, 0.06),
    "front": (0.12, 1.0, 0.16),
    "top": (0.001, -0.02, 1.0),
    "chase": (0.18, -1.0, 0.34),
}


def smooth(values, width):
    """Mean over `width` samples around each; ends are continued straight on."""
    width = max(1, min(width | 1, len(values) if len(values) % 2 else len(values) - 1))
    half = width // 2
    before = 2 * values[0] - values[half:0:-1]
    after = 2 * values[-1] - values[-2:-half - 2:-1]
    padded = np.concatenate([before, values, after]) if half else values
    total = np.cumsum(np.vstack([np.zeros(values.shape[1]), padded]), axis=0)
    return (total[width:] - total[:-width]) / width


class Camera:
    """Its place and where it looks, at a time."""

    def __init__(self, flight, view, distance):
        self.times = np.array(flight.poses.times)
        places = np.array([flight.pose("base_link", t)[:3, 3] for t in self.times])
        steps = int(round((flight.period or flight.duration) / max(1e-9, self.times[1] - self.times[0])))
        self.path = smooth(places, steps)
        self.toward, self.distance, self.chases = np.array(VIEWS[view]), distance, view == "chase"
        self.path[:, 2] -= BELOW * distance * (view != "top")
        self.headings = self.unwound(flight, steps)

    def unwound(self, flight, steps):
        """Of the body, from the north to the west [rad], without the wingbeat."""
        forward = np.array([flight.pose("base_link", t)[:2, 0] for t in self.times])
        heading = np.unwrap(np.arctan2(-forward[:, 0], forward[:, 1]))
        return smooth(heading[:, None], steps)[:, 0]

    def at(self, t):
        """Focal point, position, up."""
        focus = np.array([np.interp(t, self.times, self.path[:, i]) for i in range(3)])
        right, ahead, up = self.toward / np.linalg.norm(self.toward)
        turn = np.interp(t, self.times, self.headings) if self.chases else self.headings[0]
        c, s = np.cos(turn), np.sin(turn)
        away = np.array([c * right - s * ahead, s * right + c * ahead, up])
        vertical = np.array([-s, c, 0.0]) if up > 0.95 else np.array([0.0, 0.0, 1.0])
        return focus, focus + self.distance * away, vertical
