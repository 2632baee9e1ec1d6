"""Names and places: topics of a bag, workspaces that are sourced, what a second shell needs, processes of a trial."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import types
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight.figures import screenshot  # noqa: E402
from monarch_flight.runs import environment, flight  # noqa: E402
from monarch_flight.trials import processes  # noqa: E402


def topics(space):
    return [{"topic": "/tf", "type": "tf2_msgs/TFMessage"}, {"topic": "/clock", "type": "rosgraph_msgs/Clock"},
            {"topic": space + "/state", "type": "monarch_flight/FlightState"},
            {"topic": space + "/right_wing/pressure", "type": "sensor_msgs/PointCloud2"}]


class Places(unittest.TestCase):
    def test_topics_of_a_bag_get_the_usual_names(self):
        self.assertEqual(screenshot.usual_names(topics("/monarch_flight")), [])
        for space in ("/lab/a/monarch_flight", "/bf1", ""):
            self.assertEqual(screenshot.usual_names(topics(space)),
                             [f"{space}/state:=/monarch_flight/state",
                              f"{space}/right_wing/pressure:=/monarch_flight/right_wing/pressure"])

    def test_a_workspace_is_known_by_its_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(folder + "/a")
            os.symlink("a", folder + "/link")
            for sourced, known in ((f"{folder}/ab", False), (f"{folder}/a/", True), (f"/opt/x:{folder}/link", True), ("", False)):
                with mock.patch.dict(os.environ, CMAKE_PREFIX_PATH=sourced, ROS_PACKAGE_PATH=""):
                    self.assertEqual(environment.has_sourced(folder + "/a"), known, sourced)

    def test_a_second_shell_has_the_namespace(self):
        nodes = types.SimpleNamespace(environment={"ROS_MASTER_URI": "http://localhost:1", "ROS_NAMESPACE": "lab a"})
        self.assertIn("export ROS_MASTER_URI=http://localhost:1 ROS_NAMESPACE='lab a' PATH=", flight.Nodes.second_shell(nodes))

    def test_nodes_of_a_trial_are_found_in_any_namespace(self):
        with tempfile.TemporaryDirectory() as folder:
            wait = "python3 -c 'import time; time.sleep(30)' __name:=wing"  # as mpirun and a process below it
            process = subprocess.Popen(["bash", "-c", f"{wait} & exec {wait}"],
                                       env=dict(os.environ, **processes.marked(folder)), start_new_session=True)
            try:
                time.sleep(0.5)
                self.assertEqual(processes.nodes(folder), {"wing": process.pid})
                self.assertEqual(processes.nodes(folder + "x"), {})
            finally:
                os.killpg(process.pid, 9)
                process.wait()


if __name__ == "__main__":
    unittest.main()
