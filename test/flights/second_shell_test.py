#!/usr/bin/python3
"""What scripts/fly prints for a second shell works there as it stands."""
import os
import subprocess
import unittest

import flying

KEYS = ("case:=climb_trimmed", "fluid:=quasi_steady", "flaps:=0.5", "steps_per_flap:=100")
WORDS = "in a second shell"
LEAD = """
until rosservice call /monarch_flight/pause >/dev/null 2>&1; do sleep 0.2; done
rostopic pub -1 /monarch_flight/command monarch_flight/WingbeatCommand '{amplitude: 0.1, at_once: true}' &&
rosservice call /monarch_flight/resume
"""


class SecondShell(flying.FlightTest):
    def line(self, process):
        def printed():
            lines = self.output(process).splitlines()
            at = next((i for i, text in enumerate(lines) if WORDS in text), len(lines))
            return lines[at + 1:at + 2]

        return self.wait_for(printed, 60, "the line for a second shell")[0]

    @unittest.skipUnless(os.path.exists("/usr/bin/rostopic") and os.path.exists("/usr/bin/rosservice"),
                         "needs scripts/install tools")
    def test_the_line_leads_the_flight(self):
        process = self.start(*KEYS, "guidance:=commands", "paused:=true", "out:=" + self.out())
        environment = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
        shell = subprocess.run(["bash", "-c", self.line(process) + LEAD], env=environment, timeout=90,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(shell.returncode, 0, shell.stdout)
        code, output = self.finish(process, 60)
        self.assertEqual(code, 0, output)
        columns, rows = flying.table(self.out(), "flight.csv")
        self.assertEqual({row[columns.index("command_amplitude")] for row in rows[1:]}, {0.1})

    def test_who_is_told(self):
        """Where the case says so, too; not where nobody can lead."""
        path = os.path.join(self.folder, "case.yaml")
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_trimmed.yaml")) as f, \
                open(path, "w") as g:
            g.write(f.read() + "\nguidance:\n  type: commands\n")
        process = self.start("case:=" + path, *KEYS[1:], "out:=" + self.out())
        self.assertIn("; export ROS_MASTER_URI=http://localhost:", self.line(process))
        self.assertEqual(self.finish(process, 90)[0], 0)
        code, output = self.fly(*KEYS, "out:=" + self.out("nobody"))
        self.assertEqual(code, 0, output)
        self.assertNotIn("\033", output)  # no terminal, no colours
        self.assertNotIn(WORDS, output)


if __name__ == "__main__":
    unittest.main()
