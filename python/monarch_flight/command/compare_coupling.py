"""Flies the same Navier-Stokes flight with every coupling strategy and prints one table.

Columns: ratio, the largest added-mass ratio; mean and max, sub-iterations of a step; air/step, full evaluations of
the air; growth, of the residual from one sub-iteration to the next in first attempts (plain: the fixed point
diverges above 1).

The exit code is 0 when every flight with added_mass, the default, meets the bars: sub-iterations 2.5 in the mean
and 5 at most, 2.2 evaluations of the air a step, every step converged at once."""
import os
import time

from monarch_flight import case_files, keys, places, preparing
from monarch_flight.keys import Key, Table

STRATEGIES = ("plain", "constant", "aitken", "iqn_ils", "added_mass")
NUMBERS = ("masses", "steps_per_flap")
KEYS = Table([
    Key("flaps", "number", "length of each flight in flapping periods", above=0, default="0.2"),
    Key("masses", "text", "masses of one wing, comma separated", unit="mg", default="36.25,25.1,3.625"),
    Key("steps_per_flap", "text", "comma separated", default="500,1000"),
    Key("strategies", "text", "of plain (fixed point without relaxation), constant, aitken, iqn_ils, added_mass, comma "
        "separated", default=",".join(STRATEGIES)),
    Key("case", "case", "a shipped case or the path of a case file", default="climb_printed"),
    Key("fluid", "choice", "the air", choices=("navier_stokes", "quasi_steady"), default="navier_stokes"),
    Key("grid", "choice", "as of a run, and coarse: 8 cells to a chord, for long flights",
        choices=("preview", "standard", "fine", "coarse"), default="preview"),
    Key("jobs", "count", "flights at a time (more make the wall times longer)", from_=1, default="1"),
    Key("out", "path", "a new or empty folder for cases, results and table.md", default="flights/coupling-[time]")])


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="key:=value")
    parser.epilog = KEYS.help()


def positive(text):
    number = Key("", "number", "", above=0)
    return all(map(number.accepts, text.split(",")))


def values_from(words):
    given, _, faults = KEYS.read(words)
    values = {name: key.default for name, key in KEYS.items()} | given
    if "out" not in given:
        values["out"] = str(places.flights() / time.strftime("coupling-%Y%m%d-%H%M%S"))
    faults += [f"strategies:={values['strategies']}: must be of {', '.join(STRATEGIES)}{keys.nearest(name, STRATEGIES)}"
               for name in values["strategies"].split(",") if name not in STRATEGIES]
    faults += [f"{name}:={values[name]}: must be numbers > 0" for name in NUMBERS if not positive(values[name])]
    if not os.path.isfile(case_files.path_of(values["case"])):
        faults.append(f"case:={values['case']}: neither a shipped case nor a file")
    if os.path.isdir(values["out"]) and os.listdir(values["out"]):
        faults.append(f"out:={values['out']}: holds something already; name a new folder")
    if faults:
        raise keys.Refused(*faults)
    return values


def run(arguments):
    values = values_from(arguments.words)
    preparing.ready("fly")
    from monarch_flight.trials import compare_coupling
    return compare_coupling.compare(values)
