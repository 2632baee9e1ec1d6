#!/usr/bin/python3
"""Plays the bag of a flight (replay.launch) with the names that a run launched here has, wherever it was flown.

usage: play.py FOLDER [words for rosbag play]"""
import os
import pathlib
import sys

import rosbag
import roslib.packages

from monarch_flight.runs import recorded_names
from monarch_flight.runs.master import space


def main(words):
    bag = pathlib.Path(words[0]) / "flight.bag"
    try:
        names = recorded_names.of(bag)
    except (OSError, rosbag.ROSBagException) as error:
        sys.exit(f"play: {bag} cannot be read ({error}); name the folder of a run that was recorded")
    player = roslib.packages.find_node("rosbag", "play")[0]
    os.execv(player, [player, *words[1:], str(bag), *names.remaps(space())])


if __name__ == "__main__":
    main(sys.argv[1:])
