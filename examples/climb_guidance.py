#!/usr/bin/python3
"""Guidance of one's own: holds a climb by the amplitude of flapping and the mean deviation.

  scripts/fly case:=climb_trimmed fluid:=quasi_steady flaps:=20 guidance_node:=climb_guidance.py

What it holds is the body's motion in the case, which a free body leaves. Fixed gains answer what
speed and pitch are off, and the integral of the speed's part: those of least cost on a linear model
of climb_trimmed, identified from flights. With an abdomen 9 % lighter or heavier they still hold.
"""
import struct
import sys

from monarch_flight.solver_node import SolverNode

# Of vx and vz (NED) [1/(m/s)], pitch [1/rad], integrals of vx and vz over flaps [1/(m/s)].
GAINS = {"amplitude": (0.40, 0.13, 0.42, 0.030, -0.032),
         "deviation_mean": (0.26, 0.067, 0.19, 0.008, -0.015)}


class ClimbGuidance:
    def start(self, case, request):
        self.frequency = case["motion"]["frequency"]
        self.t, self.vx_sum, self.vz_sum = request.t, 0.0, 0.0

    def command(self, request):
        flown, wanted = request.interface.body, request.prescribed.body
        vx = flown.velocity.x - wanted.velocity.x
        vz = flown.velocity.z - wanted.velocity.z
        pitch = flown.pitch.position - wanted.pitch.position
        flaps = self.frequency * (request.t - self.t)
        self.t, self.vx_sum, self.vz_sum = (
            request.t, self.vx_sum + vx * flaps, self.vz_sum + vz * flaps)
        off = (vx, vz, pitch, self.vx_sum, self.vz_sum)
        return {name: -sum(k * x for k, x in zip(gains, off)) for name, gains in GAINS.items()}

    def save(self):
        return struct.pack("<3d", self.t, self.vx_sum, self.vz_sum)

    def restore(self, memory):
        self.t, self.vx_sum, self.vz_sum = struct.unpack("<3d", memory)


if __name__ == "__main__":
    sys.exit(SolverNode("guidance", ClimbGuidance()).serve())
