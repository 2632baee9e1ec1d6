#!/usr/bin/python3
"""The tutorials (docs/tutorials) do what they say: their blocks are saved and run as a person would, in a folder
that looks like the source tree. ```sh is run, ```console needs a person or a display, ```yaml NAME is saved, and
```python examples/NAME must be what is shipped."""
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree

import flying

TUTORIALS = os.path.join(flying.ROOT, "docs", "tutorials")
BLOCK = re.compile(r"(?ms)^```(\w+)(?: (\S+))?\n(.*?)^```$")
LIMIT = 300  # of a tutorial [s]


class Tutorials(flying.FlightTest):
    def setUp(self):
        super().setUp()
        for name in os.listdir(flying.ROOT):
            if name not in ("build", "flights") and not name.startswith("."):
                os.symlink(os.path.join(flying.ROOT, name), os.path.join(self.folder, name))
        os.symlink(flying.BUILD, os.path.join(self.folder, "build"))

    def text(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as f:
            return f.read()

    def followed(self, tutorial):
        """What its commands say, once its files are saved."""
        commands = []
        for language, name, text in BLOCK.findall(self.text("docs/tutorials/" + tutorial)):
            if "/" in name:
                self.assertIn(text.strip(), self.text(name), name + " is not what is shipped")
            elif name:
                with open(os.path.join(self.folder, name), "w", encoding="utf-8") as f:
                    f.write(text)
            elif language == "sh":
                commands.append(text)
            else:
                self.assertEqual(language, "console", "neither run nor saved")
        self.assertTrue(commands, "a tutorial without commands")
        script = "set -e\n" + "".join(commands)
        with open(os.path.join(self.folder, "output.txt"), "w+", encoding="utf-8") as output:
            done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment(), stdout=output,
                                  stderr=subprocess.STDOUT, timeout=LIMIT, check=False)
        self.assertEqual(done.returncode, 0, self.text("output.txt"))
        return self.text("output.txt")

    def flown(self, name):
        told = flying.summary(self.out("flights/" + name))
        self.assertEqual(told["status"], "complete")
        return told

    def test_1_first_flight(self):
        said = self.followed("1_first_flight.md")
        self.assertEqual(said.count(self.flown("first")["state_sha256"]), 2)
        for row in re.findall(r"(?m)^\| `([^|]*) \|", self.text("docs/tutorials/1_first_flight.md")):
            for name in re.findall(r"[\w -]+", row.replace("`", ",")):
                self.assertIn(name.strip(), said)

    def test_2_read_a_bag(self):
        said = self.followed("2_read_a_bag.md")
        self.assertRegex(said, r"flown 0\.19\d s, \d+\.\d mm forward, \d+\.\d mm up")
        self.assertRegex(said, r"highest point \d+\.\d mm, %d wrenches" % (self.flown("to_read")["steps"] + 1))  # level 0, too
        columns, _ = flying.table(self.out("flights/to_read"), "flight.csv")
        layout = xml.etree.ElementTree.parse(self.out("config/layouts/plotjuggler.xml"))
        for curve in layout.getroot().iter("curve"):
            axes = {curve.get("curve_x"), curve.get("curve_y")} - {None} or {curve.get("name")}
            self.assertLessEqual(axes, set(columns))

    def test_3_own_insect(self):
        said = self.followed("3_own_insect.md")
        lift, weight, ratio = map(float, re.search(
            r"lift (\S+) mN, weight (\S+) mN, ratio (\S+)", said).groups())
        self.assertAlmostEqual(weight, 9.81 * 0.1414, delta=1e-3)  # 141.4 mg
        self.assertAlmostEqual(lift / weight, ratio, delta=0.006)
        self.assertTrue(0.5 < ratio < 2.0, said)

    def test_4_own_motion(self):
        self.followed("4_own_motion.md")
        columns, series = flying.table(self.out("flights/my_motion"), "flight.csv")
        _, table = flying.table(self.out("flights/from_table"), "flight.csv")
        at = columns.index
        for name in ("x", "z", "phi", "theta_R"):
            for one, other in zip(series, table):  # the longer one is the motion
                self.assertAlmostEqual(one[at(name)], other[at(name)], delta=1e-9)

    def test_5_steer(self):
        self.followed("5_steer.md")
        self.assertEqual(self.flown("steered")["state_sha256"], self.flown("steered_again")["state_sha256"])
        columns, rows = flying.table(self.out("flights/steered"), "flight.csv")
        self.assertEqual(rows[-1][columns.index("command_amplitude")], 0.1)

    def test_6_own_controller(self):
        self.followed("6_own_controller.md")
        self.assertEqual(self.flown("own_controller")["guidance"]["type"], "node")
        columns, rows = flying.table(self.out("flights/own_controller"), "flight.csv")
        self.assertTrue(any(row[columns.index("command_deviation_mean")] for row in rows))

    def test_7_own_fluid(self):
        self.followed("7_own_fluid.md")
        columns, rows = flying.table(self.out("flights/vacuum"), "flight.csv")
        self.assertEqual({row[columns.index("FZ")] for row in rows}, {0.0})

    def test_8_cluster(self):
        self.followed("8_cluster.md")
        self.flown("two_ranks")
        subprocess.run(["bash", "-n", self.out("job.sh")], check=True)

    def test_every_tutorial_is_followed_here(self):
        numbered = [name for name in os.listdir(TUTORIALS) if name[0].isdigit()]
        for name in numbered:
            self.assertTrue(hasattr(self, "test_" + name[:-3]), name)
            self.assertIn("(%s)" % name, self.text("docs/tutorials/README.md"))


if __name__ == "__main__":
    unittest.main()
