#!/usr/bin/python3
"""A flight led by hand: by commands on the topic, from the keyboard and a joystick
(examples/joy_guidance.py)."""
import os
import pty
import subprocess
import sys
import termios
import time
import unittest

import flying
import leading

KEYS = ("case:=climb_trimmed", "fluid:=quasi_steady", "flaps:=2", "steps_per_flap:=100")
STEPS, FLAP = 200, 100
COMMANDS = ("amplitude", "flapping_mean", "frequency", "deviation_mean", "rest_angle",
            "abdomen_mean", "abdomen_amplitude")


class Commands(leading.Leader):
    def test_commands_on_the_topic(self):
        process, command = self.held_flight(*KEYS)
        command(amplitude=0.1, deviation_mean=0.02)  # when the first flap begins
        self.good("step", 20)
        command(amplitude=0.5, deviation_mean=0.01, at_once=True)  # beyond the bounds
        command(amplitude=0.5, deviation_mean=0.01, at_once=True)
        self.good("step", 20)
        command(amplitude=float("nan"), at_once=True)
        self.good("step", 20)
        command(frequency=0.05)  # when the next flap begins
        self.good("resume")
        code, output = self.finish(process, 120)
        self.assertEqual(code, 0, output)
        for told in ("command amplitude = 0.5: is cut to 0.25; must be within",
                     "command amplitude = nan: must be a finite number; the message is refused"):
            self.assertEqual(output.count(told), 1, output)
        self.check_flight()
        self.check_replay()
        self.check_keyboard_and_joystick()

    def check_flight(self):
        columns, rows = flying.table(self.out(), "flight.csv")
        flight = {name: [row[i] for row in rows] for i, name in enumerate(columns)}
        commands = list(zip(*(flight["command_" + name] for name in COMMANDS)))
        begun = next(n for n, phase in enumerate(flight["phase"]) if phase >= 1.0 - 1e-9)
        self.assertEqual(begun, FLAP)  # the frequency was not commanded before
        expected = [(0,) * 7] + 20 * [(0.1, 0, 0, 0.02, 0, 0, 0)] + \
            (begun - 20) * [(0.25, 0, 0, 0.01, 0, 0, 0)] + \
            (STEPS - begun) * [(0, 0, 0.05, 0, 0, 0, 0)]
        self.assertEqual(commands, expected)
        self.assertEqual(flight["clipped"], 21 * [0] + (STEPS - 20) * [1])
        self.assertEqual(flight["refused"], 41 * [0] + (STEPS - 40) * [1])
        applied = flight["applied_amplitude"]
        self.assertEqual(applied[0], 0)
        self.assertTrue(all(0 <= a < 0.25 for a in applied))
        self.assertGreater(max(applied), 0.1)
        self.assertEqual(applied[:begun + 1], sorted(applied[:begun + 1]))
        self.assertLess(applied[-1], applied[begun])
        self.assertGreater(flight["applied_frequency"][-1], 0)
        self.assertGreater(flight["phase"][-1], 2)

    def check_replay(self):
        flown = flying.summary(self.out())["state_sha256"]
        for name, keys in (("process", ("in_process:=true",)), ("nodes", ())):
            code, output = self.fly("replay:=" + self.out(), "out:=" + self.out(name), *keys,
                                    ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost")
            self.assertEqual(code, 0, output)
            self.assertEqual(flying.summary(self.out(name))["state_sha256"], flown, name)
            self.assertEqual(flying.table(self.out(name), "flight.csv"),
                             flying.table(self.out(), "flight.csv"))
        code, output = self.fly("replay:=" + self.out(), "flaps:=3", "in_process:=true",
                                "out:=" + self.out("longer"))
        self.assertNotEqual(code, 0)
        self.assertIn("has 201 rows: must have one a level, 301", output)

    def check_keyboard_and_joystick(self):
        from monarch_flight.msg import WingbeatCommand
        from sensor_msgs.msg import Joy
        import rospy
        heard = []
        rospy.Subscriber("/monarch_flight/command", WingbeatCommand, heard.append)
        sticks = rospy.Publisher("/joy", Joy, queue_size=10)
        keyboard, terminal = pty.openpty()
        before = termios.tcgetattr(terminal)
        pilot = subprocess.Popen(
            ["/usr/bin/python3", os.path.join(flying.ROOT, "examples", "joy_guidance.py"),
             "_amplitude_range:=0.2"], stdin=terminal, stdout=terminal, stderr=terminal,
            env={**os.environ, "PYTHONUNBUFFERED": "1"})
        self.addCleanup(self.end, pilot)

        def lead(count, *, keys=b"", axes=(), buttons=()):
            if keys:
                os.write(keyboard, keys)
            else:
                sticks.publish(Joy(axes=axes, buttons=buttons))
            self.wait_for(lambda: len(heard) >= count, 20, "command %d" % count)
            return heard[-1]

        self.wait_for(lambda: sticks.get_num_connections(), 30, "the node")
        self.wait_for(lambda: termios.tcgetattr(terminal)[3] & termios.ICANON == 0, 10, "its keys")
        time.sleep(1.0)  # for the connection of its publisher
        self.assertAlmostEqual(lead(3, keys=b"eer").amplitude, 0.04)
        self.assertAlmostEqual(heard[-1].deviation_mean, 0.01047)
        self.assertTrue(lead(4, keys=b"o").at_once)
        self.assertEqual(lead(5, axes=[0.0, 1.0], buttons=6 * [0]).amplitude, 0.2)
        self.assertAlmostEqual(heard[-1].deviation_mean, 0.01047)  # of the keys; its stick rests
        self.assertFalse(lead(6, axes=[0.0, 1.0], buttons=5 * [0] + [1]).at_once)
        self.assertEqual(lead(7, axes=[0.0, 1.0], buttons=[1] + 5 * [0]), WingbeatCommand())
        self.assertEqual(lead(8, keys=b" "), WingbeatCommand())
        self.assertIn(b"amplitude +20.0 %", os.read(keyboard, 100000))
        os.write(keyboard, b"q")
        self.assertEqual(pilot.wait(20), 0)
        self.assertEqual(termios.tcgetattr(terminal), before)


if __name__ == "__main__":
    sys.exit(unittest.main())
