#!/usr/bin/python3
"""A climb of one flap in quasi-steady air: in one process and over nodes, and what it writes."""
import math
import os
import unittest

import rosbag
import yaml

import flying

COLUMNS = (
    "t x y z vx vy vz ax ay az theta_B theta_B_dot theta_B_ddot qw qx qy qz phi psi theta_R "
    "theta_R_dot theta_R_ddot theta_A fx fy fz mx my mz fx_p fy_p fz_p mx_p my_p mz_p FX FY FZ "
    "sub_iterations courant phi_dot phi_ddot psi_dot psi_ddot theta_A_dot theta_A_ddot rest_angle "
    "wx wy wz wax way waz phase clipped refused lost").split()
COMMANDS = ("amplitude flapping_mean frequency deviation_mean rest_angle abdomen_mean "
            "abdomen_amplitude differential_amplitude differential_flapping differential_deviation "
            "differential_rest_angle").split()
COLUMNS += [kind + name for kind in ("command_", "applied_") for name in COMMANDS]
# Of the left wing, as its mirror image, and of a body that leaves its plane.
LEFT = ("phi_L phi_L_dot phi_L_ddot psi_L psi_L_dot psi_L_ddot theta_L theta_L_dot theta_L_ddot "
        "rest_angle_L fx_L fy_L fz_L mx_L my_L mz_L").split()
COLUMNS += LEFT + "roll yaw p q r p_dot q_dot r_dot".split()
TOPICS = {
    "/clock", "/tf", "/tf_static", "/joint_states", "/diagnostics", "/monarch_flight/case",
    "/monarch_flight/model",
    "/monarch_flight/state", "/monarch_flight/odom", "/monarch_flight/path",
    "/monarch_flight/wind", "/monarch_flight/right_wing/wrench", "/monarch_flight/left_wing/wrench",
    "/monarch_flight/right_wing/pressure", "/monarch_flight/iterations"}
FILES = ["case.yaml", "checkpoints", "flight.bag", "flight.csv", "iterations.csv", "summary.json"]
RESIDUALS = "x y z roll theta_B yaw theta_R theta_L".split()
STEPS, PRESCRIBED, TOLERANCE = 500, 10, 1e-8
TINY = {"level": "custom", "cells_per_chord": 6, "first_cell": 0.08, "growth_plane": 1.3, "growth_normal": 1.3,
        "far_field": 3, "margin": 0.25, "outer": "rest", "courant_limit": 3}


