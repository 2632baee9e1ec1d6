"""Error against cost beside OpenFOAM: a heaving and a flapping plate on grids of the same cells, both codes (monarch bench
accuracy, docs/performance.md)."""
import json
import os
import re
import shutil
import statistics

import numpy as np

from monarch_flight.trials import bench, equal_error

PLATES = ("heaving", "flapping")
GRIDS = (8, 12, 16, 20)  # cells a chord, both codes
FINER = (24, 32, 40)     # ours alone, for its limit: even so cheaper than the other's finest
PERIOD, END, WINDOW = 1.0, 0.5, (0.1, 0.5)  # as in bench/plate.cpp; loads are taken over the window
STEPS = 10               # a period, for each cell of a chord: the time step shrinks with the cells
HISTORY = 40             # points a period at which histories are compared: times of every grid's steps
QUANTITIES = ("mean", "peak", "history")
BAR, AIM = 100, 200      # their computing time by ours at equal error


def steps_of(grid):
    return round(END / PERIOD * STEPS * grid)


def peak(force):
    """Largest force in the direction of the stroke, of the parabola through the largest value and its neighbours."""
    f = np.asarray(force)
    i = int(np.argmax(f))
    if not 0 < i < len(f) - 1:
        return float(f[i])
    return float(f[i] - 0.125 * (f[i + 1] - f[i - 1]) ** 2 / (f[i - 1] - 2 * f[i] + f[i + 1]))


def loads(time, force):
    """Mean, peak and history of the normal force over the window."""
    time, force = np.asarray(time), np.asarray(force)
    shown = (time > WINDOW[0] - 1e-6) & (time < WINDOW[1] + 1e-6)
    t, f = time[shown], force[shown]
    points = np.linspace(*WINDOW, round((WINDOW[1] - WINDOW[0]) * HISTORY) + 1)
    mean = np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(t)) / (t[-1] - t[0])
    return {"mean": float(abs(mean)), "peak": peak(f), "history": [float(value) for value in np.interp(points, t, f)]}


def ours(plate, grid, repeats):
    """A run of our solver: the median computing time of some, whose loads are the same."""
    told = [json.loads(bench.run([bench.program("plate"), plate, str(grid), str(steps_of(grid))])) for _ in range(repeats)]
    return {"grid": grid, "cells": told[0]["cells"], "steps": steps_of(grid), "cpu_s": statistics.median(one["cpu_s"] for one in told),
            "setup_s": statistics.median(one["setup_s"] for one in told), "courant": told[0]["courant"], **loads(told[0]["t"], told[0]["force"])}


def numbers(path):
    """Rows of numbers of a table of OpenFOAM, brackets and comments left out."""
    with open(path, encoding="utf-8") as file:
        rows = [[float(word) for word in re.sub("[()]", " ", line).split()] for line in file if not line.startswith("#")]
    return np.array([row for row in rows if len(row) > 1])


def normal_force(case):
    """Times and normal force, wing axes, of a case that ran."""
    force = numbers(os.path.join(case, "postProcessing", "forces", "0", "force.dat"))
    motion = numbers(os.path.join(case, "constant", "motion.dat"))
    a, b = (np.radians(np.interp(force[:, 0], motion[:, 0], motion[:, column])) for column in (4, 5))
    normal = np.column_stack([np.sin(b), -np.sin(a) * np.cos(b), np.cos(a) * np.cos(b)])  # R e_z of R = Rx(a) Ry(b) Rz(c)
    return force[:, 0], np.sum(force[:, 1:4] * normal, axis=1)


def refuse_stopped_solves(log, fv_solution, where):
    """Fails where a pressure solve used all the iterations that it may: its result would not be solved to the tolerance."""
    most = int(re.search(r"\bmaxIter\s+(\d+);", fv_solution).group(1))
    taken = [int(count) for count in re.findall(r"Solving for p\w*,.* No Iterations (\d+)", log)]
    if not taken:
        bench.fail("%s: the log of OpenFOAM shows no pressure solve" % where)
    stopped = sum(count >= most for count in taken)
    if stopped:
        bench.fail("%s: %d of %d pressure solves of OpenFOAM stopped at the limit of %d iterations, so the pressure is not "
                   "solved; raise maxIter in bench/openfoam_plate/system/fvSolution" % (where, stopped, len(taken), most))


