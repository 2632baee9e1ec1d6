"""Hostile messages on every topic of a real flight, the full number: refused, counted, no trace left.

Flies over nodes while a stranger and a confused node speak on every lockstep topic, and compares the flight with an
undisturbed one. The exit code is 0 only if every message was refused and counted and the states are the same bit
for bit."""
import subprocess

from monarch_flight import keys, places, preparing, telling
from monarch_flight.keys import Key


def add_arguments(parser):
    parser.add_argument("--messages", default="10000", metavar="N",
                        help="on each of the 12 to 20 topics of a flight of three to five roles (10000)")


def run(arguments):
    count = Key("messages", "count", "", from_=1, to=9999999)
    if not count.accepts(arguments.messages):
        raise keys.Refused(f"--messages {arguments.messages}: must be {count.allowed}")
    root = preparing.source_only("hostile")
    preparing.installed("fly", "check")
    preparing.built("--tests")
    from monarch_flight.runs import environment
    base = environment.of_flight(environment.sourced())
    limit = str(600 + int(arguments.messages))
    code = subprocess.run(["/usr/bin/python3", root / "test/ros/with_master.py", "--limit", limit,
                           places.program("ros_hostile_test"), "--gtest_filter=*LeaveNoTrace*"],
                          env=dict(base, MONARCH_HOSTILE_MESSAGES=arguments.messages), check=False).returncode
    return telling.passed_on(code, "the test", "hostile")
