"""Draws the paper's figures from recorded runs, flying what is missing on the preview grid."""
import os
import sys
import types

from monarch_flight import keys, places, preparing
from monarch_flight.keys import Key, Table

SECTIONS = ("fly", "figures")
NAMES = ("fig2", "fig4", "fig5", "fig6", "fig7", "fig8", "fig9", "dynamics", "control")
KEYS = Table([
    Key("out", "path", "folder of the pictures, PNG and PDF", default="flights/figures"),
    Key("runs", "path", "folders of free flights for fig7 to fig9 and control, comma separated; fig8 and fig9 take the "
        "first one; control draws each flight that is led beside the one of the same insect in the same air and wind that "
        "is not; without runs it flies the case climb_controlled in both airs, with control and without"),
    Key("case", "case", "case of the free flights that are flown when runs is not given", default="climb"),
    Key("fluid", "choice", "their air", choices=("navier_stokes", "quasi_steady"), default="navier_stokes"),
    Key("flaps", "number", "their length", above=0, default="7"),
    Key("verification", "path", "folder that monarch verify dynamics wrote", default="verification")])
AIRS = {"navier_stokes": "Navier-Stokes, preview grid", "quasi_steady": "quasi-steady air"}


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="FIGURE | key:=value",
                        help="of " + " ".join(NAMES) + "; default: all but control")
    parser.epilog = KEYS.help()


def settings_from(words):
    """(settings, names of the figures). Raises Refused."""
    values, names, faults = KEYS.read(words, plain=True)
    faults += [f"unknown figure '{name}': must be one of {' '.join(NAMES)}{keys.nearest(name, NAMES)}"
               for name in names if name not in NAMES]
    names = names or [name for name in NAMES if name != "control"]
    given = [places.person_path(folder) for folder in values.get("runs", "").split(",") if folder]
    faults += [f"runs:={folder}: no such folder" for folder in given if not os.path.isdir(folder)]
    verification = places.person_path(values.get("verification", "verification"))
    if "dynamics" in names and not os.path.isfile(verification / "published_attitude.csv"):
        faults.append(f"verification:={verification}: holds no proof of the dynamics; run monarch verify dynamics")
    if faults:
        raise keys.Refused(*faults)
    out = places.person_path(values.get("out", places.flights() / "figures"))
    fluid = values.get("fluid", "navier_stokes")
    title = "given runs" if given else AIRS[fluid]
    return types.SimpleNamespace(out=out, runs=out / "runs", given=given, case=values.get("case", "climb"), fluid=fluid,
                                 flaps=values.get("flaps", "7"), verification=verification, title=lambda: title), names


def run(arguments):
    settings, names = settings_from(arguments.words)
    preparing.installed(*SECTIONS)
    from monarch_flight.figures.paper import FIGURES
    settings.out.mkdir(parents=True, exist_ok=True)
    for name in names:
        drawn = FIGURES[name](settings)
        for file, figure in (drawn if isinstance(drawn, dict) else {name: drawn}).items():
            for kind in ("png", "pdf"):
                figure.savefig(settings.out / f"{file}.{kind}")
            print(settings.out / f"{file}.png")
    sys.stdout.flush()
