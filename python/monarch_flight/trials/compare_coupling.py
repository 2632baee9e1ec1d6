"""The same Navier-Stokes flight with every coupling strategy, and one table (docs/coupling.md)."""
import concurrent.futures
import csv
import json
import os
import statistics
import subprocess
import sys

import yaml

from monarch_flight import case_files, places, preparing

COLUMNS = ("wing [mg]", "ratio", "steps/flap", "strategy", "mean", "max", "air/step", "retried",
           "growth", "steps", "wall/step [s]", "end")
COARSE = {"level": "custom", "cells_per_chord": 8, "first_cell": 0.06, "growth_plane": 1.3,
          "growth_normal": 1.3, "far_field": 6, "margin": 0.25, "outer": "rest", "courant_limit": 3}
BARS = {"mean": 2.5, "max": 5, "air": 2.2}


def case_file(keys, mass, strategy, path):
    """The case with another wing mass and strategy; pictures and bag off."""
    case = case_files.read(case_files.path_of(keys["case"]))
    case["insect"].setdefault("wing", {})["mass"] = float(mass) * 1e-6
    coupling = case.setdefault("coupling", {})
    coupling["relaxation"] = "constant" if strategy == "plain" else strategy
    if strategy == "plain":
        coupling["omega_initial"] = 1.0
    if keys["grid"] == "coarse":
        case.setdefault("grid", {}).update(COARSE)
    case["output"] = {"record": False, "surface_every": 0, "flow_every": 0}
    with open(path, "w") as f:
        yaml.safe_dump(case, f)


def fly(keys, mass, steps, strategy):
    """Flies once; returns (mass, steps per flap, strategy, summary or None)."""
    name = "%s-%s-%s" % (mass, steps, strategy)
    case, out = (os.path.join(keys["out"], name + end) for end in (".yaml", ""))
    case_file(keys, mass, strategy, case)
    command = [places.program("fly_in_process"), "case:=" + case, "out:=" + out, "record:=false"]
    given = ("fluid", "flaps") if keys["grid"] == "coarse" else ("fluid", "grid", "flaps")
    command += ["%s:=%s" % (key, keys[key]) for key in given] + ["steps_per_flap:=" + steps]
    with open(os.path.join(keys["out"], name + ".log"), "w") as log:
        subprocess.run(command, stdout=log, stderr=log, env=preparing.one_threaded())
    try:
        with open(os.path.join(out, "summary.json")) as f:
            return mass, steps, strategy, json.load(f)
    except OSError:
        sys.exit("compare-coupling: %s was not flown; see %s.log in %s" % (name, name, keys["out"]))


def growth(folder):
    """Median growth of the residual from one sub-iteration to the next, of first attempts, as text."""
    rows = {}
    with open(os.path.join(folder, "iterations.csv")) as f:
        for r in csv.DictReader(f):
            if r["attempt"] == "1":
                largest = max(abs(float(v)) for key, v in r.items() if key.startswith("residual"))
                rows.setdefault(r["step"], []).append(largest)
    factors = [b / a for v in rows.values() for a, b in zip(v[2:], v[3:]) if a > 0]
    return "%.2f" % statistics.median(factors) if factors else "-"


def row(keys, mass, steps, strategy, s):
    failed = s["status"] != "complete"
    solved = s["sub_iterations"] if s["fluid_evaluations"]["max"] else None  # else none but prescribed steps
    return (mass, "%.2f" % s["added_mass_ratio"]["max"], steps, strategy,
            "%.2f" % solved["mean"] if solved else "-", str(solved["max"]) if solved else "-",
            "%.2f" % s["fluid_evaluations"]["mean"] if solved else "-", str(s["retried_steps"]),
            growth(os.path.join(keys["out"], "%s-%s-%s" % (mass, steps, strategy))), str(s["steps"]),
            "%.3f" % (s["wall_s"]["total"] / max(1, s["steps"])),
            "ended in step %d" % (s["steps"] + 1) if failed else "complete")


def meets_bars(s):
    return (s["status"] == "complete" and s["retried_steps"] == 0
            and s["sub_iterations"]["mean"] <= BARS["mean"] and s["sub_iterations"]["max"] <= BARS["max"]
            and s["fluid_evaluations"]["mean"] <= BARS["air"])


def compare(keys):
    """Exit code: whether every flight with added_mass meets the bars."""
    os.makedirs(keys["out"], exist_ok=True)
    plans = [(m, s, name) for m in keys["masses"].split(",") for s in keys["steps_per_flap"].split(",")
             for name in keys["strategies"].split(",")]
    lines = ["| %s |" % " | ".join(COLUMNS), "|%s" % ("---|" * len(COLUMNS))]
    print("\n".join(lines), flush=True)
    failures, good = [], True
    with concurrent.futures.ThreadPoolExecutor(int(float(keys["jobs"]))) as pool:
        for mass, steps, strategy, s in pool.map(lambda plan: fly(keys, *plan), plans):
            lines.append("| %s |" % " | ".join(row(keys, mass, steps, strategy, s)))
            print(lines[-1], flush=True)
            if s["failure"]:
                failures.append("%s mg, %s steps a flap, %s: %s" % (mass, steps, strategy, s["failure"]))
            good = good and (strategy != "added_mass" or meets_bars(s))
    with open(os.path.join(keys["out"], "table.md"), "w") as f:
        f.write("\n".join(lines + [""] + failures) + "\n")
    print("\n".join([""] + failures))
    if not good:
        print("compare-coupling: added_mass misses a bar (%s)" % BARS, file=sys.stderr)
    return 0 if good else 1
