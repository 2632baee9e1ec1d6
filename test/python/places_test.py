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
from monarch_flight.runs import environment, flight  # noqa: E402
from monarch_flight.runs.recorded_names import Names, prefix_of  # noqa: E402
from monarch_flight.trials import processes  # noqa: E402


def names(space):
    topics = ["/tf", "/clock", space + "/state", space + "/right_wing/pressure", space.rpartition("/")[0] + "/joint_states"]
    return Names(space, "", topics)


def transforms(*frames):
    return types.SimpleNamespace(transforms=[types.SimpleNamespace(child_frame_id=frame) for frame in frames])


class Places(unittest.TestCase):
    def test_topics_of_a_bag_get_the_names_of_another_run(self):
        self.assertEqual(names("/monarch_flight").remaps("/monarch_flight"), [])
        for own, outer in (("/lab/a/monarch_flight", "/lab/a"), ("/bf1", ""), ("", "")):
            self.assertEqual(names(own).remaps("/b/monarch_flight"),
                             [f"{own}/state:=/b/monarch_flight/state",
                              f"{own}/right_wing/pressure:=/b/monarch_flight/right_wing/pressure",
                              f"{outer}/joint_states:=/b/joint_states"] if own else mock.ANY)
        self.assertIn("/lab/joint_states:=/joint_states", names("/lab/monarch_flight").remaps("/monarch_flight"))

    def test_prefix_of_the_frames_of_a_bag(self):
        self.assertEqual(prefix_of([transforms("a/b/base_link", "a/b/abdomen")]), "a/b/")
        self.assertEqual(prefix_of([transforms("world_ned"), transforms("base_link")]), "")
        self.assertEqual(prefix_of([transforms("x/right_wing")]), "x/")
        self.assertEqual(prefix_of([transforms("world_ned")] * 200), "")

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
