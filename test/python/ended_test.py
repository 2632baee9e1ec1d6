"""Exit codes of commands whose work another program does, and what cannot be started or found."""
import contextlib
import io
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import preparing, telling  # noqa: E402
from monarch_flight.runs import ending, programs, summary, watched  # noqa: E402


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
        stop = watched.Stop()
        self.addCleanup(stop.end)
        code, words = self.said(lambda: watched.run(["nowhere-mpirun"], {}, stop))
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

    def test_a_summary_of_something_else(self):
        with tempfile.TemporaryDirectory() as folder:
            for text in ("{}", "[]", '{"status": 1, "sub_iterations": 2, "wall_s": 3}'):
                pathlib.Path(folder, "summary.json").write_text(text, encoding="utf-8")
                code, words = self.said(lambda: summary.show(folder))
                self.assertEqual(code, 1)
                self.assertIn("summary.json is not that of a run", words)

    def test_ctrl_c_while_a_command_begins(self):
        script = (ROOT / "scripts/monarch").read_text(encoding="utf-8").splitlines()
        heard = next(i for i, line in enumerate(script, 1) if "signal.signal(" in line)
        for words in (("keys",), ("sweep", "--help"), ("figures", "fig99")):
            for delay in (0.05, 0.08, 0.12, 0.2, 0.3):
                process = subprocess.Popen(["/usr/bin/python3", ROOT / "scripts/monarch", *words], text=True,
                                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                           preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
                time.sleep(delay)
                process.send_signal(signal.SIGINT)
                output = process.communicate(timeout=30)[0]
                if "Traceback" in output:  # python itself was beginning, up to the script's line that speaks of signals
                    line = re.search(r'monarch", line (\d+)', output)
                    self.assertTrue(line is None or int(line[1]) <= heard, output)


if __name__ == "__main__":
    unittest.main()
