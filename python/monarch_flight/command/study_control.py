"""Studies how well a controller holds a case's insect in quasi-steady air (docs/guidance.md).

Compiles the core and the study without ROS into build_verify/ and prints a line a flight. Minutes."""
from monarch_flight import preparing
from monarch_flight.runs.programs import called_with_case

# Read and checked by the compiled program study_control, which knows them.
KEYS = """\
keys (key:=value):
  study  hold, starts, gust or steps; of a law that holds a heading also turn, sides, cross_gust or damage
         (wings:=independent); default: all of them
  fly    flaps of the flight that holds; default 200
  those of monarch trim control:=true, for a case without a controller of its own: one is designed first"""


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="CASE | key:=value", help="as climb_trimmed study:=starts")
    parser.epilog = KEYS


def run(arguments):
    preparing.source_only("study-control")
    preparing.installed("fly")
    return called_with_case(preparing.core_built("study_control", "study-control"), arguments.words)
