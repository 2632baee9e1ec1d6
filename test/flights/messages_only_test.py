#!/usr/bin/python3
"""MONARCH_MESSAGES_ONLY: without any library of the flight, the messages are built, and read from a bag."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import flying

LIBRARIES = ("Eigen3", "BLAS", "LAPACK", "MPI", "OpenSSL", "nlohmann_json", "HDF5", "PkgConfig", "VTK", "GTest")
READS = """
import sys
import rosbag
from monarch_flight.msg import FlightState
path = sys.argv[1]
with rosbag.Bag(path, "w") as bag:
    bag.write("state", FlightState(step=7))
with rosbag.Bag(path) as bag:
    print(sys.modules["monarch_flight"].__file__, [message.step for _, message, _ in bag.read_messages("state")])
"""


class MessagesOnly(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="messages_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def must(self, *command, **more):
        environment = {"PATH": "/usr/bin:/bin", "HOME": self.folder, **more}
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_messages_without_the_libraries_of_a_flight(self):
        build = os.path.join(self.folder, "build")
        self.must("cmake", "-S", flying.ROOT, "-B", build, "-DMONARCH_MESSAGES_ONLY=ON",
                  *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in LIBRARIES))
        self.must("cmake", "--build", build, "-j2", "--target", "monarch_flight_generate_messages_py")
        python = os.path.join(build, "devel/lib/python3/dist-packages")
        told = self.must(sys.executable, "-c", READS, os.path.join(self.folder, "a.bag"), PYTHONPATH=python)
        self.assertEqual(told.split(), [os.path.join(python, "monarch_flight/__init__.py"), "[7]"])


if __name__ == "__main__":
    unittest.main()
