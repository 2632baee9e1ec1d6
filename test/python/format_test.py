"""The sources are laid out as .clang-format says."""
import pathlib
import re
import shutil
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("bench", "include", "src", "test")


@unittest.skipUnless(shutil.which("clang-format"), "needs scripts/install check")
class Format(unittest.TestCase):
    def test_every_file_is_laid_out(self):
        files = sorted(str(path.relative_to(ROOT)) for folder in FOLDERS for path in (ROOT / folder).rglob("*.*")
                       if path.suffix in (".c", ".cpp", ".h"))
        self.assertGreater(len(files), 300)
        told = subprocess.run(["clang-format", "--dry-run", *files], cwd=ROOT, check=True, stderr=subprocess.PIPE,
                              text=True).stderr
        wrong = sorted(set(re.findall(r"^(\S+):\d+:\d+: warning:", told, re.MULTILINE)))
        self.assertEqual(wrong, [], f"not as .clang-format says; this mends it: clang-format -i {' '.join(wrong)}")


if __name__ == "__main__":
    unittest.main()
