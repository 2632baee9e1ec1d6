#!/usr/bin/python3
"""The pages of the C++ interface are made without a warning; left out where doxygen is missing."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

from monarch_flight.command import api  # noqa: E402


@unittest.skipUnless(shutil.which("doxygen"), "needs doxygen")
class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="api_test_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def api(self, out):
        return subprocess.run([ROOT / "scripts/monarch", "api", f"out:={out}"], env={"PATH": "/usr/bin:/bin", "MONARCH_AS_BUILT": "1"},
                              capture_output=True, text=True, check=False)

    def test_every_header_without_a_warning(self):
        done = self.api(self.folder / "pages")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        html = self.folder / "pages/html"
        start = (html / "index.html").read_text(encoding="utf-8")
        for room in sorted(path.name for path in (ROOT / "include/monarch_flight").iterdir()):
            page = f"group__room__{room.replace('_', '__')}.html"
            self.assertIn(page, start)
            text = (html / page).read_text(encoding="utf-8")
            for header in (ROOT / "include/monarch_flight" / room).glob("*.h"):
                self.assertIn(header.name, text)

    def test_a_wrong_comment_fails(self):
        (self.folder / "wrong.h").write_text("/// See \\ref nobody.\nint one();\n", encoding="utf-8")
        settings = (ROOT / "docs/api/Doxyfile").read_text(encoding="utf-8")
        done = subprocess.run(["doxygen", "-"], cwd=self.folder, text=True, capture_output=True, check=False,
                              input=settings + "INPUT = wrong.h\n")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("nobody", done.stderr)

    def test_another_folder_is_left_alone(self):
        (self.folder / "mine.txt").touch()
        done = self.api(self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("holds something else", done.stderr)

    def test_rooms(self):
        self.assertIn("/** @file monarch_flight/math/rotation.h\n@ingroup room_math */\n", api.rooms(ROOT / "include"))


if __name__ == "__main__":
    unittest.main()
