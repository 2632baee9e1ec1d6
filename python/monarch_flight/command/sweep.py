"""Flies a case over a parameter of the insect, several flights at once, and writes one table.

Each flight is a job of Snakemake (config/sweep.smk): a sweep that was interrupted goes on where it was when the
same command is given again, and options behind -- take it to a cluster (-- --profile my_cluster). The table,
out/table.csv, has a row for each flight, also for those that failed."""
import os
import re
import shlex
import shutil
import sys

from monarch_flight import case_files, keys, places, preparing
from monarch_flight.keys import Key, Table

SECTIONS = ("fly", "figures", "sweep")
TAKES_OTHERS = True  # behind --: Snakemake's
PASSED_ON = ("fluid", "grid", "flaps", "steps_per_flap")
OVER = "wing/mass=3.535e-5,3.58e-5,3.625e-5,3.675e-5,3.725e-5"


def table():
    return Table([
        Key("case", "case", "a name in config/cases or the path of a case file", default="climb"),
        Key("over", "text", "key of the case below insect, with its values", default=OVER),
        *(keys.run_keys()[name] for name in PASSED_ON),
        Key("out", "path", "folder of the runs", default="flights/sweep"),
        Key("jobs", "count", "flights at once", from_=1, default="the number of processors")])


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="key:=value [-- Snakemake's options]")
    parser.add_argument("--table", nargs="+", metavar=("CSV", "SUMMARY"), help="only write the table of these flights")
    parser.epilog = table().help()


def values_from(words):
    values, _, faults = table().read(words)
    over = values.setdefault("over", OVER)
    if not re.fullmatch(r"[a-z_0-9/]+=[-+.0-9eE]+(,[-+.0-9eE]+)*", over):
        faults.append(f"over:={over}: must be key/below/insect=value,value,...; as wing/kappa=1e-4,1.5e-4")
    case = values.setdefault("case", "climb")
    if not os.path.isfile(case_files.path_of(case)):
        faults.append(f"case:={case}: neither a shipped case nor a file" + keys.nearest(case, case_files.shipped()))
    if faults:
        raise keys.Refused(*faults)
    return values


def run(arguments):
    if arguments.table:
        from monarch_flight.runs import sweep
        return sweep.write_table(arguments.table[0], arguments.table[1:])
    values = values_from(arguments.words)
    preparing.ready(*SECTIONS)
    base = dict(os.environ, PATH="/usr/bin:" + os.environ["PATH"])  # Snakemake is the system's
    if not shutil.which("snakemake", path=base["PATH"]):
        sys.exit("sweep: there is no snakemake; install it (Debian's package snakemake, or scripts/install sweep)")
    from monarch_flight.runs import sweep
    out = places.person_path(values.get("out", places.flights() / "sweep"))
    out.mkdir(parents=True, exist_ok=True)
    sweep.write_cases(case_files.path_of(values["case"]), values["over"], out)
    options = "".join(f" {name}:={values[name]}" for name in PASSED_ON if name in values)
    command = ["snakemake", "--snakefile", places.config() / "sweep.smk", "--directory", out,
               "--cores", values.get("jobs", os.cpu_count()), "--rerun-incomplete", "--keep-going", "--nolock",
               "--quiet", "rules",
               "--config", "monarch=" + shlex.join(places.monarch()), "options=" + options, *arguments.others]
    preparing.must(command, env=dict(base, MONARCH_AS_BUILT="1"))  # built above, once for all
    return 0
