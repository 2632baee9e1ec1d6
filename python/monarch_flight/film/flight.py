"""What a film shows, out of the bag of a run: poses, the insect's shape, pressure and flow of the wings."""
import bisect
import sys

import numpy as np
import yaml

START = 1.0  # s, the stamp of step 0
KINDS = ("tf2_msgs/TFMessage", "visualization_msgs/MarkerArray", "std_msgs/String", "sensor_msgs/PointCloud2",
         "monarch_flight/FlowBlock")


def rotation(q):
    """Matrix of a quaternion message."""
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def matrix(transform):
    """4 x 4, takes places in the child's axes to those in the parent's."""
    out = np.eye(4)
    out[:3, :3] = rotation(transform.rotation)
    out[:3, 3] = transform.translation.x, transform.translation.y, transform.translation.z
    return out


class Series:
    """Messages by time [s]."""

    def __init__(self):
        self.times, self.messages = [], []

    def add(self, t, message):
        self.times.append(t)
        self.messages.append(message)

    def __len__(self):
        return len(self.times)

    def around(self, t):
        """The messages before and after t, and the share of the way to the second one."""
        i = bisect.bisect_right(self.times, t)
        low, high = max(0, i - 1), min(i, len(self.times) - 1)
        length = self.times[high] - self.times[low]
        return self.messages[low], self.messages[high], (t - self.times[low]) / length if length > 0 else 0.0

    def nearest(self, t):
        low, high, share = self.around(t)
        return low if share < 0.5 else high


def pressure(cloud):
    """A row a facet: x, y, dx, dy, p_upper, p_lower."""
    rows = np.frombuffer(cloud.data, dtype=np.float32).reshape(-1, 8)
    return rows[:, [0, 1, 3, 4, 5, 6]].astype(float)


def softened(values, size):
    out = values.reshape(size[::-1])
    for axis in range(3):
        padded = np.pad(out, [(1, 1) if a == axis else (0, 0) for a in range(3)], mode="edge")
        low, high = (np.take(padded, range(i, i + out.shape[axis]), axis=axis) for i in (0, 2))
        out = 0.5 * out + 0.25 * (low + high)
    return out.ravel()


def faded(values, size, points=2):
    """To 0 at the block's rim, so that a vortex that leaves the block has a closed end."""
    share = np.ones(size[::-1])
    for axis, n in enumerate(share.shape):
        if n > 4 * points:
            inside = np.minimum(np.arange(n), np.arange(n)[::-1]) / points
            share = np.minimum(share, inside.reshape([n if a == axis else 1 for a in range(3)]))
    return values * share.ravel()


class Block:
    """Vortices around a wing (FlowBlock.msg), in its axes."""

    def __init__(self, message):
        self.size = tuple(message.size)
        self.origin = np.array([message.origin.x, message.origin.y, message.origin.z])
        self.spacing = message.spacing
        self.q_root = message.step * np.asarray(message.q_root, dtype=np.float32)  # sign(Q) sqrt(|Q|) [1/s]
        self.omega = message.step * np.asarray(message.vorticity, dtype=np.float32)  # along the span [1/s]

    def softened(self):
        """Each number with half of it from its neighbours along each axis: the numbers of a grid make lumps."""
        out = object.__new__(Block)
        out.__dict__.update(self.__dict__)
        out.q_root, out.omega = faded(softened(self.q_root, self.size), self.size), softened(self.omega, self.size)
        return out

    def mirrored(self):
        """Seen in the mirror y = 0; the vorticity along y stays."""
        out = object.__new__(Block)
        nx, ny, nz = out.size = self.size
        out.spacing = self.spacing
        out.origin = self.origin * (1, -1, 1) - (0, (ny - 1) * self.spacing, 0)
        out.q_root, out.omega = (values.reshape(nz, ny, nx)[:, ::-1].ravel() for values in (self.q_root, self.omega))
        return out

    def towards(self, other, share):
        """The mean of two blocks at the same places."""
        if self.size != other.size or not np.allclose(self.origin, other.origin):
            return self if share < 0.5 else other
        out = object.__new__(Block)
        out.size, out.origin, out.spacing = self.size, self.origin, self.spacing
        out.q_root = (1 - share) * self.q_root + share * other.q_root
        out.omega = (1 - share) * self.omega + share * other.omega
        return out


class Flight:
    """A recorded flight. Times are those of the flight [s], from its step 0."""

    def __init__(self, path):
        import rosbag
        self.parents, self.fixed = {}, {}  # of every frame; poses that never change
        self.poses, self.pressure, self.flow = Series(), {}, {}
        self.model, self.case, self.prefix = [], {}, ""
        with rosbag.Bag(str(path)) as bag:
            for topic, message, stamp in bag.read_messages(connection_filter=lambda _, kind, *__: kind in KINDS):
                self.take(topic, message, stamp.to_sec() - START)
        if not self.model or len(self.poses) < 2:
            sys.exit(f"film: {path}: holds no flight with the insect's shape; fly it again with this version")

    def take(self, topic, message, t):
        kind, name = message._type, topic.rpartition("/")[2]
        if kind == "tf2_msgs/TFMessage":
            moving = {one.child_frame_id: matrix(one.transform) for one in message.transforms}
            self.parents.update((one.child_frame_id, one.header.frame_id) for one in message.transforms)
            self.fixed.update(moving) if topic == "/tf_static" else self.poses.add(t, moving)
        elif kind == "visualization_msgs/MarkerArray" and name == "model":
            self.model = message.markers
            self.prefix = message.markers[0].header.frame_id[:-len("right_wing")]
        elif kind == "std_msgs/String" and name == "case":
            self.case = yaml.safe_load(message.data)
        elif name in ("pressure", "flow"):
            if name == "flow":  # as arrays: lists of numbers take ten times the memory
                message.q_root, message.vorticity = np.int16(message.q_root), np.int16(message.vorticity)
            wing = topic.split("/")[-2]
            getattr(self, name).setdefault(wing, Series()).add(t, message)

    @property
    def duration(self):
        return self.poses.times[-1]

    @property
    def period(self):
        """Of the flapping [s]; None where nothing is periodic."""
        frequency = self.case.get("motion", {}).get("frequency")
        return 1.0 / frequency if frequency else None

    @property
    def mirrored(self):
        return "left_wing" not in self.pressure and "left_wing" not in self.flow

    def pose(self, frame, t):
        """4 x 4, takes places in the frame (named without prefix) to those in world, at the step nearest to t."""
        moving, out, name = self.poses.nearest(t), np.eye(4), self.prefix + frame
        while name in self.parents:
            out = moving.get(name, self.fixed.get(name)) @ out
            name = self.parents[name]
        return out

    def facets(self, wing, t):
        """Pressure on a wing in its true axes, as `pressure` has it; None where there is none."""
        series, image = self.source(self.pressure, wing)
        if not series:
            return None
        low, high, share = series.around(t)
        rows = (1 - share) * pressure(low) + share * pressure(high)
        rows[:, 1] *= image
        return rows

    def block(self, wing, t):
        """The flow around a wing, in its true axes; None where there is none."""
        series, image = self.source(self.flow, wing)
        if not series or not series.times[0] <= t + 1e-9:
            return None
        low, high, share = series.around(t)
        found = Block(low).towards(Block(high), share)
        return (found if image > 0 else found.mirrored()).softened()

    def source(self, kind, wing):
        if self.mirrored:
            return kind.get("right_wing"), -1.0 if wing == "left_wing" else 1.0
        return kind.get(wing), 1.0
