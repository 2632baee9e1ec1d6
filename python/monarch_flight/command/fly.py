"""Flies a case and prints its summary; in the source tree it first installs what is missing, and builds.

The exit code is 0 only for a complete flight; 1: it failed, 2: it was refused, 130: it was stopped (Ctrl-C,
SIGTERM, the end of the terminal)."""
from monarch_flight import keys, preparing, telling
from monarch_flight.runs import reporting
from monarch_flight.runs import request as requests
from monarch_flight.runs.watched import Stop

EXAMPLE = "fluid:=quasi_steady flaps:=6"


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="key:=value", help="as " + EXAMPLE)
    parser.epilog = keys.run_keys().of("fly").help()


def sections(request):
    """Of scripts/packages.txt."""
    wanted = ["fly"]
    wanted += ["fields"] if int(request.values.get("fields_every", 0)) else []
    return wanted + (["view", "panel"] if request.true("rviz") else [])


def fly(words):
    request = requests.request(words)
    stop = Stop()
    try:
        preparing.ready(*sections(request))
        if reporting.wanted(request):
            preparing.tried("report")
        request.begin()
        from monarch_flight.runs import flight
        return flight.fly(request, stop, telling.called_as("fly"))
    except SystemExit as end:  # of a script that was stopped, too
        raise KeyboardInterrupt if stop.heard else end
    finally:
        stop.end()


def run(arguments):
    return fly(arguments.words)
