"""Renders the flow of a run, off screen: vortices (iso-Q, coloured by spanwise vorticity, where cells are fine), wings by pressure
coefficient, body, flown path (red) and measured one (black). The run must have been flown with fields_every:=<steps>."""
import os
import pathlib
import re

from monarch_flight import keys
from monarch_flight.keys import Key, Table

SECTIONS = ("fields", "picture")
VIEWS = {  # where the camera stands, world axes: x east, y north (forward), z up
    "side": (1, 0, 0), "above": (0, 0, 1), "front": (0, 1, 0.15), "oblique": (0.8, -0.75, 0.55), "ahead": (0.75, 0.65, 0.5)}
KEYS = Table([
    Key("flap", "number", "time t/T of the picture in flapping periods; the nearest file is taken",
        default="the last one written"),
    Key("q", "number", "iso-value of Q", unit="1/s2", default="a tenth of (peak tip speed / mean chord)^2"),
    Key("vorticity", "number", "end of the colour scale", unit="1/s", default="4 times the root of q, rounded up"),
    Key("cp", "number", "end of the colour scale of the wings", default="1"),
    Key("view", "choice", "where the camera stands", choices=tuple(VIEWS), default="oblique"),
    Key("size", "text", "width and height in pixels", default="1600x1100")])
NUMBERS = ("flap", "q", "vorticity", "cp")


def add_arguments(parser):
    parser.add_argument("words", nargs="+", metavar="RUN | picture.png | key:=value", help="folder of the run first")
    parser.epilog = KEYS.help()


def settings(words):
    values, plain, faults = KEYS.read(words, plain=True)
    if not 1 <= len(plain) <= 2:
        faults.append("name the folder of a run, and no more than a picture behind it")
    elif not os.path.isdir(plain[0]):
        faults.append(f"{plain[0]}: no such folder")
    size = values.get("size", "1600x1100")
    if not re.fullmatch(r"[1-9]\d{1,3}x[1-9]\d{1,3}", size):
        faults.append(f"size:={size}: must be as 1600x1100")
    if faults:
        raise keys.Refused(*faults)
    found = {name: float(values[name]) if name in values else None for name in NUMBERS}
    picture = plain[1] if len(plain) == 2 else os.path.join(plain[0], "flow.png")
    return dict(found, view=values.get("view", "oblique"), size=size, folder=plain[0], picture=picture)


def run(arguments):
    wanted = settings(arguments.words)
    import numpy as np

    from monarch_flight.figures import flow_files
    from monarch_flight.figures.flow_scene import draw
    from monarch_flight.figures.screen import Screen
    from monarch_flight.report.flown import Flown
    from monarch_flight.report.model import Model
    folder = wanted["folder"]
    flown = Flown(pathlib.Path(folder), ended=False)
    t, flow, wings = flow_files.chosen_files(folder, wanted["flap"])
    with Screen() as screen:
        os.environ.update(screen.environment)
        row = int(np.argmin(np.abs(flown.columns["t"] - t)))
        draw(flow, wings, (Model(flown.folder), flown.columns, row), flow_files.paths(flown, t), VIEWS[wanted["view"]], wanted)
    T = flow_files.period(folder)
    print("%s: t = %.6g s%s" % (wanted["picture"], t, ", t/T = %.3f" % (t / T) if T else ""))
