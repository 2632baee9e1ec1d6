"""Writes one HTML page of a run, or of several beside each other: the flight in 3-D, curves, figures, where its numbers are
from. The page needs nothing else, and no network. docs/report.md"""
import os
import pathlib

from monarch_flight import keys, places, preparing
from monarch_flight.keys import Key, Table
from monarch_flight.report import MOST, NAME

SECTIONS = ("fly", "report")
KEYS = Table([Key("out", "path", "file of the page", default=f"{NAME} in the folder of the first run")])


def add_arguments(parser):
    parser.add_argument("words", nargs="+", metavar="RUN | key:=value", help="folders of runs, one to six")
    parser.epilog = KEYS.help()


def settings(words):
    """(folders, file). Raises Refused."""
    values, plain, faults = KEYS.read(words, plain=True)
    folders = [places.person_path(name) for name in plain]
    faults += [f"{folder}: no such folder" for folder in folders if not os.path.isdir(folder)]
    if not 1 <= len(folders) <= MOST:
        faults.append(f"{len(folders)} runs: name the folders of one to {MOST}")
    out = places.person_path(values["out"]) if "out" in values else (folders or [pathlib.Path()])[0] / NAME
    if not faults and (os.path.isdir(out) or not os.path.isdir(out.parent)):
        faults.append(f"out:={out}: must be a file in a folder that exists")
    if faults:
        raise keys.Refused(*faults)
    return folders, out


def run(arguments):
    folders, out = settings(arguments.words)
    preparing.ready(*SECTIONS)
    from monarch_flight.report import page
    page.write(folders, out)
    print(out)
