"""What comes before a command: packages that it can do without, and a compiler that is stopped."""
import contextlib
import io
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import places, preparing  # noqa: E402

STOPPED = """
import signal, sys
from monarch_flight import preparing
from monarch_flight.command import main
main.answer(main.interrupted)
try:
    preparing.must(["/bin/bash", "-c", sys.argv[1]])
except KeyboardInterrupt:
    sys.exit(130)
"""


class Preparing(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "scripts").mkdir()
        for name, value in (("source", self.folder), ("own_build", self.folder)):
            self.enterContext(mock.patch.object(places, name, lambda value=value: value))

    def tried(self, code):
        """(sections that were installed, words) of one try that ends with this code."""
        script, log = self.folder / "scripts/install", self.folder / "log"
        script.write_text(f'#!/bin/sh\necho "$1" >>"{log}"\nexit {code}\n', encoding="utf-8")
        script.chmod(0o755)
        log.write_text("", encoding="utf-8")
        words = io.StringIO()
        with contextlib.redirect_stderr(words):
            preparing.tried("report")
        return log.read_text(encoding="utf-8").split(), words.getvalue()

    def test_what_could_not_be_installed_is_not_tried_again_on_the_same_day(self):
        sections, words = self.tried(1)
        self.assertEqual(sections, ["report"])
        self.assertIn("scripts/install report tries again, and this command after a day", words)
        self.assertEqual(self.tried(1), ([], ""))
        day_before = time.time() - preparing.AGAIN - 1
        os.utime(self.folder / ".no_report", (day_before, day_before))
        self.assertEqual(self.tried(0), (["report"], ""))
        self.assertEqual(self.tried(0), (["report"], ""))

    def processes_of(self, script):
        """(exit code, whether its children live) of a command that is ended by SIGTERM to it alone, while these work."""
        file = self.folder / "pids"
        process = subprocess.Popen(["/usr/bin/python3", "-c", STOPPED, script.format(file=file)],
                                   env=dict(os.environ, PYTHONPATH=str(ROOT / "python")))
        end = time.monotonic() + 20
        while not (file.exists() and len(file.read_text(encoding="utf-8").split()) == 2) and time.monotonic() < end:
            time.sleep(0.05)
        pids = file.read_text(encoding="utf-8").split()
        self.assertTrue(all(os.path.exists(f"/proc/{pid}") for pid in pids))
        process.send_signal(signal.SIGTERM)
        return process.wait(40), [pid for pid in pids if self.lives(pid)]

    @staticmethod
    def lives(pid):
        try:
            return pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
        except OSError:
            return False

    def test_a_compiler_does_not_outlive_its_command(self):
        """Nor does whoever stands in another session."""
        self.assertEqual(self.processes_of("sleep 60 & echo $! >>'{file}'; setsid sleep 60 & echo $! >>'{file}'; wait; true"),
                         (130, []))


if __name__ == "__main__":
    unittest.main()
