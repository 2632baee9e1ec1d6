#!/usr/bin/python3
"""Plays the bag of a flight (replay.launch) with the names that a run launched here has, wherever it was flown.

usage: play.py FOLDER [--await-rviz] [words for rosbag play]
--await-rviz: begins when rviz is ready, at the latest after 20 s"""
import os
import pathlib
import sys
import time

import rosbag
import roslib.packages

from monarch_flight.runs import recorded_names
from monarch_flight.runs.master import listens, space

PATIENCE = 20.0  # [s]


def await_rviz():
    """Its displays subscribe all at once."""
    uri, rviz = os.environ.get("ROS_MASTER_URI", "http://localhost:11311"), space().rpartition("/")[0] + "/rviz"
    print(f"play: waiting for rviz, at most {PATIENCE:.0f} s", flush=True)
    end = time.monotonic() + PATIENCE
    while not listens(uri, rviz, space() + "/path"):
        if time.monotonic() > end:
            print(f"play: rviz has not come within {PATIENCE:.0f} s: the replay begins without it", flush=True)
            return
        time.sleep(0.2)


def main(words):
    bag = pathlib.Path(words[0]) / "flight.bag"
    try:
        names = recorded_names.of(bag)
    except (OSError, rosbag.ROSBagException) as error:
        sys.exit(f"play: {bag} cannot be read ({error}); name the folder of a run that was recorded")
    if "--await-rviz" in words:
        words.remove("--await-rviz")
        try:
            await_rviz()
        except KeyboardInterrupt:
            sys.exit(130)
    player = roslib.packages.find_node("rosbag", "play")[0]
    os.execv(player, [player, *words[1:], str(bag), *names.remaps(space())])


if __name__ == "__main__":
    main(sys.argv[1:])
