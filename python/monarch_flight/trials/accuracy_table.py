"""The runs of accuracy.json as the table and the picture of docs/performance.md."""
import json
import os

from monarch_flight.trials import accuracy
from monarch_flight.trials.bench_table import parts, table

BEGIN = "<!-- error against cost, made from accuracy.json by: monarch bench accuracy --document FILE -->\n"
END = "<!-- end of error against cost -->\n"
BOUNDS = {"": "", ">=": "> ", "<=": "< "}


def percent(value):
    return f"{100 * value:.2g} %"


def ratio_list(ratios, floor=0):
    """Ratios at the errors of the other's runs; none where the error is below what can be told."""
    return ", ".join("-" if error < floor else BOUNDS[bound] + (f"{ratio:.2g}" if ratio < 10 else f"{ratio:.0f}")
                     for error, ratio, bound in ratios)


def runs_table(runs):
    """Grids, steps and computing times of both codes."""
    rows = []
    for plate, codes in runs.items():
        times = {code: {run["grid"]: run for run in every} for code, every in codes.items()}
        for grid in accuracy.GRIDS:
            ours, theirs = times["ours"][grid], times["theirs"][grid]
            rows.append([plate, str(grid), f"{ours['cells'] / 1e6:.3f} M, {ours['steps']}", f"{theirs['cpu_s']:.4g}",
                         f"{ours['cpu_s']:.3g}", f"{theirs['cpu_s'] / ours['cpu_s']:.0f}"])
    return table(["plate", "cells a chord", "cells, steps", "OpenFOAM, s", "ours, s", "on the same grid"], rows)


def errors_table(runs):
    rows = []
    for plate, codes in runs.items():
        for quantity, one in accuracy.compared(codes).items():
            lines = [one["lines"][code]["own"][:len(accuracy.GRIDS)] for code in ("theirs", "ours")]
            orders = ["none" if one["orders"][code] is None else f"{one['orders'][code]:.1f}" for code in ("theirs", "ours")]
            rows.append([f"{plate}, {quantity}", ", ".join(f"{percent(line[0])} to {percent(line[-1])}" for line in lines),
                         ", ".join(orders), percent(one["limits_apart"]), ratio_list(one["ratios"]["own"]),
                         ratio_list(one["ratios"]["common"], 0.5 * one["limits_apart"])])
    return table(["normal force", "error, 8 to 20 cells: OpenFOAM, ours", "order", "limits apart",
                  "OpenFOAM by ours at equal error, own limits", "the same, mean of both limits"], rows)


def figures(told):
    return f"Processor: {told['processor']}, one core each.\n\n" + runs_table(told["runs"]) + "\n" + errors_table(told["runs"])


def renew(document, folder):
    """Table and picture of a document from the accuracy.json of a folder."""
    from monarch_flight.figures import error_against_cost
    with open(os.path.join(folder, "accuracy.json"), encoding="utf-8") as file:
        told = json.load(file)
    head, _, tail = parts(document, BEGIN, END)
    with open(document, "w", encoding="utf-8") as file:
        file.write(head + BEGIN + figures(told) + END + tail)
    told["compared"] = {plate: accuracy.compared(runs) for plate, runs in told["runs"].items()}
    error_against_cost.draw(told, os.path.join(os.path.dirname(os.path.abspath(document)), "images", "bench_accuracy.png"))
