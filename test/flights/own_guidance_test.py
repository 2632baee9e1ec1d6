#!/usr/bin/python3
"""A guidance node of one's own, in Python (examples/climb_guidance.py): what it leads can be flown
again, goes on after a crash, and ends with the node's name when the node is lost."""
import glob
import os
import re
import signal
import time
import unittest

import yaml

import flying

AIR = ("fluid:=quasi_steady", "steps_per_flap:=100")
CLIMB = ("case:=climb_trimmed", *AIR)
LED = "guidance_node:=climb_guidance.py"
LIMIT = 60.0  # seconds


class OwnGuidance(flying.FlightTest):
    def case(self, name="case", **changes):
        """climb_trimmed with other values: section/key as section__key."""
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_trimmed.yaml")) as f:
            case = yaml.safe_load(f)
        for place, value in changes.items():
            section = case
            *path, key = place.split("__")
            for part in path:
                section = section.setdefault(part, {})
            section[key] = value
        path = os.path.join(self.folder, name + ".yaml")
        with open(path, "w") as f:
            yaml.safe_dump(case, f)
        return "case:=" + path

    def complete(self, name, *keys, **more):
        code, output = self.fly(*keys, "out:=" + self.out(name), **more)
        self.assertEqual(code, 0, output)
        self.assertEqual(flying.summary(self.out(name))["status"], "complete", output)

    def sha(self, name):
        return flying.summary(self.out(name))["state_sha256"]

    def test_the_example_flies_twice_the_same_and_is_flown_again(self):
        for name in ("first", "second"):
            self.complete(name, *CLIMB, LED, "flaps:=2")
        replay = "replay:=" + self.out("first")
        self.complete("again", replay, "in_process:=true")
        self.complete("again_by_nodes", replay)
        self.complete("once_more", "replay:=" + self.out("again"), "in_process:=true")
        first = flying.table(self.out("first"), "flight.csv")
        for name in ("second", "again", "again_by_nodes", "once_more"):
            self.assertEqual(self.sha(name), self.sha("first"), name)
            self.assertEqual(flying.table(self.out(name), "flight.csv"), first, name)
        columns, rows = first
        for name in ("command_amplitude", "applied_deviation_mean"):
            self.assertTrue(any(row[columns.index(name)] for row in rows), name)

    def test_joint_angles_of_its_own(self):
        self.complete("led", *CLIMB, LED, "flaps:=1")
        own = (*CLIMB, "flaps:=1", "guidance_node:=recorded_guidance.py")
        environment = {"MONARCH_TEST_FLIGHT": self.out("led") + "/flight.csv"}
        self.complete("own", *own, **environment)
        self.assertEqual(self.sha("own"), self.sha("led"))
        for fault, words in (("error", "RuntimeError: this level is meant to go wrong"),
                             ("nan", "non-finite number")):
            code, output = self.fly(*own, "out:=" + self.out(fault), **environment,
                                    MONARCH_TEST_FAULT=fault + ":20")
            self.assertNotIn(code, (0, 130), output)
            summary = flying.summary(self.out(fault))
            self.assertIn(words, summary["failure"])
            self.assertIn("step 20", summary["failure"])
            self.assertEqual(summary["steps"], 19)

    def test_the_example_holds_the_climb(self):
        """Of an insect whose periodic flight is another: it tumbles without."""
        case = self.case(insect__abdomen__mass=1.6e-4)
        self.complete("held", case, *AIR, LED, "flaps:=7", "record:=false", limit=240)
        self.complete("tumbles", case, *AIR, "flaps:=7", "record:=false", "in_process:=true")
        self.assertGreater(self.largest_pitch("tumbles"), 60)
        self.assertLess(self.largest_pitch("held"), 60)

    def largest_pitch(self, name):
        pitch = flying.summary(self.out(name))["theta_B_deg"]
        return max(abs(pitch["min"]), abs(pitch["max"]))

    def airborne(self, *keys, **environment):
        """A long flight under way, and the process ids of its nodes."""
        process = self.start(LED, "out:=" + self.out(), *keys, **environment)
        table = os.path.join(self.out(), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table) and os.path.getsize(table) > 20000, 120,
                      "the flight to begin; so far: " + self.output(process))
        pids = self.pids(process)
        self.assertEqual(set(pids), {"coordinator", "fluid", "flight", "wing", "guidance"})
        return process, pids

    def pids(self, process):
        return {name: int(pid) for name, pid in re.findall(
            r"process\[monarch_flight/(\w+)-\d+\]: started with pid \[(\d+)\]",
            self.output(process))}

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

    @staticmethod
    def go_on(pid):
        try:
            os.kill(pid, signal.SIGCONT)
        except ProcessLookupError:
            pass

    def test_killed_and_interrupted_flights_go_on(self):
        """Ctrl-C comes within a step, when guidance has prescribed the next level already."""
        keys = (*CLIMB, "flaps:=3", "checkpoint_every:=50")
        self.complete("whole", *keys, LED)
        process = self.start(*keys, LED, "out:=" + self.out(), MONARCH_ANSWER_DELAY_MS="6")
        self.wait_for(lambda: glob.glob(self.out() + "/checkpoints/step_*0"), 120,
                      "a checkpoint; so far: " + self.output(process))
        os.kill(self.pids(process)["coordinator"], signal.SIGKILL)
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)

        resume = "resume:=" + self.out()
        code, output = self.fly(resume)
        self.assertEqual(code, 2, output)
        self.assertIn("name its program by guidance_node:=", output)

        process = self.start(resume, LED, MONARCH_ANSWER_DELAY_MS="6")
        self.wait_for(lambda: "goes on behind step" in self.output(process), 60, "the flight")
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

    def test_wrong_keys(self):
        os.mkdir(self.out("empty"))
        for keys, words in (
                (("guidance:=node",), "name its program by guidance_node:="),
                (("guidance:=wings",), "must be motion, commands, controller, node or replay"),
                ((LED, "guidance:=commands"), "needs guidance:=node, not commands"),
                ((LED, "in_process:=true"), "guidance_node: needs the nodes"),
                (("guidance:=commands", "in_process:=true"), "guidance:=commands: needs the nodes"),
                (("guidance:=replay",), "name the folder of the recorded flight by replay:="),
                (("replay:=" + self.out("empty"),), "not the folder of a recorded flight"),
                (("replay:=" + self.out("empty"), "case:=climb_printed"), "give only one of them")):
            code, output = self.fly(*keys, "out:=" + self.out())
            self.assertEqual(code, 2, output)
            self.assertIn(words, output)


if __name__ == "__main__":
    unittest.main()
