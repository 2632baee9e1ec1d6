#!/usr/bin/python3
"""Launch files of other people that include ours: arguments, namespaces, strangers beside the nodes of a flight."""
import os
import subprocess
import unittest

import flying

ARGUMENTS = '<arg name="fluid" value="quasi_steady"/><arg name="flaps" value="0.1"/>'
FLIGHT = "$(find monarch_flight)/launch/flight.launch"


def include(file, out, more=""):
    return f'<include file="{file}">{ARGUMENTS}{more}<arg name="out" value="{out}"/></include>'


class Launch(flying.FlightTest):
    def launched(self, content, **environment):
        """What roslaunch says of a file, on a master of its own."""
        path = os.path.join(self.folder, "others.launch")
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"<launch>{content}</launch>")
        line = 'source "$0/devel/setup.bash" && exec roslaunch -p "$1" "$2"'
        command = ["bash", "-c", line, flying.BUILD, self.master.rsplit(":", 1)[1], path]
        done = subprocess.run(command, env=self.environment(PATH="/usr/bin:" + os.environ["PATH"], **environment),
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, check=False)
        return done.stdout

    def check(self, name, output, case):
        self.assertEqual(flying.summary(self.out(name))["status"], "complete", output)
        self.assertEqual(flying.summary(self.out(name))["case"], case, output)

    def test_an_include_gives_arguments(self):
        self.check("one", self.launched(include("$(find monarch_flight)/launch/climb.launch", self.out("one"))), "climb")

    def test_a_stranger_has_parameters_in_the_same_namespace(self):
        stranger = ('<group ns="monarch_flight"><node pkg="rosout" type="rosout" name="other">'
                    '<param name="rate" value="5"/></node></group>')
        self.check("one", self.launched(stranger + include(FLIGHT, self.out("one"))), "climb_controlled")

    def test_two_insects_fly_their_own_cases(self):
        other = '<arg name="case" value="tethered_fwuav"/>'
        output = self.launched(f'<group ns="a">{include(FLIGHT, self.out("a"))}</group>'
                               f'<group ns="b">{include(FLIGHT, self.out("b"), other)}</group>')
        self.check("a", output, "climb_controlled")
        self.check("b", output, "tethered_fwuav")

    def test_a_namespace_of_the_shell(self):
        output = self.launched(include(FLIGHT, self.out("one")), ROS_NAMESPACE="bf1")
        self.assertIn("bf1/monarch_flight/coordinator", output)
        self.check("one", output, "climb_controlled")


if __name__ == "__main__":
    unittest.main()
