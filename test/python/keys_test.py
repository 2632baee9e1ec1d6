"""The table of keys: what each accepts, what is made from it, and what a command says of wrong words."""
import contextlib
import io
import pathlib
import re
import sys
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import key_texts, keys  # noqa: E402
from monarch_flight.command import main  # noqa: E402

TABLE = keys.run_keys()
WRONG = dict(choice=("", "water"), truth=("yes", "True", "1"), count=("-1", "0.5", "two", "1e1", "+1"),
             number=("0", "-1", "nan", "inf", "1e", "e1", "1_0", "0e5", "1e999"), program=("a b", "../x", ""), package=("a/b", "", "1a"), machine=("a b", ""),
             path=("",), case=("",), command=("",))
RIGHT = dict(truth=("true", "false"), number=("1", ".1", "1e-1", "0.01e+1", "100E-3", "2."), count=("1", "10"),
             program=("drag_fluid.py",), package=("my_package",), machine=("node-1.lab",), path=("it's a folder", "/x"), case=("climb",), command=("mpirun -np 2",))


class Table(unittest.TestCase):
    def test_every_key_accepts_its_range_and_no_more(self):
        for key in TABLE.values():
            for value in RIGHT.get(key.type, key.choices):
                self.assertTrue(key.accepts(value), (key.name, value))
            for value in WRONG[key.type]:
                self.assertFalse(key.accepts(value), (key.name, value))

    def test_plugins(self):
        for name, good in (("a/B", True), ("a/b/C_1", True), ("a/", False), ("/b", False), ("a/1", False), ("a b/c", False)):
            self.assertEqual([TABLE[key].accepts(name) for key in ("fluid", "guidance", "grid")], [good, good, False], name)

    def test_bounds_of_counts(self):
        self.assertEqual([TABLE["ranks"].accepts(n) for n in ("0", "1", "10000", "10001")], [False, True, True, False])
        self.assertEqual([TABLE["fields_every"].accepts(n) for n in ("0", "7")], [True, True])
        self.assertFalse(TABLE["steps_per_flap"].accepts("0"))

    def test_every_key_is_whole(self):
        for key in TABLE.values():
            self.assertTrue(key.doc and key.of and set(key.of) <= {"fly", "program", "launch", "server"}, key)
            self.assertEqual(bool(key.choices), key.type == "choice", key)
            self.assertIn(key.type, WRONG)

    def test_all_faults_at_once(self):
        words = ("flapps:=2", "grid", "fluid:=water", "flaps:=1", "flaps:=2", "out:=", "nonsense:=1")
        _, _, faults = TABLE.of("fly").read(words)
        text = "\n".join(faults)
        for fault in ("unknown key 'flapps'; did you mean 'flaps'?", "'grid' is not of the form",
                      "fluid:=water: must be navier_stokes or quasi_steady", "'flaps' is given twice",
                      "'out' has no value", "unknown key 'nonsense'; known are case,"):
            self.assertIn(fault, text)
        self.assertEqual(len(faults), 6)

    def test_values_that_are_nearly_right(self):
        words = ("fluid:=quasisteady", "grid:=Fine", "rviz:=True", "case:=climb", "flaps:=one")
        _, _, faults = TABLE.of("fly").read(words)
        self.assertEqual([fault.partition("; ")[2] for fault in faults],
                         ["did you mean 'quasi_steady'?", "did you mean 'fine'?", "did you mean 'true'?", ""])

    def test_words_of_other_programs_and_of_launch_files(self):
        _, _, faults = TABLE.of("fly").read(("flaps=2", "--grid=fine", "watchdog:=3"))
        self.assertIn("did you mean flaps:=2?", faults[0])
        self.assertIn("did you mean grid:=fine?", faults[1])
        self.assertIn("roslaunch monarch_flight flight.launch watchdog:=", faults[2])


class Made(unittest.TestCase):
    def test_blocks_are_up_to_date(self):
        for name in key_texts.files():
            text = (ROOT / name).read_text(encoding="utf-8")
            wanted = key_texts.renewed(text, name, TABLE)
            self.assertEqual(wanted, text, f"{name} is stale; monarch keys write:=true renews it")

    def test_launch_file_takes_every_key_once(self):
        launch = xml.etree.ElementTree.parse(ROOT / "launch/flight.launch").getroot()
        names = [node.get("name") for node in launch.iter("arg")]
        self.assertEqual(len(names), len(set(names)))
        self.assertLessEqual(set(TABLE.of("launch")), set(names))
        for node in launch.iter("arg"):
            wanted = re.findall(r"arg\('(\w+)'\)|\$\(arg (\w+)\)", node.get("default") or node.get("value") or "")
            for name in filter(None, sum(wanted, ())):
                self.assertLess(names.index(name), names.index(node.get("name")))

    def test_launch_files_say_what_is_optional_and_what_it_means(self):
        for path in (ROOT / "launch").glob("*.launch"):
            for node in xml.etree.ElementTree.parse(path).getroot().iter("arg"):
                if "default" in node.attrib:  # roslaunch --ros-args calls an empty one required
                    self.assertTrue(node.get("default"), (path.name, node.get("name")))

    def test_missing_marks_are_told(self):
        with self.assertRaisesRegex(ValueError, "marks of the block 'keys'"):
            key_texts.renewed("no marks", "docs/parameters.md", TABLE)


class Command(unittest.TestCase):
    def monarch(self, *words):
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            try:
                code = main.main(list(words))
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), errors.getvalue()

    def test_every_command_has_help(self):
        for name in main.COMMANDS:
            if name in main.SCRIPTS:
                self.assertTrue((ROOT / "scripts" / main.SCRIPTS[name]).is_file())
                continue
            code, out, errors = self.monarch(name, "--help")
            self.assertEqual((code, errors), (0, ""), name)
            self.assertIn("monarch " + name, out)
        code, out, _ = self.monarch("--help")
        self.assertEqual((code, all(name in out for name in main.COMMANDS)), (0, True))

    def test_help_of_fly_names_every_key_and_choice(self):
        _, out, _ = self.monarch("fly", "--help")
        for key in TABLE.of("fly").values():
            self.assertRegex(out, rf"(?m)^  {key.name} ")
            for choice in key.choices:
                self.assertIn(choice, out)

    def test_misspelt_command(self):
        code, _, errors = self.monarch("flt")
        self.assertEqual(code, 2)
        self.assertIn("no command 'flt'; did you mean 'fly'?", errors)

    def test_keys_of_other_commands(self):
        for words, fault in (("settle a flap:=1", "did you mean 'flaps'?"), ("sweep jobs:=0", "jobs:=0: must be"),
                             ("figures fig3", "unknown figure 'fig3'"), ("verify image:=x", "did you mean 'images'?"),
                             ("verify disk_drag", "did you mean 'disc_drag'?"), ("identify passive_pich", "did you mean 'passive_pitch'?"),
                             ("compare-coupling strategies:=plian", "did you mean 'plain'?"),
                             ("render-field /nowhere view:=below", "must be side, above, front, oblique or ahead"),
                             ("bench step", "did you mean 'steps'?"), ("check lint:=include", "true or a folder"),
                             ("hostile --messages 0", "must be a whole number from 1"),
                             ("keys write:=yes", "write:=yes: must be true or false")):
            code, _, errors = self.monarch(*words.split())
            self.assertEqual(code, 2, (words, errors))
            self.assertIn(fault, errors)


if __name__ == "__main__":
    unittest.main()
