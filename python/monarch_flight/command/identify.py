"""Identifies parameters of a case from a measured angle: the flight that comes nearest to it (docs/identification.md).

The study, a YAML file, names the case, the unknown keys with their ranges, what was measured, and the airs and
grids, coarse to fine. Every flight is kept in the folder `out`: the same command again goes on where it was stopped.
Exit code: 0 found, 1 a flight or the search failed, 2 refused, 130 stopped."""
import os

from monarch_flight import places, preparing
from monarch_flight.keys import Key, Refused, Table

SECTIONS = ("fly", "figures")
KEYS = Table([
    Key("out", "path", "folder of the results; one of an earlier call of the same study goes on", default="flights/<name of the study>"),
    Key("jobs", "count", "flights at once, each on one thread", from_=1, to=1024, default="the number of processors"),
    Key("threads", "count", "threads of a flight that is flown alone; 1 where the machine has other work", from_=1, to=1024,
        default="jobs"),
    Key("most", "count", "most points of the search in each stage, differences apart", from_=1, default="20")])


def add_arguments(parser):
    parser.add_argument("words", nargs="+", metavar="STUDY | key:=value",
                        help="name of a study in config/studies or path of a YAML file; as jobs:=2")
    parser.epilog = KEYS.help()


def settings_from(words):
    """Path of the study, values of the keys. Raises Refused."""
    values, studies, faults = KEYS.read(words, plain=True)
    if len(studies) != 1:
        faults.append(f"{len(studies)} studies given: must be one; as passive_pitch")
    if faults:
        raise Refused(*faults)
    shipped = places.config() / "studies" / f"{studies[0]}.yaml"
    return (shipped if shipped.is_file() else places.person_path(studies[0])), values


def run(arguments):
    path, values = settings_from(arguments.words)
    from monarch_flight.identification import study  # after --help: numpy takes its time
    wanted = study.read(path)
    preparing.ready(*SECTIONS)
    from monarch_flight.identification import identify
    jobs = int(values.get("jobs", os.cpu_count()))
    return identify.identify(wanted, places.person_path(values.get("out", places.flights() / wanted.name)), jobs,
                             int(values.get("threads", jobs)), int(values.get("most", 20)))
