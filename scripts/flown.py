#!/usr/bin/python3
"""Ends when all flights of its launch are over, and with it roslaunch (flight.launch): no flight ends another one.

Waits while a coordinator, or an rviz, of the same roslaunch lives; other nodes then have some seconds to end."""
import os
import signal
import sys
import time

BEGIN, LEAVE, LOOK = 30.0, 10.0, 0.2  # s
NODES = {"coordinator", "fluid", "flight", "wing", "rviz"}
LEADERS = {"coordinator", "rviz"}


def siblings():
    """Names of the programs that the same parent has started and that still run."""
    found = set()
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
                state, parent = file.read().rpartition(")")[2].split()[:2]
            if int(parent) == os.getppid() and state != "Z":
                with open(f"/proc/{pid}/cmdline", encoding="utf-8", errors="replace") as file:
                    # The program, or the script behind its interpreter.
                    found |= {os.path.basename(word) for word in file.read().split("\0")[:2]}
        except (OSError, ValueError):
            continue  # it has just ended
    return found & NODES


def wait_while(alive, limit=float("inf")):
    end = time.monotonic() + limit
    while alive() and time.monotonic() < end:
        time.sleep(LOOK)


def main():
    signal.signal(signal.SIGINT, lambda *_: sys.exit(0))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    leaders = []
    wait_while(lambda: not leaders and not leaders.extend(LEADERS & siblings()), BEGIN)
    wait_while(lambda: LEADERS & siblings())
    # A leader that was never seen is on another machine, or was refused: the other nodes end with it.
    wait_while(siblings, LEAVE if leaders else float("inf"))


if __name__ == "__main__":
    main()
