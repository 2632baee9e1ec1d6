"""Tells whether a flight that is led has settled, and stores its periodic flight as a case (docs/trim.md, Through
control).

Prints a line per flap. Commands are those that the wings flew, behind the filters. Exit code: 0 settled (and
written), 1 not settled (nothing is written), 2 refused."""
from monarch_flight.keys import Key, Table

SECTIONS = ("figures",)
KEYS = Table([
    Key("flaps", "count", "so many last flaps are judged, and stored in the mean", from_=1, default="3"),
    Key("repeat", "number", "bound: largest change of the state over a flap, scaled by 0.1 m/s, 0.1 rad, 5 rad/s, and "
        "0.1 rad, 10 rad/s of the wing's pitch", above=0, default="0.02"),
    Key("angle", "number", "bound: largest change of the mean of a command from flap to flap, of an angle", above=0,
        unit="deg", default="0.1"),
    Key("relative", "number", "the same of a relative command (amplitude)", above=0, default="0.002"),
    Key("out", "path", "case file to write: their mean commands folded into the motion, their mean flap prescribed as "
        "the first one, the controller about both")])


def add_arguments(parser):
    parser.add_argument("words", nargs="+", metavar="RUN | key:=value",
                        help="folder of the run; as flaps:=5 out:=periodic.yaml")
    parser.epilog = KEYS.help()


def run(arguments):
    from monarch_flight.settling import settle  # after --help: numpy takes its time
    return settle.main(arguments.words)
