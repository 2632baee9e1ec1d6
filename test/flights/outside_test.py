#!/usr/bin/python3
"""A package outside the tree (test/outside): its air, its guidance and its reader of flights, compiled for any
processor against the devel space of this package and against its install space, and flown."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

import flying
import installed_tree

OUTSIDE = os.path.join(flying.ROOT, "test", "outside")
INSTALL = os.environ.get("MONARCH_INSTALL", "")
FLAPS = 0.2
KEYS = ("steps_per_flap:=100",)


class Outside:
    """With `prefix`, the space that the package is built against, and `monarch`, the command there."""
    environment = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="outside_test_")
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.prepare()
        cls.compile()

    @classmethod
    def prepare(cls):
        pass

    @classmethod
    def compile(cls):
        source, build = os.path.join(cls.folder, "src"), os.path.join(cls.folder, "build")
        shutil.copytree(OUTSIDE, source)
        space = os.path.join(cls.folder, "install")
        must("cmake", "-S", source, "-B", build, "-DCMAKE_PREFIX_PATH=" + cls.prefix, "-DCMAKE_CXX_FLAGS=-O0 -Wall -Werror",
             "-DPYTHON_EXECUTABLE=/usr/bin/python3", "-DPython3_EXECUTABLE=/usr/bin/python3",
             "-DCMAKE_INSTALL_PREFIX=" + space, env=plain())
        must("cmake", "--build", build, "-j2", env=plain())
        if cls.installs:
            must("cmake", "--install", build, env=plain())
        cls.space = space if cls.installs else os.path.join(build, "devel")

    @classmethod
    def sourced(cls):
        """The environment of a shell in which a person works with that package."""
        if cls.environment is None:
            cls.environment = cls.after_setup()
        return cls.environment

    @classmethod
    def after_setup(cls):
        told = subprocess.run(["bash", "-c", 'source "$1/setup.bash" && env -0', "bash", cls.space], check=True,
                              stdout=subprocess.PIPE, env=plain()).stdout
        return dict(item.split("=", 1) for item in os.fsdecode(told).split("\0") if "=" in item)

    def out(self, name):
        return os.path.join(self.folder, "flights", name)

    def case(self, name, fluid=None, guidance=None):
        """climb_trimmed, by plugins where parameters are given."""
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_trimmed.yaml")) as f:
            case = yaml.safe_load(f)
        case["fluid"]["solver"] = "quasi_steady"
        if fluid is not None:
            case["fluid"].update(solver="monarch_outside/ThinAir", parameters=fluid)
        if guidance is not None:
            case["guidance"] = dict(type="monarch_outside/Wider", parameters=guidance)
        path = os.path.join(self.folder, name + ".yaml")
        with open(path, "w") as f:
            yaml.safe_dump(case, f)
        return "case:=" + path

    def fly(self, *words, code=0):
        """What is said; None: any exit code but 0."""
        done = subprocess.run([*self.monarch, "fly", *words], env=self.sourced(), text=True, timeout=120, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertTrue(done.returncode if code is None else done.returncode == code, done.stdout)
        return done.stdout

    def flown(self, name, *words):
        """Its summary."""
        self.fly("out:=" + self.out(name), *KEYS, *words)
        return flying.summary(self.out(name))

    def test_models_of_its_own(self):
        same = self.case("same", {"density_factor": 1.0}, {"deviation": 0.0})
        length, here = "flaps:=%g" % FLAPS, "in_process:=true"
        plain_air = self.flown("plain", self.case("plain"), length, here)
        nodes = self.flown("nodes", same, length)
        alone = self.flown("alone", same, length, here)
        self.assertEqual((plain_air["fluid"], nodes["fluid"]), ("quasi_steady", "monarch_outside/ThinAir"))
        self.assertEqual(nodes["guidance"]["type"], "monarch_outside/Wider")
        self.assertEqual(plain_air["state_sha256"], nodes["state_sha256"])
        self.assertEqual(plain_air["state_sha256"], alone["state_sha256"])

        other = self.case("other", {"density_factor": 0.8, "note": ["anything", {"of": "ours"}]}, {"deviation": 0.05})
        whole = self.flown("whole", other, length, here)
        self.assertNotEqual(whole["state_sha256"], plain_air["state_sha256"])
        self.flown("parts", other, "flaps:=%g" % (FLAPS / 2), here)
        self.fly("resume:=" + self.out("parts"), length, here)
        self.assertEqual(flying.summary(self.out("parts"))["state_sha256"], whole["state_sha256"])
        self.fly("replay:=" + self.out("whole"), "out:=" + self.out("again"), here)
        self.assertEqual(flying.summary(self.out("again"))["state_sha256"], whole["state_sha256"])
        self.read(self.out("nodes"))

    def read(self, folder):
        """By a program of that package."""
        program = os.path.join(self.space, "lib", "monarch_outside", "print_flight")
        done = subprocess.run([program, os.path.join(folder, "flight.bag")], env=self.sourced(), text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"^climb_trimmed in monarch_outside/ThinAir air: step %d, height .* force 0\.00" %
                         round(100 * FLAPS))

    def test_guidance_node_in_python(self):
        led = self.flown("led", self.case("plain"), "flaps:=%g" % FLAPS, "guidance_pkg:=monarch_outside",
                         "guidance_node:=steady_guidance.py")
        self.assertEqual(led["guidance"]["type"], "node")
        columns, rows = flying.table(self.out("led"), "flight.csv")
        self.assertNotEqual(rows[-1][columns.index("command_deviation_mean")], 0.0)

    def test_what_cannot_be_flown(self):
        wrong = self.case("wrong", {"density_factor": -1})
        text = self.fly(wrong, "out:=" + self.out("wrong"), "in_process:=true", code=2)
        self.assertIn("fluid/solver = monarch_outside/ThinAir: the plugin makes nothing of this case: "
                      "density_factor: must be > 0; correct fluid/parameters", text)
        self.assertFalse(os.path.exists(self.out("wrong")))
        text = self.fly(self.case("plain"), "fluid:=nobody/Air", "guidance:=nobody/Guide", "in_process:=true",
                        "out:=" + self.out("nobody"), code=2)
        self.assertIn("fluid/solver = nobody/Air: there is no such plugin: known are monarch_outside/ThinAir", text)
        self.assertIn("guidance/type = nobody/Guide: there is no such plugin: known are monarch_outside/Wider", text)
        self.assertFalse(os.path.exists(self.out("nobody")))


class Devel(Outside, unittest.TestCase):
    prefix = os.path.join(flying.BUILD, "devel")
    monarch = [sys.executable, os.path.join(flying.ROOT, "scripts", "monarch")]
    installs = False

    def test_wrong_models_by_nodes(self):
        """The node that cannot make its model says so, and the run ends."""
        wrong = self.case("wrong", {"density_factor": -1})
        text = self.fly(wrong, "out:=" + self.out("wrong_nodes"), code=None)
        self.assertIn("density_factor: must be > 0", text)
        self.assertFalse(os.path.exists(self.out("wrong_nodes")))
        text = self.fly(self.case("plain"), "fluid_pkg:=nobody", "wing_pkg:=monarch_outside", "out:=" + self.out("no"), code=2)
        self.assertIn("fluid_pkg:=nobody: there is no such package", text)
        self.assertIn("wing_node:=wing: no program of this name in package monarch_outside", text)


@unittest.skipUnless(INSTALL.startswith(flying.BUILD), "this build installs elsewhere: %s" % INSTALL)
class Install(Outside, unittest.TestCase):
    prefix = INSTALL
    monarch = [os.path.join(INSTALL, "bin", "monarch")]
    installs = True

    @classmethod
    def prepare(cls):
        shutil.rmtree(INSTALL, ignore_errors=True)
        cls.addClassCleanup(shutil.rmtree, INSTALL, ignore_errors=True)
        must("cmake", "--install", flying.BUILD, env=plain())

    def test_the_source_tree_is_not_needed(self):
        for name, value in self.sourced().items():
            self.assertNotIn(flying.ROOT + "/python", value, name)

    def test_no_file_names_the_source_tree(self):
        self.assertEqual(installed_tree.naming(INSTALL, [flying.ROOT, flying.BUILD]), [])

    @unittest.skipUnless(os.path.isdir(os.path.join(flying.BUILD, "devel/lib/glibc-hwcaps")), "built for this machine alone")
    def test_every_level_flies(self):
        installed_tree.check_levels(self, INSTALL)


def plain():
    """Of a person who has sourced nothing."""
    keep = ("HOME", "PATH", "USER", "TMPDIR", "CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_C_COMPILER_LAUNCHER")
    return dict({name: os.environ[name] for name in keep if name in os.environ}, PATH="/usr/bin:/bin",
                MONARCH_AS_BUILT="1", MONARCH_BUILD=flying.BUILD)


def must(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    if done.returncode:
        raise RuntimeError("%s\n%s" % (" ".join(command), done.stdout))


if __name__ == "__main__":
    unittest.main()
