#!/usr/bin/python3
"""The least fluid there is, a vacuum: the frame for your own (docs/tutorials/7_own_fluid.md)."""
import sys

from geometry_msgs.msg import Wrench
from monarch_flight.msg import LoadDerivatives, ParticipantReply
from monarch_flight.solver_node import SolverNode


class FirstFluid:
    def start(self, case, request):  # `case` is the resolved case, a dict
        return ParticipantReply(interface=request.interface)

    def iterate(self, request):
        reply = ParticipantReply(interface=request.interface)
        reply.loads.pressure.force.z = 0.0  # your loads: about the wing root, wing axes [N, N m]
        if request.want_operator:  # their derivatives with respect to velocities, accelerations
            reply.load_operator = [LoadDerivatives(6 * [Wrench()], 6 * [Wrench()])]
        return reply

    def commit(self, request):  # keep what the last iterate has answered
        return ParticipantReply(interface=request.interface)


if __name__ == "__main__":
    sys.exit(SolverNode("fluid", FirstFluid()).serve())
