"""What monarch fly makes of its keys, and which of them it refuses together."""
import io
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import keys  # noqa: E402
from monarch_flight.runs.request import request  # noqa: E402

DARK, BRIGHT = {}, {"DISPLAY": ":0"}


class Requests(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="it's a folder ")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_folder(self, case="name: x\n"):
        folder = self.folder / "run"
        folder.mkdir()
        (folder / "case.yaml").write_text(case, encoding="utf-8")
        (folder / "flight.csv").write_text("t\n", encoding="utf-8")
        return folder

    def faults(self, *words, environment=None):
        with self.assertRaises(keys.Refused) as refused:
            request(words, environment or DARK)
        return "\n".join(refused.exception.faults)

    def test_nothing_given(self):
        wanted = request([], DARK)
        found = (wanted.values["case"], wanted.values["rviz"], wanted.leader)
        self.assertEqual(found, ("climb_controlled", "false", "controller"))
        self.assertRegex(str(wanted.folder), r"/flights/climb_controlled-\d{8}-\d{6}$")
        self.assertEqual(request([], BRIGHT).values["rviz"], "true")

    def test_a_folder_that_nobody_has_named_has_the_time_at_which_the_run_begins(self):
        run = self.run_folder()
        for words, expected in (([], "/flights/climb_controlled-20300102-030405"),
                                ([f"replay:={run}"], "/flights/run-20300102-030405"),
                                ([f"out:={self.folder}/new"], f"{self.folder}/new"), ([f"resume:={run}"], str(run))):
            wanted = request(words, DARK)
            with mock.patch("time.strftime", lambda _: "20300102-030405"):
                wanted.begin()
            self.assertTrue(str(wanted.folder).endswith(expected), wanted.folder)
            self.assertEqual(wanted.values.get("out", str(run)), str(wanted.folder))

    def test_rviz_outlives_the_flight_of_whoever_asks_for_it(self):
        self.assertTrue(request(["rviz:=true"], BRIGHT).stays)
        for words, environment in (([], DARK), (["rviz:=false"], BRIGHT), (["in_process:=true"], BRIGHT)):
            self.assertFalse(request(words, environment).stays, words)
        with mock.patch("sys.stdout", io.StringIO()):  # no terminal: a script is not held up
            self.assertFalse(request([], BRIGHT).stays)

    def test_pace_and_theme(self):
        wanted = request(["rviz:=true", "rate:=0.02", "theme:=light"], BRIGHT)
        self.assertLessEqual({"rate:=0.02", "theme:=light", "rviz:=true"}, set(wanted.words("launch")))
        self.assertIn("rate:=0: must be a number > 0", self.faults("rate:=0"))
        self.assertIn("theme:=blue: must be dark or light", self.faults("theme:=blue"))
        self.assertIn("rate:=1: needs the nodes", self.faults("rate:=1", "in_process:=true"))

    def test_words_for_the_launch_file_and_the_program(self):
        wanted = request(["flaps:=2", f"out:={self.folder / 'new'}", "ranks:=2", "in_process:=true"], BRIGHT)
        out = f"out:={self.folder}/new"
        self.assertEqual(wanted.words("program"), ["case:=climb_controlled", "flaps:=2", out, "ranks:=2"])
        self.assertIn("rviz:=false", wanted.words("launch"))

    def test_a_case_of_ones_own(self):
        case = self.folder / "mine.yaml"
        case.write_text("wings: independent\nguidance: {type: commands}\n", encoding="utf-8")
        wanted = request([f"case:={os.path.relpath(case)}"], DARK)
        found = (wanted.values["case"], wanted.values["wings"], wanted.leader)
        self.assertEqual(found, (str(case), "independent", "commands"))
        case.write_text("[broken", encoding="utf-8")
        self.assertEqual(request([f"case:={case}"], DARK).leader, "motion")  # whoever flies it says what is wrong

    def test_resumed(self):
        folder = self.run_folder()
        wanted = request([f"resume:={folder}"], DARK)
        found = (wanted.folder, wanted.values["case"], "out" in wanted.values)
        self.assertEqual(found, (folder, f"{folder}/case.yaml", False))
        self.assertIn("goes on in its own folder", self.faults(f"resume:={folder}", "out:=x"))
        self.assertEqual(self.faults(f"resume:={self.folder}"),
                         f"resume:={self.folder}: not the folder of a run (it has no case.yaml)")

    def test_replayed(self):
        folder = self.run_folder()
        wanted = request([f"replay:={folder}"], DARK)
        found = (wanted.values["guidance"], wanted.values["guidance_file"])
        self.assertEqual(found, ("replay", f"{folder}/flight.csv"))
        self.assertIn("/flights/run-", str(wanted.folder))
        text = self.faults(f"replay:={folder}", "case:=climb", "guidance:=motion")
        self.assertIn("give only one of them", text)
        self.assertIn("a replay is guidance:=replay", text)
        self.assertIn("name the folder of the recorded flight by replay:=", self.faults("guidance:=replay"))

    def test_what_needs_nodes(self):
        words = ("in_process:=true", "rviz:=true", "fluid_node:=a", "guidance_node:=b", "paused:=true")
        text = self.faults(*words, environment=BRIGHT)
        self.assertEqual(text.count("needs the nodes, so in_process:=false"), 4)
        self.assertIn("guidance:=commands: needs the nodes", self.faults("plan:=true", "guidance:=commands"))
        self.assertIn("there is no display", self.faults("rviz:=true"))

    def test_leaders(self):
        self.assertIn("name its program by guidance_node:=", self.faults("guidance:=node"))
        self.assertIn("needs guidance:=node, not motion", self.faults("guidance:=motion", "guidance_node:=a.py"))
        self.assertEqual(request(["guidance_node:=a.py"], DARK).leader, "node")
        self.assertEqual(request(["guidance:=a/B"], DARK).leader, "a/B")
        self.assertIn("name the program of this package by guidance_node:=", self.faults("guidance_pkg:=mine"))

    def test_a_folder_in_use_and_a_misspelt_case(self):
        (self.folder / "x").write_text("", encoding="utf-8")
        text = self.faults(f"out:={self.folder}", "case:=climb_controled", "flaps:=0")
        for words in ("holds something already", "did you mean 'climb_controlled'?", "flaps:=0: must be a number > 0"):
            self.assertIn(words, text)

    def test_names_that_are_too_long(self):
        long = "a" * 300
        self.assertIn("neither a shipped case", self.faults(f"case:={long}"))
        self.assertIn(f"out:={long}: File name too long; name another folder", self.faults(f"out:={long}"))
        self.assertIn("not the folder of a run", self.faults(f"resume:={long}"))
        self.assertIn("not the folder of a recorded flight", self.faults(f"replay:={long}"))

    def test_a_case_that_yaml_cannot_take(self):
        case = self.folder / "odd.yaml"
        for text in ("a: 2020-13-45\n", "[" * 5000, "? [a]\n: b\n"):
            case.write_text(text, encoding="utf-8")
            self.assertEqual(request([f"case:={case}"], DARK).leader, "motion")

    def test_paths_that_a_launch_file_cannot_carry(self):
        for odd in ('a"b.yaml', "a\\b.yaml"):
            case = self.folder / odd
            case.write_text("name: x\n", encoding="utf-8")
            self.assertIn("a run with nodes cannot use a path with", self.faults(f"case:={case}"))
            self.assertEqual(request([f"case:={case}", "in_process:=true"], DARK).values["case"], str(case))


if __name__ == "__main__":
    unittest.main()
