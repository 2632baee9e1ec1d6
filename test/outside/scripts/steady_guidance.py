#!/usr/bin/python3
"""Guidance of another package, in Python: the deviation of the wings follows the body's forward speed."""
import struct
import sys

from monarch_flight.solver_node import SolverNode

GAIN = 0.2  # [rad/(m/s)]


class SteadyGuidance:
    def start(self, case, request):
        self.deviation = 0.0

    def command(self, request):
        off = request.interface.body.velocity.x - request.prescribed.body.velocity.x
        self.deviation = 0.9 * self.deviation - 0.1 * GAIN * off
        return {"deviation_mean": self.deviation}

    def save(self):
        return struct.pack("<d", self.deviation)

    def restore(self, memory):
        self.deviation, = struct.unpack("<d", memory)


if __name__ == "__main__":
    sys.exit(SolverNode("guidance", SteadyGuidance()).serve())
