"""rviz of a flight where it cannot be shown."""
import os
import pathlib
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Show(unittest.TestCase):
    def test_without_a_display_it_says_what_to_do(self):
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        environment["PYTHONPATH"] = f"{ROOT / 'python'}:{environment.get('PYTHONPATH', '')}"
        done = subprocess.run(["/usr/bin/python3", ROOT / "scripts/show.py", "theme:=light", "__name:=rviz"], timeout=30,
                              env=environment, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for words in ("there is no display", "rviz:=false", "monarch film"):
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
