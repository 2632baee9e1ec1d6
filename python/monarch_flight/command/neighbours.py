"""What the other wing and the body would change in a flight, which a flow of one wing leaves out.

Takes the motion of the last flap of RUN (flight.csv) and computes the loads of a wing in potential flow, by vortex
rings with a wake: alone, beside the other wing, beside the body. What differs is an estimate of what is not
modelled (docs/validation.md). Prints a table and writes RUN/neighbours.csv. About a minute."""
from monarch_flight import keys, preparing
from monarch_flight.keys import Key, Table

SECTIONS = ("fly",)
KEYS = Table([Key("chordwise", "count", "rings along the chord", from_=3, to=20, default="6"),
              Key("spanwise", "count", "rings along the span", from_=4, to=40, default="10"),
              Key("steps", "count", "of a flap", from_=20, to=500, default="63"),
              Key("gap", "number", "distance from the mid-plane at which wings that would meet are bent aside", above=0,
                  unit="mm", default="1"),
              Key("core", "number", "of the vortices of the wake", above=0, unit="mean chords", default="0.1")])


def add_arguments(parser):
    parser.add_argument("run", metavar="RUN", help="folder of a flight of two flaps or more, as flights/climb")
    parser.add_argument("words", nargs="*", metavar="key:=value", help="as gap:=0.5")
    parser.epilog = KEYS.help()


def run(arguments):
    values, _, faults = KEYS.read(arguments.words)
    if faults:
        raise keys.Refused(*faults)
    preparing.installed("fly")
    from monarch_flight.neighbours import table
    numbers = {key: int(values[key]) for key in ("chordwise", "spanwise", "steps") if key in values}
    if "gap" in values:
        numbers["gap"] = 1e-3 * float(values["gap"])
    if "core" in values:
        numbers["core"] = float(values["core"])
    return table.told(arguments.run, numbers)
