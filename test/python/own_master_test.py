#!/usr/bin/python3
"""On which master monarch fly flies, and what it says of who sees the flight."""
import contextlib
import io
import pathlib
import sys
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight.runs import flight  # noqa: E402

URI = "http://butterfly:11311"


class OwnMaster(unittest.TestCase):
    def nodes(self, answers=False, **base):
        """(Nodes, what was said) in an environment, with a master that answers or not."""
        said = io.StringIO()
        with mock.patch.object(flight.master, "answers", lambda _: answers), contextlib.redirect_stdout(said), \
                mock.patch.object(flight.master, "busy", lambda _: None):
            return flight.Nodes(None, base), said.getvalue()

    def test_own_master(self):
        nodes, said = self.nodes()
        self.assertEqual(nodes.environment["ROS_HOSTNAME"], "localhost")
        self.assertEqual(said.count("\n"), 1)
        self.assertIn("seen from this machine only", said)
        self.assertIn("docs/usage.md", said)
        self.assertNotIn("ROS_HOSTNAME", said)

    def test_address_that_is_not_used(self):
        for name, value in (("ROS_HOSTNAME", "butterfly"), ("ROS_IP", "10.0.0.1")):
            nodes, said = self.nodes(**{name: value})
            self.assertIn(f"{name}={value} is for a master that runs already", said)
            self.assertEqual(nodes.environment["ROS_HOSTNAME"], "localhost")
            self.assertNotIn("ROS_IP", nodes.environment)
        self.assertNotIn("ROS_HOSTNAME=", self.nodes(ROS_HOSTNAME="localhost")[1])

    def test_dead_master(self):
        nodes, said = self.nodes(ROS_MASTER_URI=URI, ROS_HOSTNAME="butterfly")
        self.assertIn(f"{URI} does not answer: the flight has a master of its own", said)
        self.assertEqual(said.count("\n"), 1)
        self.assertTrue(nodes.port)

    def test_machine_without_the_name_localhost(self):
        self.assertIsNone(flight.nameless())
        with mock.patch.object(flight.socket, "getaddrinfo", side_effect=flight.socket.gaierror):
            self.assertIn("to /etc/hosts", flight.nameless())

    def test_master_that_runs(self):
        nodes, said = self.nodes(answers=True, ROS_MASTER_URI=URI, ROS_HOSTNAME="butterfly")
        self.assertEqual((nodes.port, said), (0, ""))
        self.assertEqual(nodes.environment, {"ROS_MASTER_URI": URI, "ROS_HOSTNAME": "butterfly"})


if __name__ == "__main__":
    unittest.main()
