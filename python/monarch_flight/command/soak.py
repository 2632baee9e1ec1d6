"""A long flight in quasi-steady air under watch: memory, descriptors and computing per step may not grow.

The case hinge (one free wing, always stable) is flown over nodes or in one process; once a second resident memory,
open descriptors and processor time of every process and the steps flown are noted. Compared are medians of the
second and of the last eighth of the run. Exit code 0: nothing grew beyond the limits, which are printed. Wall time
is printed without a limit: it is that of whatever else the machine does, too."""
from monarch_flight import keys, preparing


def add_arguments(parser):
    parser.add_argument("--sub-iterations", type=int, default=1000000, metavar="N",
                        help="at least 20000; default 1000000")
    parser.add_argument("--nodes", action="store_true", help="over nodes instead of in one process")


def run(arguments):
    if arguments.sub_iterations < 20000:
        raise keys.Refused(f"--sub-iterations {arguments.sub_iterations}: must be at least 20000")
    preparing.ready("fly")
    from monarch_flight.trials import soak
    return soak.soak(arguments.sub_iterations, arguments.nodes)
