#!/usr/bin/python3
"""Commands of a person whose language has a decimal comma; left out where a program for it is missing."""
import os
import shutil
import subprocess
import unittest

import flying

NEEDED = ("Xvfb", "rviz", "import", "compare")


@unittest.skipUnless(shutil.which("localedef"), "needs localedef")
class Language(flying.FlightTest):
    def german(self):
        """Environment of a person in Germany."""
        places = os.path.join(self.folder, "locale")
        os.mkdir(places)
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", places + "/de_DE.UTF-8"],
                              capture_output=True, check=False)
        if made.returncode != 0:
            self.skipTest("no German locale can be made: %r" % made.stderr)
        german = dict(LOCPATH=places, LC_ALL="de_DE.UTF-8")
        third = subprocess.run(["awk", "BEGIN { print 1 / 3 }"], capture_output=True, text=True, check=True,
                               env=dict(os.environ, **german))
        self.assertTrue(third.stdout.startswith("0,333"), third.stdout)
        return german

    def test_a_flight_over_nodes(self):
        keys = ("case:=climb_printed", "fluid:=quasi_steady", "flaps:=0.1")
        for name, language in (("german", self.german()), ("plain", {})):
            code, output = self.fly(*keys, "out:=" + self.out(name), **language)
            self.assertEqual(code, 0, output)
        hashes = [flying.summary(self.out(name))["state_sha256"] for name in ("german", "plain")]
        self.assertEqual(*hashes)

    @unittest.skipUnless(all(map(shutil.which, NEEDED)), "needs " + ", ".join(NEEDED))
    def test_a_picture_of_a_flight(self):
        german = self.german()
        code, output = self.fly("case:=climb_printed", "fluid:=quasi_steady", "in_process:=true", "flaps:=0.1",
                                "out:=" + self.out(), **german)
        self.assertEqual(code, 0, output)
        taken = subprocess.run([flying.MONARCH, "screenshot", self.out() + "/flight.bag"],
                               capture_output=True, text=True, timeout=300, env=self.environment(**german), check=False)
        self.assertEqual(taken.returncode, 0, taken.stdout + taken.stderr)
        self.assertGreater(os.path.getsize(self.out() + "/flight.png"), 10000)


if __name__ == "__main__":
    unittest.main()
