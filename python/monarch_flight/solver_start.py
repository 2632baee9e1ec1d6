"""How a solver of one's own (solver_node) begins: its place on the master, and what it does where there is no flight."""
import contextlib
import os
import signal
import sys
import time

import rospy

FAILED, REFUSED = 1, 2  # exit codes


class NoFlight(Exception):
    """Why this node does not fly."""

    def __init__(self, text, code=REFUSED):
        super().__init__(text)
        self.code = code


def begin(role):
    """This node on the master, in the namespace where the launch files put a run that is alone unless the person has
    given another, and reached from this machine only unless the person has given it an address."""
    if "ROS_IP" not in os.environ:
        os.environ.setdefault("ROS_HOSTNAME", "localhost")
    if rospy.get_namespace() == "/" and not os.environ.get("ROS_NAMESPACE"):
        rospy.names._set_caller_id("/monarch_flight/unnamed")
    rospy.init_node(role, disable_signals=True)


class Coordinator:
    """While it is waited for: where it has ended before the flight, the parameter exit_codes, which the launch files
    make, says so."""

    def __init__(self):
        self.next = 0.0

    def refuse(self):
        """Asks the master, twice a second at most."""
        if time.monotonic() < self.next:
            return
        self.next = time.monotonic() + 0.5
        try:
            code = rospy.get_param("exit_codes/coordinator", -1)
        except OSError:
            raise NoFlight("the ROS master is gone", FAILED) from None
        if code >= 0:
            how = "has refused the run" if code == REFUSED else "has ended before the flight"
            raise NoFlight("the coordinator %s; the reason is its own message" % how, code)


def tell_early_end(code):
    """As the coordinator does, for whoever waits for this node."""
    parameter = "exit_codes/" + rospy.get_name().rpartition("/")[2]
    try:
        if rospy.has_param(parameter):
            rospy.set_param(parameter, code)
    except OSError:
        pass  # the master is gone


def end_quietly():
    """Ignores SIGINT from now on: roslaunch interrupts what still runs, and a leaving interpreter would print a traceback."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextlib.contextmanager
def one_line(role, interrupted=()):
    """Ends the program with one line, where this node does not fly; and without one when it is `interrupted`."""
    try:
        yield
    except interrupted:
        end_quietly()
        sys.exit(130)
    except NoFlight as why:
        print("%s: %s" % (role, why), file=sys.stderr, flush=True)
        tell_early_end(why.code)
        end_quietly()
        sys.exit(why.code)
