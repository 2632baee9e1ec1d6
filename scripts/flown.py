#!/usr/bin/python3
"""Ends when all flights of its launch are over, and with it roslaunch (flight.launch): no flight ends another one.

Waits while a coordinator, or an rviz (not of a refused run), of the same roslaunch lives; other nodes then have some
seconds to end. Then it takes the parameters of its flight off the master, which may live on."""
import os
import signal
import time

from monarch_flight.runs.master import ask

BEGIN, QUIET, LEAVE, LOOK = 30.0, 5.0, 10.0, 0.2  # s
NODES = {"coordinator", "fluid", "fluid_left", "flight", "wing", "guidance", "rviz"}  # names of flight.launch
LEADERS = {"coordinator", "rviz"}
REFUSED = 2  # exit code of a node
NAME = "__name:="  # roslaunch gives it to each node


def siblings():
    """Names of the nodes that the same roslaunch has started and that still run, whatever program each one is."""
    found = set()
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
                state, parent = file.read().rpartition(")")[2].split()[:2]
            if int(parent) == os.getppid() and state != "Z":
                with open(f"/proc/{pid}/cmdline", encoding="utf-8", errors="replace") as file:
                    words = file.read().split("\0")
                found |= {word[len(NAME):] for word in words if word.startswith(NAME)}
                found |= {"rviz"} & {os.path.basename(words[0])}  # in a launch file of others it has any name
        except (OSError, ValueError):
            continue  # it has just ended
    return found & NODES


def wait_while(alive, limit=float("inf")):
    end = time.monotonic() + limit
    while alive() and time.monotonic() < end:
        time.sleep(LOOK)


def leader_begins():
    """Whether a leader is seen; given up as soon as none of the nodes has been there for a while (refused at once)."""
    begin = last = time.monotonic()
    while time.monotonic() < min(begin + BEGIN, last + QUIET):
        seen = siblings()
        if LEADERS & seen:
            return True
        last = time.monotonic() if seen else last
        time.sleep(LOOK)
    return False


def place():
    """The master, and the namespace of the flight with a "/" at both ends."""
    beside = os.environ.get("ROS_NAMESPACE", "").strip("/")
    return os.environ.get("ROS_MASTER_URI", "http://localhost:11311"), "/" + beside + "/" if beside else "/"


def tidy(may_live):
    """Takes away what flight.launch has set; nothing where another flight has taken the place of this one. `may_live`:
    whether its own coordinator may still be there."""
    master, beside = place()
    run, coordinator = beside + "monarch_flight", beside + "monarch_flight/coordinator"
    at = ask(master, "lookupNode", coordinator)
    if at and not may_live and ask(at, "getPid") is not None:
        return
    for name, value in (ask(master, "getParam", run) or {}).items():
        if name == "exit_codes" or not isinstance(value, dict):  # the others are private ones of nodes
            ask(master, "deleteParam", f"{run}/{name}")
    ask(master, "deleteParam", beside + "robot_description")
    publishers = (ask(master, "getSystemState") or [[]])[0]
    if not any(topic == "/clock" and set(nodes) - {coordinator} for topic, nodes in publishers):
        ask(master, "deleteParam", "/use_sim_time")  # nobody gives the time any more


def refused():
    """Whether the coordinator has refused the run: then there is nothing that rviz could show."""
    master, beside = place()
    return ask(master, "getParam", beside + "monarch_flight/exit_codes/coordinator") == REFUSED


def goes_on():
    leaders = LEADERS & siblings()
    return leaders and not (leaders == {"rviz"} and refused())


def ended(*_):
    tidy(may_live=True)
    os._exit(0)


def main():
    signal.signal(signal.SIGINT, ended)
    signal.signal(signal.SIGTERM, ended)
    led = leader_begins()
    wait_while(goes_on)
    # A leader that was never seen is on another machine, or was refused: the other nodes end with it.
    wait_while(siblings, LEAVE if led else float("inf"))
    tidy(may_live=False)


if __name__ == "__main__":
    main()
