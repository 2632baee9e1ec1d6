#!/usr/bin/python3
"""A guidance node that is lost ends the flight by its name, one that is late changes nothing, and a
flight that it led goes on."""
import glob
import os
import signal
import time
import unittest

import flying
from guided import AIR, CLIMB, LED, Guided

LIMIT = 60.0  # seconds


class LostGuidance(Guided):
    def airborne(self, *keys, **environment):
        """A long flight under way, and the process ids of its nodes."""
        process = self.start(LED, "out:=" + self.out(), *keys, **environment)
        table = os.path.join(self.out(), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table) and os.path.getsize(table) > 20000, 120,
                      "the flight to begin")
        pids = self.pids(process)
        self.assertEqual(set(pids), {"coordinator", "fluid", "flight", "wing", "guidance"})
        return process, pids

    def failure(self, process):
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)
        summary = flying.summary(self.out())
        self.assertEqual(summary["status"], "failed")
        self.assertEqual(glob.glob(self.out() + "/*.active"), [])
        return summary["failure"]

    def test_killed(self):
        process, pids = self.airborne(*CLIMB, "flaps:=500")
        os.kill(pids["guidance"], signal.SIGKILL)
        self.assertRegex(self.failure(process),
                         r"^the guidance node \(/monarch_flight/guidance\) is lost .*step \d+")
        self.assertIn("fly: the node monarch_flight/guidance died", self.output(process))

    def test_hangs(self):
        """Found by the watchdog, here 3 s. What hangs for a shorter time is waited for."""
        process, pids = self.airborne(self.case(watchdog_s=3), *AIR, "flaps:=500")
        self.addCleanup(self.go_on, pids["guidance"])
        os.kill(pids["guidance"], signal.SIGSTOP)
        self.assertRegex(self.failure(process), r"^the guidance node .* did not answer step \d+, "
                         r"sub-iteration 0, (ITERATE|COMMIT) within 3\.0 s \(watchdog\)")

    def test_late(self):
        self.complete("prompt", *CLIMB, LED, "flaps:=2")
        process, pids = self.airborne(*CLIMB, "flaps:=2", MONARCH_ANSWER_DELAY_MS="4")
        self.addCleanup(self.go_on, pids["guidance"])
        os.kill(pids["guidance"], signal.SIGSTOP)
        time.sleep(1.5)
        self.go_on(pids["guidance"])
        code, output = self.finish(process, LIMIT)
        self.assertEqual(code, 0, output)
        self.assertEqual(self.sha("out"), self.sha("prompt"))

    def test_killed_and_interrupted_flights_go_on(self):
        """Ctrl-C comes within a step, when guidance has prescribed the next level already."""
        keys = (*CLIMB, "flaps:=3", "checkpoint_every:=50")
        self.complete("whole", *keys, LED)
        process = self.start(*keys, LED, "out:=" + self.out(), MONARCH_ANSWER_DELAY_MS="6")
        self.wait_for(lambda: glob.glob(self.out() + "/checkpoints/step_*0"), 120,
                      "a checkpoint")
        os.kill(self.pids(process)["coordinator"], signal.SIGKILL)
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)

        resume = "resume:=" + self.out()
        code, output = self.fly(resume)
        self.assertEqual(code, 2, output)
        self.assertIn("name its program by guidance_node:=", output)

        process = self.start(resume, LED, MONARCH_ANSWER_DELAY_MS="6")
        self.wait_for(lambda: "goes on after step" in self.output(process), 60, "the flight")
        self.wait_for(lambda: glob.glob(self.out() + "/checkpoints/step_00000002*"), 60, "more")
        process.send_signal(signal.SIGINT)
        code, output = self.finish(process, LIMIT)
        self.assertEqual(code, 130, output)
        self.assertIn("goes on with scripts/fly %s %s" % (resume, LED), output)
        self.assertRegex(flying.summary(self.out())["failure"],
                         r"^interrupted in step \d+; step \d+ is the last one committed$")

        code, output = self.fly(resume, LED, MONARCH_ANSWER_DELAY_MS="3")
        self.assertEqual(code, 0, output)
        self.assertEqual(self.sha("out"), self.sha("whole"))
        self.assertEqual(flying.table(self.out(), "flight.csv"),
                         flying.table(self.out("whole"), "flight.csv"))


if __name__ == "__main__":
    unittest.main()