class SameState(flying.FlightTest):
    """One flight for all: the second is compared with the first."""

    def climb(self, name, *keys):
        code, output = self.fly("case:=climb_printed", "fluid:=quasi_steady", "flaps:=1",
                                "steps_per_flap:=%d" % STEPS, "out:=" + self.out(name), *keys)
        self.assertEqual(code, 0, output)
        return output

    def test_nodes_and_one_process_fly_the_same(self):
        output = self.climb("nodes")
        self.climb("process", "in_process:=true")
        nodes, process = flying.summary(self.out("nodes")), flying.summary(self.out("process"))
        self.assertEqual(nodes["state_sha256"], process["state_sha256"])
        self.assertIn(nodes["state_sha256"], output)
        for key in ("case_sha256", "steps", "sub_iterations", "climb_angle_deg", "theta_R_deg"):
            self.assertEqual(nodes[key], process[key], key)
        self.check_summary(nodes)
        for folder in (self.out("nodes"), self.out("process")):
            self.assertEqual(sorted(os.listdir(folder)), FILES)
            self.check_flight(folder)
            self.check_iterations(folder)
            self.check_bag(folder)
        self.check_case_flies_alone(nodes["state_sha256"])

    def test_navier_stokes_air_and_answers_at_random_times(self):
        """On a grid of some ten thousand cells: on one thread, on three, and with every answer up to 5 ms late."""
        with open(os.path.join(flying.ROOT, "config", "cases", "climb.yaml")) as f:
            case = yaml.safe_load(f)
        case["grid"] = TINY
        path = self.out("tiny.yaml")
        with open(path, "w") as f:
            yaml.safe_dump(case, f)
        flights = {"process": (("in_process:=true", "threads:=1"), {}), "nodes": (("threads:=3",), {}),
                   "late": ((), {"MONARCH_ANSWER_DELAY_MS": "5"})}
        for name, (keys, environment) in flights.items():
            code, output = self.fly("case:=" + path, "flaps:=0.16", "out:=" + self.out(name), *keys, **environment)
            self.assertEqual(code, 0, output)
        first = flying.summary(self.out("process"))
        self.assertEqual((first["steps"], first["retried_steps"]), (80, 0))
        for name in ("nodes", "late"):
            other = flying.summary(self.out(name))
            self.assertEqual(other["state_sha256"], first["state_sha256"], name)
            self.assertEqual(other["sub_iterations"], first["sub_iterations"], name)

    def check_summary(self, s):
        self.assertEqual((s["status"], s["failure"]), ("complete", ""))
        self.assertEqual((s["steps"], s["flaps"], s["retried_steps"]), (STEPS, 1.0, 0))
        self.assertGreater(s["sub_iterations"]["mean"], 1)
        self.assertLessEqual(s["sub_iterations"]["mean"], s["sub_iterations"]["max"])
        self.assertEqual(set(s["wall_s"]), {"total", "fluid", "flight", "wing", "guidance", "exchange", "coupling", "outputs"})
        self.assertEqual([len(row) for row in s["added_mass"]], [6] * 6)

    def check_flight(self, folder):
        columns, rows = flying.table(folder, "flight.csv")
        self.assertEqual(columns, COLUMNS)
        self.assertEqual(len(rows), STEPS + 1)
        self.assertTrue(all(math.isfinite(x) for row in rows for x in row))
        flight = {name: [row[i] for row in rows] for i, name in enumerate(columns)}
        dt = 1 / 10.2 / STEPS
        for n, t in enumerate(flight["t"]):
            self.assertAlmostEqual(t, n * dt, delta=1e-12)
        # Newmark's average acceleration holds between free levels, exactly but for rounding; in the
        # release the acceleration is constant.
        for n in range(PRESCRIBED, STEPS):
            for v, a in (("vx", "ax"), ("vz", "az"), ("theta_B_dot", "theta_B_ddot")):
                before = flight[a][n + (n == PRESCRIBED)]
                step = 0.5 * dt * (before + flight[a][n + 1])
                self.assertAlmostEqual(flight[v][n + 1], flight[v][n] + step, delta=1e-9)
            self.assertAlmostEqual(
                sum(flight[q][n] ** 2 for q in ("qw", "qx", "qy", "qz")), 1.0, delta=1e-12)
        self.check_guidance(flight, dt)

    def check_guidance(self, flight, dt):
        """Nobody leads: the motion itself, in still air."""
        for name in COLUMNS[COLUMNS.index("rest_angle"):COLUMNS.index(LEFT[0])]:
            if name != "phase":
                self.assertEqual(set(flight[name]), {0.0}, name)
        self.check_symmetry(flight)
        for n in range(STEPS):
            self.assertAlmostEqual(flight["phase"][n], n / STEPS, delta=1e-12)
            for angle in ("phi", "psi", "theta_A"):
                rate, change = angle + "_dot", angle + "_ddot"
                step = 0.5 * dt * (flight[rate][n] + flight[rate][n + 1])
                self.assertAlmostEqual(flight[angle][n + 1], flight[angle][n] + step, delta=1e-6)
                step = 0.5 * dt * (flight[change][n] + flight[change][n + 1])
                self.assertAlmostEqual(flight[rate][n + 1], flight[rate][n] + step, delta=2e-4)

    def check_symmetry(self, flight):
        """Mirrored wings: the left one has the numbers of the right one, the body stays in its plane."""
        for name in LEFT:
            if name.replace("_L", "") in flight:
                right = name.replace("_L", "")
            else:
                right = "theta_R" + name[len("theta_L"):]
            self.assertEqual(flight[name], flight[right], name)
        for name in ("y", "roll", "yaw", "p", "r"):
            self.assertEqual(set(flight[name]), {0.0}, name)
        self.assertEqual(flight["q"], flight["theta_B_dot"])

    def check_iterations(self, folder):
        columns, rows = flying.table(folder, "iterations.csv")
        last = {row[columns.index("step")]: row for row in rows}
        residuals = [i for i, name in enumerate(columns) if name.startswith("residual")]
        self.assertEqual([columns[i] for i in residuals], ["residual_" + name for name in RESIDUALS])
        for step in range(PRESCRIBED + 1, STEPS + 1):
            for i in residuals:
                self.assertLessEqual(abs(last[step][i]), TOLERANCE)

    def check_bag(self, folder):
        with rosbag.Bag(os.path.join(folder, "flight.bag")) as bag:
            topics = bag.get_type_and_topic_info().topics
            self.assertEqual(set(topics), TOPICS)
            for topic in ("/clock", "/tf", "/monarch_flight/state", "/monarch_flight/iterations"):
                self.assertEqual(topics[topic].message_count, STEPS + 1, topic)
            self.assertEqual(bag.get_start_time(), 1.0)

    def check_case_flies_alone(self, expected):
        """The resolved case repeats the flight without any key."""
        code, output = self.fly("case:=" + os.path.join(self.out("nodes"), "case.yaml"),
                                "in_process:=true", "record:=false", "out:=" + self.out("again"))
        self.assertEqual(code, 0, output)
        self.assertEqual(flying.summary(self.out("again"))["state_sha256"], expected)
        self.assertFalse(os.path.exists(os.path.join(self.out("again"), "flight.bag")))


if __name__ == "__main__":
    unittest.main()
