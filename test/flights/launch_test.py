#!/usr/bin/python3
"""Launch files of other people that include ours: arguments, namespaces, strangers beside the nodes of a flight."""
import json
import os
import re
import subprocess
import time
import unittest

import flying
from monarch_flight.runs import master

ARGUMENTS = '<arg name="fluid" value="quasi_steady"/><arg name="flaps" value="0.1"/>'
FLIGHT = "$(find monarch_flight)/launch/flight.launch"


def include(file, out, more=""):
    return f'<include file="{file}">{ARGUMENTS}{more}<arg name="out" value="{out}"/></include>'


class Launch(flying.FlightTest):
    def core(self):
        """A master that outlives the launches."""
        environment = self.environment(ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost",
                                       PATH="/usr/bin:" + os.environ["PATH"])
        core = subprocess.Popen(["roscore", "-p", self.master.rsplit(":", 1)[1]], stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, env=environment)
        self.addCleanup(self.end, core)
        self.wait_for(lambda: master.answers(self.master), 30, "roscore")

    def launched(self, content, **environment):
        """What roslaunch says of a file; without a core it starts a master of its own. Not every machine knows its own name."""
        environment.setdefault("ROS_HOSTNAME", "localhost")
        path = os.path.join(self.folder, "others.launch")
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"<launch>{content}</launch>")
        line = 'source "$0/devel/setup.bash" && export ROS_MASTER_URI=$1 && exec roslaunch "$2"'
        command = ["bash", "-c", line, flying.BUILD, self.master, path]
        done = subprocess.run(command, env=self.environment(PATH="/usr/bin:" + os.environ["PATH"], **environment),
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, check=False,
                              cwd=self.folder)
        return done.stdout

    def check(self, name, output, case):
        self.assertEqual(flying.summary(self.out(name))["status"], "complete", output)
        self.assertEqual(flying.summary(self.out(name))["case"], case, output)

    def test_an_include_gives_arguments(self):
        case = '<arg name="case" value="climb"/>'
        self.check("one", self.launched(include(FLIGHT, self.out("one"), case)), "climb")

    def test_a_prefix_and_a_machine(self):
        """A prefix starts every node; a machine is one that the launch file declares."""
        starter = os.path.join(self.folder, "starter")
        with open(starter, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\necho PREFIXED $(basename "$1")\nexec "$@"\n')
        os.chmod(starter, 0o755)
        machine = '<machine name="near" address="localhost" env-loader="/usr/bin/env"/>'
        more = f'<arg name="launch_prefix" value="{starter}"/><arg name="machine" value="%s"/>'
        output = self.launched(machine + include(FLIGHT, self.out("one"), more % "near"))
        self.check("one", output, "climb_controlled")
        self.assertEqual(sorted(re.findall("PREFIXED (.*)", output)), ["coordinator", "flight", "fluid", "wing"])
        self.assertIn("unknown machine [far]", self.launched(machine + include(FLIGHT, self.out("two"), more % "far")))
        self.assertFalse(os.path.exists(self.out("two")))

    def nodes(self, **arguments):
        """{name: (machine, launch prefix)} of the nodes that flight.launch would start."""
        words = " ".join(f"{name}:={value}" for name, value in arguments.items())
        program = ("import json, sys, roslaunch.config, roslaunch.xmlloader as x\n"
                   "c = roslaunch.config.load_config_default([(sys.argv[1], sys.argv[2:])], None, assign_machines=False)\n"
                   "print(json.dumps({n.name: (n.machine_name, n.launch_prefix or '') for n in c.nodes}))")
        line = f'source "{flying.BUILD}/devel/setup.bash" && exec /usr/bin/python3 -c "$0" "$1" {words}'
        file = os.path.join(flying.ROOT, "launch", "flight.launch")
        done = subprocess.run(["bash", "-c", line, program, file], env=self.environment(), check=True, text=True,
                              stdout=subprocess.PIPE)
        return json.loads(done.stdout.splitlines()[-1])

    def test_where_nodes_run_and_what_starts_them(self):
        nodes = self.nodes(wings="independent", guidance_node="climb_guidance.py", machine="near", fluid_machine="far",
                           launch_prefix="nice", mpirun="env")
        flows = ("fluid", "fluid_left")
        for name in (*flows, "coordinator", "flight", "wing", "guidance"):
            machine, prefix = nodes[name]
            self.assertEqual((machine, prefix.split()), ("far", ["env", "nice"]) if name in flows else ("near", ["nice"]), name)
        for machine, prefix in self.nodes(mpirun="env").values():
            self.assertEqual((machine or "", prefix.replace("env", "").strip()), ("", ""))

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

    def test_a_refused_run_ends_at_once(self):
        """The coordinator alone knows that there is no such plugin; a solver in Python waits for it."""
        begin = time.monotonic()
        output = self.launched(f'<include file="{FLIGHT}"><arg name="guidance" value="nobody/Nothing"/>{ARGUMENTS}'
                               f'<arg name="fluid_node" value="drag_fluid.py"/><arg name="out" value="{self.out()}"/></include>')
        self.assertLess(time.monotonic() - begin, 25)
        self.assertNotIn("Traceback", output)
        for node in ("fluid", "flight", "wing"):
            self.assertIn(f"{node}: the coordinator has refused the run; the reason is its own message", output)
            self.assertRegex(output, rf"monarch_flight/{node}-\d+\] process has died \[pid \d+, exit code 2")

    def roslaunch(self, *words):
        line = 'source "$0/devel/setup.bash" && export ROS_MASTER_URI=$1 && shift && exec roslaunch "$@"'
        environment = self.environment(PATH="/usr/bin:" + os.environ["PATH"], ROS_HOSTNAME="localhost")
        return subprocess.run(["bash", "-c", line, flying.BUILD, self.master, *words], env=environment, text=True, timeout=60,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)

    def test_a_fault_of_the_case_is_told_once(self):
        """Before a node is started, so that the exit code of roslaunch tells it, too."""
        done = self.roslaunch("monarch_flight", "flight.launch", "fluid:=quasi_steady", "flaps:=-1", "out:=" + self.out())
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(done.stdout.count("time/flaps = -1: must be > 0"), 1, done.stdout)
        self.assertNotIn("process[", done.stdout)

    def test_what_shows_something_is_refused_without_a_display(self):
        """At once, for roslaunch ends with 0 when rviz does not start; the arguments can be listed all the same."""
        for name, words in (("view", ()), ("display", ()), ("replay", ("flight:=" + self.folder,))):
            file = os.path.join(flying.ROOT, "launch", name + ".launch")
            done = self.roslaunch(file, *words)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("environment variable 'DISPLAY' is not set", done.stdout)
            self.assertNotIn("process[", done.stdout)
            done = self.roslaunch("--ros-args", file)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("rviz_config", done.stdout)

    def test_flights_one_after_the_other_on_a_master_that_stays(self):
        """What they set is gone behind them, what others have set is not."""
        self.core()
        for name, value in (("/others", 1), ("/monarch_flight/their_node/rate", 5)):
            master.ask(self.master, "setParam", name, value)
        self.wait_for(lambda: "/rosversion" in master.ask(self.master, "getParamNames"), 30, "what roscore sets")
        before = set(master.ask(self.master, "getParamNames"))
        for name in ("one", "two"):
            case = '<arg name="case" value="%s"/>' % {"one": "climb", "two": "climb_controlled"}[name]
            output = self.launched(include(FLIGHT, self.out(name), case))
            self.check(name, output, {"one": "climb", "two": "climb_controlled"}[name])
            left = set(master.ask(self.master, "getParamNames")) - before
            self.assertEqual({one for one in left if not one.startswith("/roslaunch/uris")}, set())
        self.assertEqual(master.ask(self.master, "getParam", "/monarch_flight/their_node/rate"), 5)

    def test_a_token_file_beside_the_launch_file(self):
        """Relative, it starts where roslaunch was called; auto is as if it was not given."""
        for given in ("secret/token", "auto"):
            output = self.launched(include(FLIGHT, self.out(given[:4]), f'<arg name="token_file" value="{given}"/>'))
            self.check(given[:4], output, "climb_controlled")
            self.assertNotIn("every node of this master can take part", output)
        self.assertEqual(os.stat(os.path.join(self.folder, "secret")).st_mode & 0o777, 0o700)
        self.assertEqual(os.listdir(os.path.join(self.folder, "secret")), [])


if __name__ == "__main__":
    unittest.main()
