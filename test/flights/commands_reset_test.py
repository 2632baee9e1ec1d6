#!/usr/bin/python3
"""A run that a person leads by commands and sets back: what was commanded before leaves no trace."""
import sys
import unittest

import flying
import leading

KEYS = ("case:=climb_trimmed", "fluid:=quasi_steady", "flaps:=1.5", "steps_per_flap:=100")
STEPS, FLAP, LED = 150, 100, 120


class CommandsReset(leading.Leader):
    def test_commands_before_and_after_a_reset(self):
        process, command = self.held_flight(*KEYS)
        command(amplitude=0.1, at_once=True)
        self.good("step", 20)
        command(amplitude=0.2)  # waits for the next flap, on which the reset comes first
        self.good("step", 5)
        command(deviation_mean=0.05, at_once=True)  # no step takes it
        self.assertEqual(self.good("reset"), "held behind step 0")
        self.good("step", LED)  # over the beginning of a flap
        command(amplitude=-0.1, at_once=True)
        self.good("resume")
        code, output = self.finish(process, 120)
        self.assertEqual(code, 0, output)
        code, output = self.fly(*KEYS, "in_process:=true", "out:=" + self.out("motion"))
        self.assertEqual(code, 0, output)
        columns, rows = flying.table(self.out(), "flight.csv")
        plain = flying.table(self.out("motion"), "flight.csv")[1]
        self.assertEqual(len(rows), STEPS + 1)
        self.assertEqual(rows[:LED + 1], plain[:LED + 1])
        amplitude = columns.index("command_amplitude")
        self.assertEqual([row[amplitude] for row in rows],
                         (LED + 1) * [0] + (STEPS - LED) * [-0.1])


if __name__ == "__main__":
    sys.exit(unittest.main())
