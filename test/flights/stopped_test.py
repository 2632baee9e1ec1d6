#!/usr/bin/python3
"""Ctrl-C, SIGTERM, the end of the terminal: what is said fits what there is to go on with."""
import fcntl
import os
import shutil
import signal
import subprocess
import termios
import threading
import time
import unittest

import flying

KEYS = ("case:=climb_printed", "fluid:=quasi_steady")
NOTHING = "stopped by hand before the first step: nothing was flown"


stop_draining = threading.Event()


def terminal():
    """In a child: its standard input is the terminal whose end it hears."""
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)


def drain(head):
    """Reads what is written to a terminal, until told to leave it."""
    os.set_blocking(head, False)
    while not stop_draining.wait(0.05):
        try:
            os.read(head, 65536)
        except OSError:
            pass


class Stopped(flying.FlightTest):
    def stop(self, process, number=signal.SIGINT):
        process.send_signal(number)
        code, output = self.finish(process, 60)
        self.assertEqual(code, 130, output)
        return output

    def begun(self, process, word):
        self.wait_for(lambda: word in self.output(process), 60, word)

    def check_nothing(self, output):
        self.assertIn(NOTHING, output)
        self.assertNotIn("resume:=", output)

    def test_before_there_is_a_folder(self):
        process = self.start(*KEYS, "out:=" + self.out())
        self.begun(process, "started roslaunch server")
        output = self.stop(process)
        if not os.path.exists(self.out()):
            self.check_nothing(output)

    def test_held_at_the_start(self):
        process = self.start(*KEYS, "paused:=true", "out:=" + self.out())
        self.begun(process, "results in " + self.out())
        self.check_nothing(self.stop(process))
        self.assertEqual(flying.summary(self.out())["steps"], 0)

    def test_at_any_time_before(self):
        """While python, roslaunch or the nodes begin: one message, no advice to resume what is not there."""
        for delay in (0.05, 0.1, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1.0, 1.3):
            process = self.start(*KEYS, "out:=" + self.out())
            time.sleep(delay)
            process.send_signal(signal.SIGINT)
            code, output = self.finish(process, 60)
            if "KeyboardInterrupt" in output and code != 130:
                continue  # python itself was beginning
            self.assertIn(code, (130, -signal.SIGINT), output)  # the latter: before there was a command
            if not os.path.exists(self.out()):
                self.assertNotIn("resume:=", output)
                self.assertEqual(output.count(NOTHING), int(code == 130), output)
            shutil.rmtree(self.out(), ignore_errors=True)

    def fly_and_stop(self, *keys, number=signal.SIGINT):
        process = self.start(*KEYS, "in_process:=true", "record:=false", "flaps:=2000", "out:=" + self.out(), *keys)
        table = os.path.join(self.out(), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table) and os.path.getsize(table) > 10000, 60, "some steps")
        output = self.stop(process, number)
        self.assertGreater(flying.summary(self.out())["steps"], 0)
        self.assertNotIn(NOTHING, output)
        return output

    def test_in_flight(self):
        self.assertIn("goes on with scripts/fly resume:=" + self.out(), self.fly_and_stop())

    def test_in_flight_by_sigterm(self):
        self.assertIn("goes on with scripts/fly resume:=" + self.out(), self.fly_and_stop(number=signal.SIGTERM))

    def test_closed_terminal(self):
        """The end of the terminal reaches monarch alone; the nodes make their checkpoint, and the run goes on."""
        head, tail = os.openpty()
        process = subprocess.Popen([flying.MONARCH, "fly", *KEYS, "flaps:=1", "out:=" + self.out()], stdin=tail,
                                   stdout=tail, stderr=tail, env=self.environment(MONARCH_ANSWER_DELAY_MS="6"),
                                   start_new_session=True, preexec_fn=terminal)
        os.close(tail)
        self.addCleanup(process.kill)
        reader = threading.Thread(target=drain, args=(head,), daemon=True)
        reader.start()
        self.wait_for(lambda: os.path.exists(self.out() + "/flight.csv.active") and
                      os.path.getsize(self.out() + "/flight.csv.active") > 10000, 60, "some steps")
        stop_draining.set()
        reader.join(5)
        os.close(head)
        self.assertEqual(process.wait(60), 130)
        self.assertIn("interrupted", flying.summary(self.out())["failure"])
        code, output = self.fly("resume:=" + self.out(), "in_process:=true")
        self.assertEqual(code, 0, output)

    def test_in_flight_without_checkpoints(self):
        output = self.fly_and_stop("checkpoint_every:=0")
        self.assertIn("has no checkpoint to go on from", output)
        self.assertNotIn("resume:=", output)


if __name__ == "__main__":
    unittest.main()
