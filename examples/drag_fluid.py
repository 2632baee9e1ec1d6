#!/usr/bin/python3
"""A fluid node of one's own: each wing a rectangle with nothing but drag normal to its plane.

  roslaunch monarch_flight flight.launch case:=climb_printed fluid_node:=drag_fluid.py flaps:=0.1

Force on a strip of the wing: -1/2 rho C_n c dy |u| u along the wing's normal, u being its speed
normal to the wing at half chord; C_n = 1.98 is the measured normal-force coefficient of a plate
square to the stream. No lift, no added mass, no wake: an example of the protocol, not of a wing.
"""
import sys

import numpy as np
from geometry_msgs.msg import Vector3, Wrench
from monarch_flight.msg import LoadDerivatives, ParticipantReply
from monarch_flight.solver_node import SolverNode

NORMAL_FORCE = 1.98
STRIPS = 20
SMALL = 1e-6  # step of difference quotients [m/s, rad/s]


def rotation(axis, angle):
    """Takes components in the turned axes to those in the old ones."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = np.eye(3)
    R[i, i] = R[j, j] = c
    R[i, j], R[j, i] = -s, s
    return R


def rotation_of(q):
    """The matrix of a unit quaternion."""
    v = np.array([q.x, q.y, q.z])
    cross = np.cross(np.eye(3), v)  # cross @ a is v x a
    return np.eye(3) + 2 * q.w * cross + 2 * cross @ cross


def numbers(vector):
    return np.array([vector.x, vector.y, vector.z])


def wrench(six):
    return Wrench(Vector3(*six[:3]), Vector3(*six[3:]))


class DragFluid:
    """The state of this fluid is nothing: the loads follow from the wing's motion of the moment."""

    def start(self, case, request):
        wing = case["insect"]["wing"]
        if not isinstance(wing["planform"].get("scale_span"), float):
            raise ValueError("this fluid needs a planform with scale_span, as the case climb has it")
        span, area = wing["planform"]["scale_span"], wing["planform"]["scale_area"]
        self.y = (np.arange(STRIPS) + 0.5) * span / STRIPS
        self.factor = 0.5 * case["fluid"]["density"] * NORMAL_FORCE * area / STRIPS
        self.x = -0.5 * area / span  # half chord; the hinge is at the leading edge
        self.beta, self.root = case["insect"]["beta"], np.array(wing["root"])
        return ParticipantReply(interface=request.interface)

    def iterate(self, request):
        u = self.wing_velocity(request)
        reply = ParticipantReply(interface=request.interface)
        reply.loads.pressure = wrench(self.loads(u))
        if request.want_operator:
            columns = [wrench(column) for column in self.jacobian(u).T]
            reply.load_operator = [LoadDerivatives(columns, 6 * [Wrench()])]
        return reply

    def commit(self, request):
        return ParticipantReply(interface=request.interface)

    def wing_velocity(self, request):
        """(velocity of the root against the air, angular velocity), wing axes [m/s, rad/s]."""
        body, joints = request.interface.body, request.prescribed.right_wing
        phi, phi_dot = joints.phi.position, joints.phi.velocity
        psi, psi_dot = joints.psi.position, joints.psi.velocity
        hinge = request.interface.theta_right  # that of `joints` is only prescribed
        theta, theta_dot = hinge.position, hinge.velocity
        air = numbers(body.velocity) - numbers(request.prescribed.wind)
        Q_BW = rotation(1, self.beta) @ rotation(0, phi) @ rotation(2, -psi) @ rotation(1, theta)
        Omega_B = numbers(body.angular_velocity)
        rate = np.array([phi_dot * np.cos(psi) * np.cos(theta) + psi_dot * np.sin(theta),
                         phi_dot * np.sin(psi) + theta_dot,
                         phi_dot * np.cos(psi) * np.sin(theta) - psi_dot * np.cos(theta)])
        v_B = rotation_of(body.orientation).T @ air + np.cross(Omega_B, self.root)
        return np.concatenate([Q_BW.T @ v_B, rate + Q_BW.T @ Omega_B])

    def loads(self, u):
        """(force; moment about the root), wing axes [N, N m]."""
        v, omega = u[:3], u[3:]
        normal = v[2] + omega[0] * self.y - omega[1] * self.x
        f = -self.factor * np.abs(normal) * normal
        return np.array([0, 0, f.sum(), (self.y * f).sum(), -self.x * f.sum(), 0])

    def jacobian(self, u):
        """d(loads)/d(velocities), by central differences."""
        steps = SMALL * np.eye(6)
        return np.transpose([(self.loads(u + d) - self.loads(u - d)) / (2 * SMALL) for d in steps])


if __name__ == "__main__":
    sys.exit(SolverNode("fluid", DragFluid()).serve())
