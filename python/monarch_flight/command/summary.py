"""Prints the summary of a run; the exit code is 0 only for a complete run."""
import os

from monarch_flight.keys import Refused
from monarch_flight.runs import summary


def add_arguments(parser):
    parser.add_argument("folder", help="results of a run, as flights/climb-...")


def run(arguments):
    if not os.path.isdir(arguments.folder):
        raise Refused(summary.load(arguments.folder)[1])
    return summary.show(arguments.folder)
