"""Flies a request: over nodes on a master, or in one process."""
import os
import shlex
import shutil
import socket
import sys
import tempfile

from monarch_flight import places
from monarch_flight.runs import environment, master, watched
from monarch_flight.runs.ending import REFUSED, Ending
from monarch_flight.telling import FAILED, STOPPED, passed_on, say

PYTHON = "/usr/bin/python3"  # which has the ROS modules
LOCAL = ("", "localhost", "127.0.0.1")


def now():
    """The time that files written from now on have at least [ns]."""
    with tempfile.TemporaryFile() as file:
        return os.fstat(file.fileno()).st_mtime_ns


def in_process(request):
    """Command and environment."""
    command = [places.program("fly_in_process"), *request.words("program")]
    base = environment.of_flight(os.environ)
    if request.ranks > 1 and not request.plan:
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(request.ranks), *command]
        base = environment.of_processes(base)
    return command, base


def own_master(base, uri):
    """Says why a flight has a master of its own, who sees it, and the remedy. `uri`: of a master that does not answer."""
    dead = f"ROS_MASTER_URI={uri} does not answer: " if uri else ""
    unused = [f"{name}={base[name]}" for name in ("ROS_HOSTNAME", "ROS_IP") if base.get(name, "localhost") not in LOCAL]
    return (f"fly: {dead}the flight has a master of its own and is seen from this machine only; for other machines: docs/usage.md, "
            "another machine" + (" (" + ", ".join(unused) + " is for a master that runs already)" if unused else ""))


def nameless():
    """Why roslaunch can start nothing on this machine; None: it can. It looks its own machine up as localhost."""
    try:
        socket.getaddrinfo("localhost", None)
    except OSError:
        return "this machine does not know the name localhost, which roslaunch needs: add the line '127.0.0.1 localhost' to /etc/hosts"
    return None


class Nodes:
    """The command that starts them, on the person's master or on one of its own."""

    def __init__(self, request, base):
        self.request, self.environment, self.port = request, base, 0
        self.why_not = None
        uri = base.get("ROS_MASTER_URI")
        if uri and master.answers(uri):
            self.why_not = master.busy(uri)
        else:
            print(own_master(base, uri))
            self.port = master.free_port()
            self.environment = dict(base, ROS_MASTER_URI=f"http://localhost:{self.port}", ROS_HOSTNAME="localhost")
            self.environment.pop("ROS_IP", None)

    @property
    def command(self):
        return [PYTHON, "-m", "monarch_flight.runs.launcher", "FACTS", str(self.port),
                "stays" if self.request.stays else "ends", places.share() / "launch/flight.launch", *self.request.words("launch")]

    def second_shell(self):
        """One line to copy, for whoever leads the run from there."""
        given = " ".join(f"{name}={shlex.quote(self.environment[name])}" for name in ("ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_NAMESPACE")
                         if self.environment.get(name))
        line = f"export {given} PATH=/usr/bin:$PATH"
        script = places.prefix() / "setup.bash"
        if script.is_file():  # a Debian package has none
            line = f"source {shlex.quote(str(script))}; {line}"
        if places.source() and not all(os.access("/usr/bin/" + name, os.X_OK) for name in ("rostopic", "rosservice")):
            line = f"{shlex.quote(str(places.source() / 'scripts/install'))} tools && {line}"
        return line


def over_nodes(request):
    """(command, environment), or None where the master is in use."""
    nodes = Nodes(request, environment.of_flight(environment.sourced()))
    if nodes.why_not:
        say(nodes.why_not)
        return None
    if request.leader == "commands" or request.true("paused"):
        print(f"fly: in a second shell, before rostopic, rosservice or rosrun:\n{nodes.second_shell()}")
    return nodes.command, nodes.environment


def fly(request, stop, command_name):
    """Exit code."""
    begin = now()
    ending = Ending(request, begin, command_name)
    os.environ["MONARCH_GO_ON"] = ending.again()  # for the advice of the program that flies
    why_not = None if request.in_process else nameless()
    if why_not:
        say(why_not)
        return REFUSED
    chosen = in_process(request) if request.in_process else over_nodes(request)
    if chosen is None:
        return FAILED
    if request.ranks > 1 and not request.plan and not shutil.which("mpirun", path=chosen[1].get("PATH")):
        say(f"ranks:={request.ranks}: there is no mpirun in PATH; install openmpi-bin, or use ranks:=1")
        return REFUSED
    sys.stdout.flush()
    code, facts = watched.run(*chosen, stop)
    if request.plan:
        return STOPPED if stop.heard else passed_on(code, "the program that plans", "plan")
    return ending.of(code, facts, stop.heard)
