"""Breaks flights, and writes down what came of it (monarch break-it)."""
import json
import os
import random
import shutil
import tempfile

from monarch_flight.trials.faults import Bench

COLUMNS = ("fault", "times", "as expected", "unharmed", "longest end [s]", "most steps again", "the run said")


def rows_of(name, trials):
    ends = [t["end_s"] for t in trials if t["end_s"] is not None]
    lost = [t["again"] for t in trials if t["again"] is not None]
    said = next((t["said"] for t in trials if t["said"]), "")
    return (name, len(trials), sum(t["good"] for t in trials), sum(t["unharmed"] for t in trials),
            "%.1f" % max(ends) if ends else "", max(lost) if lost else "", said)


def break_flights(chosen, times, seed, out):
    """Exit code: whether every end was as expected."""
    results = {}
    with tempfile.TemporaryDirectory(prefix="break_it_") as work:
        bench = Bench(work, random.Random(seed))
        for fault in chosen:
            trials = results.setdefault(fault.name, [])
            for n in range(times if fault.random else 1):
                trials.append(bench.trial(fault))
                print("%-34s %2d: %s" % (fault.name, n + 1, trials[-1]["verdict"]), flush=True)
                if not trials[-1]["good"]:
                    keep(bench.folder, os.path.join(out, "%s-%d" % (fault.name.replace(" ", "_"), n + 1)))
            write(out, results)
    good = all(t["good"] for trials in results.values() for t in trials)
    print("break-it: %s; results in %s" % ("all as expected" if good else "NOT as expected", out))
    return 0 if good else 1


def keep(folder, into):
    """A flight that did not end as expected, and what it printed."""
    if os.path.isdir(folder):
        shutil.copytree(folder, into)
    shutil.copy(folder + ".txt", into + ".txt")


def write(out, results):
    lines = ["| %s |" % " | ".join(COLUMNS), "|---" * len(COLUMNS) + "|"]
    lines += ["| %s |" % " | ".join(map(str, rows_of(*item))) for item in results.items()]
    with open(os.path.join(out, "table.md"), "w") as f:
        f.write("\n".join(lines) + "\n")
    with open(os.path.join(out, "results.json"), "w") as f:
        json.dump(results, f, indent=1)
