#!/usr/bin/python3
"""rviz of a flight (flight.launch, view.launch, replay.launch): makes what it shows for the theme, the namespace and
the frames of the flight, and becomes rviz.

usage: show.py [theme:=dark|light] [rviz_config:=FILE] [frame_prefix:=PREFIX] [flight:=FOLDER] [words for rviz]
FILE is shown as it is; FOLDER is that of a recorded flight, whose frames are shown."""
import os
import pathlib
import sys

import rosbag

from monarch_flight import rviz_config
from monarch_flight.runs import recorded_names
from monarch_flight.runs.master import ask, space

OURS = ("theme", "rviz_config", "frame_prefix", "flight")


def sorted_out(words):
    """Our keys that are given, and the words for rviz."""
    given, others = {}, []
    for word in words:
        key, mark, value = word.partition(":=")
        if not mark or key not in OURS:
            others.append(word)
        elif value not in ("", "auto"):
            given[key] = value
    return given, others


def prefix(given):
    """Of the insect's frames: as given, as the bag has it, as the flight was told, else the namespace."""
    wanted = given.get("frame_prefix")
    if wanted is None and "flight" in given:
        bag = pathlib.Path(given["flight"]) / "flight.bag"
        try:
            return recorded_names.of(bag).prefix
        except (OSError, rosbag.ROSBagException) as error:
            sys.exit(f"show: {bag} cannot be read ({error}); name the folder of a run that was recorded")
    master = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
    wanted = wanted or ask(master, "getParam", f"{space()}/frame_prefix")
    wanted = space().rpartition("/")[0] if wanted in (None, "", "auto") else str(wanted)
    return wanted.strip("/") + "/" if wanted.strip("/") else ""


def made(given):
    """The file of the config, new or the same as before."""
    folder = pathlib.Path(os.environ.get("ROS_HOME") or pathlib.Path.home() / ".ros") / "monarch_flight"
    folder.mkdir(parents=True, exist_ok=True)
    theme = given.get("theme", rviz_config.THEMES[0])
    file = folder / f"{space().strip('/').replace('/', '_')}_{theme}.rviz"
    part = folder / f"{file.name}.{os.getpid()}"
    part.write_text(rviz_config.config(theme, prefix(given)), encoding="utf-8")
    part.replace(file)
    return file


def display():
    """Ends here where rviz has none."""
    if not os.environ.get("DISPLAY"):
        sys.exit("show: there is no display (DISPLAY is not set), so no rviz: start it in a terminal of the desktop or by "
                 "ssh -X, or leave rviz away (rviz:=false). Pictures without a display: monarch film, monarch screenshot")


def main(words):
    display()
    given, others = sorted_out(words)
    if given.get("theme", "dark") not in rviz_config.THEMES:
        sys.exit(f"show: theme:={given['theme']}: must be {' or '.join(rviz_config.THEMES)}")
    try:
        file = given.get("rviz_config") or made(given)
        os.execvp("rviz", ["rviz", "-d", str(file), *others])
    except FileNotFoundError as error:
        sys.exit(f"show: {error.filename or 'rviz'} is not there; install rviz (scripts/install view)"
                 if error.filename in (None, "rviz", b"rviz") else f"show: {error}")
    except OSError as error:
        sys.exit(f"show: {error}")


if __name__ == "__main__":
    main(sys.argv[1:])
