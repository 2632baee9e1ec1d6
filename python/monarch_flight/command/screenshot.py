"""Takes a picture of a recorded flight: replays its bag into rviz on a display without a screen, from the start to
the end or up to so many seconds of flight, and writes what rviz/monarch.rviz shows then.

Needs no display and no graphics card. Takes about a minute."""
import os
import pathlib

from monarch_flight import keys, places, preparing
from monarch_flight.keys import Key

SECTIONS = ("fly", "view", "panel", "picture")


def add_arguments(parser):
    parser.add_argument("bag", nargs="?", help="default: the newest in flights/")
    parser.add_argument("picture", nargs="?", help="default: flight.png beside the bag")
    parser.add_argument("seconds", nargs="?", help="of flight; default: all")


def newest():
    """The bag written last in flights/, or None."""
    return max(places.flights().glob("**/flight.bag"), key=lambda path: path.stat().st_mtime, default=None)


def run(arguments):
    bag = places.person_path(arguments.bag) if arguments.bag else newest()
    faults = []
    if bag is None:
        faults.append(f"no bag in {places.flights()}; fly first (monarch fly), or name one")
    elif not os.path.isfile(bag):
        faults.append(f"{bag} does not exist; name the flight.bag of a run")
    number = Key("seconds", "number", "", above=0)
    if arguments.seconds and not number.accepts(arguments.seconds):
        faults.append(f"'{arguments.seconds}': must be {number.allowed} of seconds")
    if faults:
        raise keys.Refused(*faults)
    picture = places.person_path(arguments.picture or bag.parent / "flight.png")
    if not os.path.isdir(picture.parent):
        raise keys.Refused(f"{picture}: there is no folder {picture.parent}; make it, or name another picture")
    preparing.ready(*SECTIONS)
    from monarch_flight.figures import screenshot
    screenshot.take(pathlib.Path(bag), picture, float(arguments.seconds) if arguments.seconds else None)
