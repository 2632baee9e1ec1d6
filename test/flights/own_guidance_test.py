#!/usr/bin/python3
"""A guidance node of one's own, in Python: what it leads is the same again, and can be flown again
without it."""
import os
import unittest

import flying
from guided import AIR, CLIMB, LED, Guided


class OwnGuidance(Guided):
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
            code, output = self.fly("resume:=" + self.out(fault), own[-1], **environment)
            self.assertEqual(code, 0, output)
            self.assertIn("goes on after step 19", output)
            self.assertEqual(self.sha(fault), self.sha("led"))

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

    def test_in_cpp(self):
        """Joint angles of its own, level by level; the fluid and the body answer to them."""
        keys = (*CLIMB, "flaps:=0.3")
        self.complete("cpp", *keys, "guidance_node:=own_guidance_node")
        self.complete("motion", *keys, "in_process:=true")
        psi = {}
        for name in ("cpp", "motion"):
            columns, rows = flying.table(self.out(name), "flight.csv")
            psi[name] = [row[columns.index("psi")] for row in rows]
        self.assertEqual(len(psi["cpp"]), 31)
        for own, case in zip(psi["cpp"], psi["motion"]):
            self.assertAlmostEqual(own - case, 0.02, delta=1e-12)
        self.assertNotEqual(self.sha("cpp"), self.sha("motion"))
        self.complete("again", "replay:=" + self.out("cpp"), "in_process:=true")
        self.assertEqual(self.sha("again"), self.sha("cpp"))

    def test_programs_that_cannot_be_started(self):
        name = "locked_guidance_%d.py" % os.getpid()
        path = os.path.join(flying.NODE_DIR, name)
        self.addCleanup(os.remove, path)
        with open(path, "w") as f:
            f.write("#!/usr/bin/python3\n")
        code, output = self.fly(*CLIMB, "guidance_node:=" + name, "fluid_node:=nobody.py",
                                "out:=" + self.out(), limit=30)
        self.assertEqual(code, 2, output)
        self.assertIn("guidance_node:=%s: %s is not executable; chmod +x %s" % (name, path, path),
                      output)
        self.assertIn("fluid_node:=nobody.py: no program of this name in the package; put it into",
                      output)
        self.assertNotIn("roslaunch", output)
        told = [line for line in output.splitlines() if "has a master of its own" not in line]
        self.assertEqual(len(told), 3, output)  # and that nothing was flown
        self.assertFalse(os.path.exists(self.out()))

    def test_wrong_keys(self):
        os.mkdir(self.out("empty"))
        for keys, words in (
                (("guidance:=node",), "name its program by guidance_node:="),
                (("guidance:=wings",), "must be motion, commands, controller, node or replay"),
                ((LED, "guidance:=commands"), "needs guidance:=node, not commands"),
                ((LED, "in_process:=true"), "guidance_node:=climb_guidance.py: needs the nodes"),
                (("guidance:=commands", "in_process:=true"), "guidance:=commands: needs the nodes"),
                (("guidance:=replay",), "name the folder of the recorded flight by replay:="),
                (("replay:=" + self.out("empty"),), "not the folder of a recorded flight"),
                (("replay:=" + self.out("empty"), "case:=climb_printed"), "give only one of them")):
            code, output = self.fly(*keys, "out:=" + self.out())
            self.assertEqual(code, 2, output)
            self.assertIn(words, output)


if __name__ == "__main__":
    unittest.main()
