"""Breaks flights in every way that docs/reliability.md names, and says what came of it.

Every fault strikes short flights over nodes at random moments (fixed seed). Expected each time: the run ends by
itself within the limit and names the cause, or is not harmed; monarch fly resume:= then completes it, bit for bit
the flight that nobody disturbed, and no more steps have to be flown again than lie between two checkpoints. The
exit code is 0 when all of that held."""
import os
import time

from monarch_flight import keys, places, preparing


def add_arguments(parser):
    parser.add_argument("--times", type=int, default=20, help="random moments of each fault; default 20")
    parser.add_argument("--only", nargs="+", default=[], metavar="WORD",
                        help="faults whose names hold one of these words")
    parser.add_argument("--seed", type=int, default=1, help="of the random moments; default 1")
    parser.add_argument("--out", help="a new folder for table.md, results.json and failed flights; default "
                        "flights/break_it-<time>")


def run(arguments):
    preparing.source_only("break-it")
    from monarch_flight.trials import break_it, faults
    chosen = [f for f in faults.FAULTS if not arguments.only or any(word in f.name for word in arguments.only)]
    if not chosen:
        raise keys.Refused("--only: no such fault; there are: " + ", ".join(f.name for f in faults.FAULTS))
    preparing.ready("fly")
    out = arguments.out or places.flights() / time.strftime("break_it-%Y%m%d-%H%M%S")
    os.makedirs(out)
    return break_it.break_flights(chosen, arguments.times, arguments.seed, str(out))
