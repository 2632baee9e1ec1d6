#!/usr/bin/python3
"""monarch where a shell has sourced the build: in PATH, beside the messages, with the programs of that build."""
import os
import subprocess
import unittest

import flying

CALLS = """
source "$1/devel/setup.bash"
cd "$2"
test "$(command -v monarch)" = "$1/devel/bin/monarch"
/usr/bin/python3 -c 'import monarch_flight.keys; from monarch_flight.msg import FlightState'
monarch plan case:=plate_re100
monarch fly case:=climb_printed fluid:=quasi_steady flaps:=0.1 in_process:=true out:=flown
monarch summary flown
"""


class InPath(flying.FlightTest):
    def test_a_sourced_build(self):
        environment = {name: os.environ[name] for name in ("HOME",) if name in os.environ}
        shell = subprocess.run(["bash", "-ec", CALLS, "bash", os.path.abspath(flying.BUILD), self.folder], timeout=120,
                               env=dict(environment, PATH="/usr/bin:/bin", MONARCH_AS_BUILT="1"), text=True, check=False,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(shell.returncode, 0, shell.stdout)
        self.assertIn("cells a mean chord", shell.stdout)
        self.assertEqual(flying.summary(self.out("flown"))["status"], "complete")


if __name__ == "__main__":
    unittest.main()