def theirs(plate, grid, out):
    """A run of OpenFOAM on the same cells, with the same steps."""
    case = os.path.join(out, "openfoam_%s_%d" % (plate, grid))
    shutil.rmtree(case, ignore_errors=True)
    for folder in ("openfoam", "openfoam_plate"):  # the second holds what differs
        shutil.copytree(os.path.join(bench.ROOT, "bench", folder), case, dirs_exist_ok=True)
    os.makedirs(os.path.join(case, "constant", "polyMesh"))
    told = json.loads(bench.run([bench.program("plate"), plate, str(grid), str(steps_of(grid)), case]))
    bench.set_entry(case, "deltaT", told["dt"])
    bench.set_entry(case, "endTime", END)
    bench.set_entry(case, "nu", told["nu"], "constant/transportProperties")
    log = bench.foam(case, "pimpleFoam")
    with open(os.path.join(case, "system", "fvSolution"), encoding="utf-8") as file:
        refuse_stopped_solves(log, file.read(), case)
    return {"grid": grid, "cells": told["cells"], "steps": steps_of(grid), **loads(*normal_force(case)),
            "cpu_s": float(re.findall(r"ExecutionTime = (\S+) s", log)[-1])}


def limits_of(runs, assumed=None):
    """{quantity: {"ours": (limit, order), "theirs": ...}}, each code's by its own grids alone. `assumed`: of equal_error.limit."""
    return {quantity: {code: equal_error.limit([1 / run["grid"] for run in every], [run[quantity] for run in every], assumed)
                       for code, every in runs.items()} for quantity in QUANTITIES}


def beside(runs, quantity, limits, scale):
    """What both codes' runs say of a quantity, given the limit of each: errors, how far the limits lie apart, and the ratios
    of computing times at equal error, from each code's own limit and from the mean of both. Errors are divided by `scale`."""
    common, lines = 0.5 * (limits["ours"] + limits["theirs"]), {}
    for code, every in runs.items():
        lines[code] = {"cpu_s": [run["cpu_s"] for run in every],
                       **{kind: equal_error.errors([run[quantity] for run in every], reference, scale)
                          for kind, reference in (("own", limits[code]), ("common", common))}}
    return {"lines": lines, "limits": {code: value.tolist() for code, value in limits.items()},
            "limits_apart": equal_error.errors([limits["theirs"]], limits["ours"], scale)[0],
            "ratios": {kind: equal_error.ratios(*[(lines[code]["cpu_s"], lines[code][kind]) for code in ("theirs", "ours")])
                       for kind in ("own", "common")}}


def compared(runs):
    """What the runs of a plate, {"ours": [...], "theirs": [...]}, say of mean, peak and history. Errors are divided by the
    root mean square of the force. Where a code shows no order, "assumed" has the same for each of the orders to try."""
    found, first = {}, limits_of(runs)
    tried = {order: limits_of(runs, order) for order in equal_error.ASSUMED}
    scale = equal_error.size(first["history"]["ours"][0])

    def by(limits, quantity):
        return beside(runs, quantity, {code: value for code, (value, _) in limits[quantity].items()}, scale)

    for quantity, limits in first.items():
        orders = {code: order for code, (_, order) in limits.items()}
        known = all(equal_error.observed(order) for order in orders.values())
        found[quantity] = {"orders": orders, **by(first, quantity),
                           "assumed": [] if known else [{"order": order, **by(every, quantity)} for order, every in tried.items()]}
    return found


def save(path, told):
    with open(path + ".active", "w", encoding="utf-8") as file:
        json.dump(told, file, indent=1)
    os.replace(path + ".active", path)


def measure(table, out):
    """Runs both codes; rows of bench.json, and everything in accuracy.json."""
    path = os.path.join(out, "accuracy.json")
    told = {"processor": bench.processor(), "runs": {}, "compared": {}}
    for plate in PLATES:
        told["runs"][plate] = {"ours": [ours(plate, grid, 3) for grid in GRIDS] + [ours(plate, grid, 1) for grid in FINER], "theirs": []}
    for grid in GRIDS:
        for plate, runs in told["runs"].items():
            runs["theirs"].append(theirs(plate, grid, out))
            save(path, told)
    for plate, runs in told["runs"].items():
        found = told["compared"][plate] = compared(runs)
        rows(table, plate, found)
    save(path, told)
    return told


def rows(table, plate, found):
    """Where an order is assumed, the ratio is the least of those tried, and meets no bar: it is not known."""
    for quantity, one in found.items():
        name = "accuracy_%s_%s" % (plate, quantity)
        table.add(name + "_limits_apart", one["limits_apart"], "")
        error, ratio, bound = min((every["ratios"]["own"][-1] for every in [one, *one["assumed"]]), key=lambda at: at[1])
        table.add(name + "_error", error, "")
        table.add(name + "_cost_ratio", ratio, "", BAR, at_least=True, bound=bound, doubt="an order is assumed" if one["assumed"] else "")
