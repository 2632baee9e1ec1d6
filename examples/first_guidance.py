#!/usr/bin/python3
"""A controller in ten lines (docs/tutorials/6_own_controller.md); climb_guidance.py has gains that hold."""
import sys

from monarch_flight.solver_node import SolverNode


class FirstGuidance:
    def start(self, case, request):  # the resolved case, a dict; nothing to prepare here
        pass

    def command(self, request):  # once a step, with the committed level
        flown, wanted = request.interface.body, request.prescribed.body
        return {"amplitude": 0.4 * (wanted.velocity.x - flown.velocity.x),
                "deviation_mean": 0.2 * (wanted.pitch.position - flown.pitch.position)}


if __name__ == "__main__":
    sys.exit(SolverNode("guidance", FirstGuidance()).serve())
