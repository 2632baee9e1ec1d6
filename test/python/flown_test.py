"""Which programs beside it flown.py takes for nodes of its flight."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scripts")]
import flown  # noqa: E402


class Siblings(unittest.TestCase):
    def started(self, *words):
        """A program that lives until the end of the test, with these words behind it."""
        process = subprocess.Popen(words, stdin=subprocess.PIPE)
        self.addCleanup(process.wait)
        self.addCleanup(process.stdin.close)
        return process

    def seen(self):
        """What flown.py would see, were it a child of this process, too."""
        with mock.patch("os.getppid", os.getpid):
            return flown.siblings()

    def wait(self, expected):
        end = time.monotonic() + 10
        while self.seen() != expected and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(self.seen(), expected)

    def test_nodes_by_the_name_that_roslaunch_gives(self):
        self.started("/bin/sh", "-c", "read x", "drag_fluid.py", "__name:=fluid", "__log:=/x.log")
        self.started("/bin/sh", "-c", "read x", "mpirun", "-np", "2", "my_left", "__name:=fluid_left")
        self.started("/bin/sh", "-c", "read x", "fluid", "__name:=theirs")
        self.wait({"fluid", "fluid_left"})

    def test_rviz_whatever_name_the_launch_file_of_others_gives(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        program = os.path.join(folder, "rviz")
        os.symlink("/bin/sh", program)
        self.started(program, "-c", "read x", "__name:=their_view")
        self.wait({"rviz"})

    def test_who_has_ended_is_gone(self):
        process = self.started("/bin/sh", "-c", "read x", "wing", "__name:=wing")
        self.wait({"wing"})
        process.kill()  # nobody has waited for it yet
        self.wait(set())

    def test_rviz_goes_on_after_a_flight_and_not_after_a_refused_one(self):
        for nodes, code, expected in (({"rviz"}, 0, True), ({"rviz"}, -1, True), ({"rviz"}, flown.REFUSED, False),
                                      ({"coordinator", "rviz"}, flown.REFUSED, True), ({"fluid"}, 0, False)):
            with mock.patch("flown.siblings", return_value=nodes), mock.patch("flown.ask", return_value=code):
                self.assertEqual(bool(flown.goes_on()), expected, (nodes, code))


if __name__ == "__main__":
    unittest.main()
