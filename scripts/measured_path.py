#!/usr/bin/python3
"""Publishes the measured path (docs/measured.md) beside a flight, on the topic measured_path: from the place where the
flight begins, in the direction in which it begins. For rviz."""
import math

import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped
from monarch_flight.msg import FlightState
from nav_msgs.msg import Path

from monarch_flight import places
from monarch_flight.measured import marker_reduction


def measured():
    """Thorax of the measured flight: x forward, y to the right, z down, from its first place [m]; rows."""
    t, markers = marker_reduction.read_markers(places.config() / "measured/monarch_markers.csv")
    markers, _ = marker_reduction.along_flight(t, markers)
    thorax = 0.5 * (markers["T1"] + markers["T2"])
    return thorax - thorax[0]


def laid(points, state):
    """The same in the frame world, beginning with this state (NED)."""
    position, velocity = state.body.position, state.body.velocity
    heading = math.atan2(velocity.y, velocity.x)
    north = points[:, 0] * math.cos(heading) - points[:, 1] * math.sin(heading)
    east = points[:, 0] * math.sin(heading) + points[:, 1] * math.cos(heading)
    return np.stack([position.y + east, position.x + north, -position.z - points[:, 2]], axis=1)


def path(points, stamp):
    out = Path()
    out.header.frame_id, out.header.stamp = "world", stamp
    for x, y, z in points:
        pose = PoseStamped()
        pose.header = out.header
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
        pose.pose.orientation.w = 1.0
        out.poses.append(pose)
    return out


class Beside:
    """The flight: its first state lays the path down, and again when it is set back."""

    def __init__(self):
        self.points, self.step = measured(), None
        self.publisher = rospy.Publisher("monarch_flight/measured_path", Path, queue_size=1, latch=True)
        self.subscriber = rospy.Subscriber("monarch_flight/state", FlightState, self.hear, queue_size=10)

    def hear(self, state):
        if self.step is None or state.step < self.step:
            self.publisher.publish(path(laid(self.points, state), state.header.stamp))
        self.step = state.step


if __name__ == "__main__":
    rospy.init_node("measured_path")
    beside = Beside()
    rospy.spin()
