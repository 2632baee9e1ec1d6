"""The runs of accuracy.json as the table and the picture of docs/performance.md."""
import json
import os

from monarch_flight.trials import accuracy, equal_error
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
    return table(["plate", "cells a chord", "cells, steps", "OpenFOAM, s", "ours, s", "OpenFOAM / ours"], rows)


def order_shown(order):
    """An order that counts as not observed has a star."""
    return ("none" if order is None else f"{order:.1f}") + ("" if equal_error.observed(order) else "*")


def errors_table(found):
    rows = []
    for plate, quantities in found.items():
        for quantity, one in quantities.items():
            lines = [one["lines"][code]["own"][:len(accuracy.GRIDS)] for code in ("theirs", "ours")]
            orders, star = [order_shown(one["orders"][code]) for code in ("theirs", "ours")], "*" if one["assumed"] else ""
            rows.append([f"{plate}, {quantity}", ", ".join(f"{percent(line[0])} to {percent(line[-1])}" for line in lines),
                         ", ".join(orders), percent(one["limits_apart"]) + star,
                         ratio_list(one["ratios"]["own"]) + star, ratio_list(one["ratios"]["common"], 0.5 * one["limits_apart"]) + star])
    return table(["normal force", "error, 8 to 20 cells: OpenFOAM, ours", "order: OpenFOAM, ours", "limits apart",
                  "computing time, OpenFOAM / ours: own limits", "the same: mean of both limits"], rows)


def assumed_table(found):
    """What the figures with a star are for other orders, at the error of the other's finest run."""
    rows = []
    for plate, quantities in found.items():
        for quantity, one in quantities.items():
            if not one["assumed"]:
                continue
            codes = [name for code, name in (("theirs", "OpenFOAM"), ("ours", "ours")) if not equal_error.observed(one["orders"][code])]
            cells = [(percent(every["ratios"]["own"][-1][0]), percent(every["limits_apart"]), ratio_list(every["ratios"]["own"][-1:]),
                      ratio_list(every["ratios"]["common"][-1:], 0.5 * every["limits_apart"])) for every in one["assumed"]]
            rows.append([f"{plate}, {quantity}", " and ".join(codes), *[", ".join(column) for column in zip(*cells)]])
    orders = ", ".join(f"{order:g}" for order in equal_error.ASSUMED)
    return "" if not rows else (f"\n\\* No order observed. With order {orders} instead, at OpenFOAM's finest run:\n\n" + table(
        ["normal force", "order assumed for", "its error", "limits apart", "computing time, OpenFOAM / ours: own limits",
         "the same: mean of both limits"], rows))


def figures(told):
    found = {plate: accuracy.compared(runs) for plate, runs in told["runs"].items()}
    return (f"Processor: {told['processor']}, one core each.\n\n" + runs_table(told["runs"]) + "\n" + errors_table(found)
            + assumed_table(found))


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
