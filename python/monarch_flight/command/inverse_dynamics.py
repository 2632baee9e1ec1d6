"""What a flown motion needs besides air and gravity, and which spring comes nearest to it.

Takes motion and air loads of a flight (RUN/flight.csv) and computes the torques of the joints, and the force and
moment on the body, that this motion needs; fits spring and damper to the torque about the pitch axis of the wing.
Writes RUN/inverse_dynamics.csv (docs/run_files.md)."""
from monarch_flight import keys, places, preparing
from monarch_flight.keys import Key, Table
from monarch_flight.runs.programs import called

KEYS = Table([Key("from", "number", "first flap", default="0"),
              Key("to", "number", "last flap", default="the last one")])


def add_arguments(parser):
    parser.add_argument("run", metavar="RUN", help="folder of a flight, as flights/measured")
    parser.add_argument("words", nargs="*", metavar="key:=value", help="as from:=2")
    parser.epilog = KEYS.help()


def run(arguments):
    _, _, faults = KEYS.read(arguments.words)
    if faults:
        raise keys.Refused(*faults)
    preparing.installed("fly")
    preparing.built("--programs")
    return called(places.program("inverse_dynamics"), ["run:=" + arguments.run, *arguments.words])
