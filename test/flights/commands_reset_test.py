#!/usr/bin/python3
"""A run that a person leads by commands and sets back: what was commanded before leaves no trace."""
import sys
import unittest

import flying
import leading

KEYS = ("case:=climb_trimmed", "fluid:=quasi_steady", "flaps:=1.5", "steps_per_flap:=100")
STEPS, FLAP, LED = 150, 100, 120


class CommandsReset(leading.Leader):
    def after_a_reset(self, name, commanded, *keys):
        """Columns and rows of a flight set back behind commands, in the end led by -0.1; rows without any command."""
        process, command = self.held_flight(*keys, out=self.out(name))
        command(**{commanded: 0.1}, at_once=True)
        self.good("step", 20)
        command(**{commanded: 0.2})  # waits for the next flap, on which the reset comes first
        self.good("step", 5)
        command(deviation_mean=0.05, at_once=True)  # no step takes it
        self.assertEqual(self.good("reset"), "held after step 0")
        self.good("step", LED)  # over the beginning of a flap
        command(**{commanded: -0.1}, at_once=True)
        self.good("resume")
        code, output = self.finish(process, 120)
        self.assertEqual(code, 0, output)
        plain = self.out(name + "_plain")
        code, output = self.fly(*keys, "in_process:=true", "out:=" + plain)
        self.assertEqual(code, 0, output)
        return *flying.table(self.out(name), "flight.csv"), flying.table(plain, "flight.csv")[1]

    def check(self, name, commanded, *keys):
        columns, rows, plain = self.after_a_reset(name, commanded, *keys)
        self.assertEqual(len(rows), STEPS + 1)
        self.assertEqual(rows[:LED + 1], plain[:LED + 1])
        led = columns.index("command_" + commanded)
        self.assertEqual([row[led] for row in rows], (LED + 1) * [0] + (STEPS - LED) * [-0.1])
        return columns, rows

    def test_commands_before_and_after_a_reset(self):
        self.check("mirrored", "amplitude", *KEYS)
        columns, rows = self.check("independent", "differential_amplitude", *KEYS, "wings:=independent")
        roll = [row[columns.index("roll")] for row in rows]
        self.assertEqual(roll[:LED + 1], (LED + 1) * [0])
        self.assertGreater(abs(roll[-1]), 1e-3)


if __name__ == "__main__":
    sys.exit(unittest.main())
