#!/usr/bin/python3
"""Checks a Debian package (scripts/package): package_check.py PACKAGE FOLDER... It is unpacked, no file names one of the
folders in which it was made, and its programs fly, with the library of the flow for every processor."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "flights"))
import installed_tree  # noqa: E402

PACKAGE, *FOLDERS = sys.argv[1:]


class Package(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="package_check_")
        cls.addClassCleanup(folder.cleanup)
        subprocess.run(["dpkg-deb", "-x", PACKAGE, folder.name], check=True)
        cls.prefix = os.path.join(folder.name, "usr")

    def test_no_file_names_the_folders_of_its_making(self):
        self.assertEqual(installed_tree.naming(self.prefix, FOLDERS), [])

    def test_every_level_flies(self):
        installed_tree.check_levels(self, self.prefix)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
