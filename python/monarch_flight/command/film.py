"""Makes a film of a recorded flight: the insect, its wings coloured by pressure, the vortices around them (surfaces of
one Q, coloured by the vorticity along the span), the path. Needs no display and no graphics card."""
import os
import pathlib
import re

from monarch_flight import keys, places, preparing
from monarch_flight.keys import Key, Table

SECTIONS = ("film",)
VIEWS = ("oblique", "side", "front", "top", "chase")
KEYS = Table([
    Key("view", "choice", "where the camera stands; it follows the body, and `chase` turns with it", choices=VIEWS,
        default="oblique"),
    Key("slow", "number", "how much slower than the flight the film is", above=0, default="10"),
    Key("fps", "count", "frames a second", from_=1, to=120, default="25"),
    Key("size", "text", "width and height in pixels, even numbers", default="1280x720; 640x360 of a gif"),
    Key("theme", "choice", "ground and words", choices=("dark", "light"), default="dark"),
    Key("wings", "choice", "colours of the wings: their pressure coefficient, or the insect's own pattern",
        choices=("pressure", "pattern"), default="pressure"),
    Key("from", "number", "where the film begins", unit="flaps", default="0"),
    Key("to", "number", "where it ends", unit="flaps", above=0, default="the end of the flight"),
    Key("q", "number", "vortices are where Q exceeds so many (peak tip speed / mean chord)^2", above=0, default="0.04"),
    Key("opacity", "number", "of the vortices, up to 1", above=0, default="0.55"),
    Key("distance", "number", "of the camera from the body", unit="spans of a wing", above=0, default="5")])
DEFAULTS = {"slow": 10.0, "fps": 25.0, "from": 0.0, "to": None, "q": 0.04, "opacity": 0.55, "distance": 5.0}


def add_arguments(parser):
    parser.add_argument("words", nargs="+", metavar="RUN | film.mp4 | film.gif | key:=value",
                        help="folder of the run (or its bag) first, then the film; default: film.mp4 beside the bag")
    parser.epilog = KEYS.help()


def settings(words):
    """Bag, film, and what the keys say."""
    values, plain, faults = KEYS.read(words, plain=True)
    if not 1 <= len(plain) <= 2:
        raise keys.Refused(*faults, "name the folder of a run, and no more than a film behind it")
    bag = pathlib.Path(places.person_path(plain[0]))
    bag = bag / "flight.bag" if bag.is_dir() else bag
    if not bag.is_file():
        faults.append(f"{bag} does not exist; name the folder of a run that was recorded to its end (record:=true)")
    out = pathlib.Path(places.person_path(plain[1])) if len(plain) == 2 else bag.parent / "film.mp4"
    if out.suffix not in (".mp4", ".gif"):
        faults.append(f"{out}: must end with .mp4 or .gif")
    if not out.parent.is_dir():
        faults.append(f"{out}: there is no folder {out.parent}; make it, or name another film")
    size = values.get("size", "640x360" if out.suffix == ".gif" else "1280x720")
    if not re.fullmatch(r"[1-9]\d{1,2}[02468]x[1-9]\d{1,2}[02468]", size):
        faults.append(f"size:={size}: must be as 1280x720, two even numbers")
    found = {name: float(values[name]) if name in values else usual for name, usual in DEFAULTS.items()}
    faults += range_faults(found)
    if faults:
        raise keys.Refused(*faults)
    found["flat"] = out.suffix == ".gif"  # few colours, which a gradient would take
    found["size"] = tuple(int(n) for n in size.split("x"))
    found.update((name, values.get(name, usual)) for name, usual in
                 (("view", "oblique"), ("theme", "dark"), ("wings", "pressure")))
    return bag, out, found


def range_faults(found):
    if found["opacity"] > 1:
        yield f"opacity:={found['opacity']:g}: must be above 0, up to 1"
    if found["from"] < 0:
        yield f"from:={found['from']:g}: must be >= 0"
    if found["to"] is not None and found["to"] <= found["from"]:
        yield f"to:={found['to']:g}: must be above from:={found['from']:g}"


def run(arguments):
    bag, out, wanted = settings(arguments.words)
    preparing.installed(*SECTIONS)
    from monarch_flight.figures.screen import Screen
    with Screen("64x64") as screen:
        os.environ.update(screen.environment)
        from monarch_flight.film import film
        film.make(bag, out, wanted)
