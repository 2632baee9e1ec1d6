"""Exit codes of commands whose work another program does, and what cannot be started or found."""
import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import preparing, telling  # noqa: E402
from monarch_flight.runs import ending, programs, watched  # noqa: E402


class Ended(unittest.TestCase):
    def said(self, act):
        """(what it returns or exits with, what it says)"""
        words = io.StringIO()
        with contextlib.redirect_stderr(words):
            try:
                code = act()
            except SystemExit as end:
                code = end.code
        return code, words.getvalue()

    def test_a_signal_is_named_and_a_failure(self):
        for code, name in ((-9, "SIGKILL"), (137, "SIGKILL"), (139, "SIGSEGV"), (-11, "SIGSEGV")):
            self.assertEqual(self.said(lambda code=code: telling.passed_on(code, "the program x", "fly")),
                             (1, f"fly: the program x died ({name})\n"))
            self.assertEqual(ending.how(code), f"died ({name})")
        for code in (0, 1, 2, 130):
            self.assertEqual(self.said(lambda code=code: telling.passed_on(code, "x", "fly")), (code, ""))

    def test_programs_that_a_signal_ends(self):
        kill = ["-c", "kill -SEGV $$"]
        for act in (lambda: programs.called("/bin/sh", kill), lambda: preparing.must(["/bin/sh", *kill])):
            code, words = self.said(act)
            self.assertEqual(code, 1)
            self.assertIn("died (SIGSEGV)", words)

    def test_programs_that_are_not_there(self):
        code, words = self.said(lambda: watched.run(["nowhere-mpirun"], {}, watched.Stop()))
        self.assertEqual(code, (1, []))
        self.assertIn("nowhere-mpirun cannot be started: No such file or directory", words)
        for act in (lambda: programs.called("/nowhere/trim", []), lambda: preparing.must(["/nowhere/install"])):
            self.assertRegex(self.said(act)[0], "^monarch: /nowhere/[a-z]+ cannot be started: No such file")

    def test_commands_say_what_a_system_refuses(self):
        long, folder = "a" * 300, tempfile.gettempdir()
        for words in (("screenshot", long), ("figures", "fig2", f"runs:={long}"), ("settle", long),
                      ("fly", f"case:={long}"), ("plan", f"out:={long}"), ("fly", f"resume:={long}"), ("summary", long),
                      ("compare-coupling", f"out:={folder}/{long}/x", "case:=nowhere"), ("sweep", f"case:={long}"),
                      ("reduce-vicon", long), ("render-field", long)):
            done = subprocess.run(["/usr/bin/python3", ROOT / "scripts/monarch", *words], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, timeout=30, check=False)
            self.assertIn(done.returncode, (1, 2), done.stdout)
            self.assertNotIn("Traceback", done.stdout)


if __name__ == "__main__":
    unittest.main()
