"""Whole flights for the tests, through the commands that a person types, each in its own folder."""
import csv
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ.get("MONARCH_BUILD", os.path.join(ROOT, "build"))
MONARCH = os.path.join(ROOT, "scripts", "monarch")
NODE_DIR = os.path.join(BUILD, "devel", "lib", "monarch_flight")
sys.path.insert(0, os.path.join(ROOT, "python"))


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class FlightTest(unittest.TestCase):
    """Gives each test an empty folder and ends what it started."""

    place = None  # where commands are called, if not here

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="flight_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.master = "http://localhost:%d" % free_port()

    def out(self, name="out"):
        return os.path.join(self.folder, name)

    def environment(self, **more):
        env = {k: v for k, v in os.environ.items() if not k.startswith("ROS_") and k != "DISPLAY"}
        env.update(MONARCH_BUILD=BUILD, MONARCH_AS_BUILT="1",
                   ROS_LOG_DIR=os.path.join(self.folder, "log"), **more)
        return env

    def start(self, *arguments, **environment):
        """scripts/fly with these arguments, not waited for; stdout and stderr in one file."""
        if not any(word.startswith("report") or ":=" not in word for word in arguments):
            arguments += ("report:=false",)  # test/flights/report_test.py has its own
        log = open(os.path.join(self.folder, "fly_%d.txt" % time.monotonic_ns()), "w+")
        self.addCleanup(log.close)
        process = subprocess.Popen(
            [os.path.join(ROOT, "scripts", "fly"), *arguments], stdout=log, stderr=log,
            stdin=subprocess.DEVNULL, env=self.environment(**environment), cwd=self.place,
            # Tests in a shell's background do not hear SIGINT, and would hand that on.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        process.log = log
        self.addCleanup(self.end, process)
        return process

    def finish(self, process, limit):
        """(exit code, output) of a started command; the test fails when it takes longer."""
        try:
            process.wait(limit)
        except subprocess.TimeoutExpired:
            self.fail("still running after %g s:\n%s" % (limit, self.output(process)))
        return process.returncode, self.output(process)

    def fly(self, *arguments, limit=120, **environment):
        return self.finish(self.start(*arguments, **environment), limit)

    @staticmethod
    def output(process):
        process.log.flush()
        with open(process.log.name) as f:
            return f.read()

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    @staticmethod
    def go_on(pid):
        """After SIGSTOP."""
        try:
            os.kill(pid, signal.SIGCONT)
        except ProcessLookupError:
            pass

    def wait_for(self, condition, limit, what):
        deadline = time.monotonic() + limit
        while time.monotonic() < deadline:
            value = condition()
            if value:
                return value
            time.sleep(0.1)
        self.fail("waited %g s in vain for %s" % (limit, what))
        return None


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as f:
        return json.load(f)


def table(folder, name):
    """(columns, rows of numbers) of a CSV file of a run."""
    with open(os.path.join(folder, name), newline="") as f:
        lines = list(csv.reader(f))
    return lines[0], [[float(x) for x in line] for line in lines[1:]]
