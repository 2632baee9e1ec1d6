#!/usr/bin/python3
"""Guidance with joint angles of its own: those of the flight.csv that MONARCH_TEST_FLIGHT names. A
level that is called by MONARCH_TEST_FAULT, as nan:20 or error:20, goes wrong."""
import csv
import os
import sys

from monarch_flight.msg import JointMotion, PrescribedLevel, WingJoints
from monarch_flight.solver_node import SolverNode


class Recorded:
    def start(self, case, request):
        with open(os.environ["MONARCH_TEST_FLIGHT"], newline="") as f:
            self.rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)]
        self.fault, _, step = os.environ.get("MONARCH_TEST_FAULT", "none:-1").partition(":")
        self.step = int(step)
        return self.level(0)

    def prescribe(self, request):
        level = self.level(request.key.step)
        if request.key.step == self.step:
            if self.fault == "error":
                raise RuntimeError("this level is meant to go wrong")
            level.right_wing.phi.velocity = float("nan")
        return level

    def level(self, step):
        row = self.rows[step]

        def joint(name):
            return JointMotion(row[name], row[name + "_dot"], row[name + "_ddot"])

        return PrescribedLevel(
            right_wing=WingJoints(joint("phi"), joint("psi"), joint("theta_R"), row["rest_angle"]),
            left_wing=WingJoints(joint("phi_L"), joint("psi_L"), joint("theta_L"), row["rest_angle_L"]),
            theta_a=joint("theta_A"))


if __name__ == "__main__":
    sys.exit(SolverNode("guidance", Recorded()).serve())
