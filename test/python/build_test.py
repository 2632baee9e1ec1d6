#!/usr/bin/python3
"""scripts/build does nothing where nothing has changed, and notices whatever has: on a small tree that stands for this one."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CMAKE = """
cmake_minimum_required(VERSION 3.16)
project(small NONE)
file(APPEND ${CMAKE_BINARY_DIR}/configured x)
file(GLOB sources CONFIGURE_DEPENDS src/*.cpp)
add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/devel/lib/program DEPENDS ${sources}
  COMMAND cat ${sources} > ${CMAKE_BINARY_DIR}/devel/lib/program)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib)
add_custom_target(monarch_fly ALL DEPENDS ${CMAKE_BINARY_DIR}/devel/lib/program)
add_custom_target(monarch_programs)
"""
NOTHING = "build: nothing has changed\n"


@unittest.skipUnless(os.path.exists("/var/lib/dpkg/status"), "the short way is for Debian")
class Build(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "a tree"
        for folder in ("scripts", "src", "python"):
            (self.root / folder).mkdir(parents=True)
        shutil.copy(ROOT / "scripts/build", self.root / "scripts/build")
        (self.root / "CMakeLists.txt").write_text(CMAKE)
        (self.root / "src/a.cpp").write_text("1\n")

    def build(self, *arguments, code=0, **environment):
        base = {name: value for name, value in os.environ.items()
                if not name.startswith("MONARCH_") and name not in ("CMAKE_PREFIX_PATH", "MAKEFLAGS", "MFLAGS", "CMAKE_GENERATOR")}
        done = subprocess.run([self.root / "scripts/build", *arguments], env=dict(base, **environment), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def program(self):
        return (self.root / "build/devel/lib/program").read_text()

    def configured(self):
        return len((self.root / "build/configured").read_text())

    def built(self):
        self.assertIn("build: done", self.build())
        self.assertEqual(self.build(), NOTHING)

    def test_nothing_has_changed(self):
        self.built()
        self.assertIn("build: done", self.build("--programs"))
        self.assertEqual(self.build("--programs"), NOTHING)
        self.assertEqual(self.build(), NOTHING)
        self.assertEqual(self.configured(), 1)

    def test_a_source_has_changed(self):
        self.built()
        source = self.root / "src/a.cpp"
        times = source.stat()
        source.write_text("2\n")
        self.assertIn("build: done", self.build())
        self.assertEqual((self.program(), self.configured()), ("2\n", 1))
        source.write_text("3\n")
        os.utime(source, ns=(times.st_atime_ns, times.st_mtime_ns))  # by a tool that keeps times; make is not told
        self.assertIn("build: done", self.build())

    def test_a_source_has_come_and_gone(self):
        self.built()
        (self.root / "src/b.cpp").write_text("b\n")
        self.assertIn("build: done", self.build())
        self.assertEqual(self.program(), "1\nb\n")
        (self.root / "src/b.cpp").unlink()
        self.assertIn("build: done", self.build())
        self.assertEqual(self.program(), "1\n")

    def test_a_product_is_missing(self):
        self.built()
        (self.root / "build/devel/lib/program").unlink()
        self.assertIn("build: done", self.build())
        self.assertEqual(self.program(), "1\n")

    def test_options_and_files_of_cmake(self):
        self.built()
        self.assertIn("build: done", self.build("-DSMALL=1"))
        self.assertEqual(self.configured(), 2)
        self.assertIn("SMALL:UNINITIALIZED=1", (self.root / "build/CMakeCache.txt").read_text())
        with open(self.root / "CMakeLists.txt", "a", encoding="utf-8") as file:
            file.write("file(APPEND ${CMAKE_BINARY_DIR}/configured yy)\n")
        self.build("-DSMALL=1")
        self.assertEqual(self.configured(), 5)

    def test_a_failed_build_is_tried_again(self):
        self.built()
        with open(self.root / "CMakeLists.txt", "a", encoding="utf-8") as file:
            file.write("message(FATAL_ERROR nothing)\n")
        for _ in range(2):
            self.assertIn("build: failed", self.build(code=1))

    def test_a_tree_that_was_copied(self):
        """Its build is that of another place, which cmake refuses; nothing is built there."""
        self.built()
        copy = self.root.parent / "copy"
        shutil.copytree(self.root, copy)
        (self.root / "src/a.cpp").write_text("2\n")
        self.root = copy
        self.assertIn("CMakeCache.txt", self.build(code=1))
        self.assertEqual((copy.parent / "a tree/build/devel/lib/program").read_text(), "1\n")

    def test_other_workspaces_are_always_looked_at(self):
        self.built()
        for _ in range(2):
            self.assertIn("build: done", self.build(CMAKE_PREFIX_PATH="/home/me/ws/devel"))

    def test_the_shell_has_sourced_the_build(self):
        self.built()
        self.assertEqual(self.build(CMAKE_PREFIX_PATH=f"{self.root}/build/devel:/usr"), NOTHING)
        self.assertIn("build: done", self.build(CMAKE_PREFIX_PATH="/opt/ros/noetic"))

    def test_everything_is_always_looked_at(self):
        for _ in range(2):
            self.assertIn("build: done", self.build("--all"))


if __name__ == "__main__":
    unittest.main()
