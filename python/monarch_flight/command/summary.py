"""Prints the summary of a run; the exit code is 0 only for a complete run."""
from monarch_flight.runs import summary


def add_arguments(parser):
    parser.add_argument("folder", help="results of a run, as flights/climb-...")


def run(arguments):
    return summary.show(arguments.folder)
