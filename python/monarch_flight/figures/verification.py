"""Draws the curves of a verification (curves.json) as small PNG files."""
import json
import os
from collections import defaultdict

from matplotlib import pyplot as plt

from monarch_flight.figures import style  # noqa: F401 (sets how all figures look)


def draw(name, curves, folder):
    many = len(curves) > 8
    figure, axes = plt.subplots(figsize=(7, 4.2) if many else (5, 3.6), dpi=90)
    for curve in curves:
        marker = "o-" if len(curve["x"]) < 8 else "-"
        axes.plot(curve["x"], curve["y"], marker, markersize=3, linewidth=1, label=curve["label"])
    first = curves[0]
    if first["logarithmic"]:
        axes.set_xscale("log", base=2)
        axes.set_yscale("log")
        x = sorted({value for curve in curves for value in curve["x"]})
        axes.set_xticks(x, ["%g" % value for value in x])
        top = max(value for curve in curves for value in curve["y"])
        for order, style in ((1, ":"), (2, "--")):
            axes.plot(x, [top * (x[0] / value) ** order for value in x], "k" + style, linewidth=0.8,
                      label="order %d" % order)
    axes.set_xlabel(first["x_label"])
    axes.set_ylabel(first["y_label"])
    axes.legend(fontsize=6, **({"loc": "upper left", "bbox_to_anchor": (1.01, 1)} if many else {}))
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "verify_%s.png" % name.replace(" ", "_")), metadata={"Software": None})
    plt.close(figure)


def draw_all(folder, images):
    """The curves.json of a folder, into PNG files of another."""
    with open(os.path.join(folder, "curves.json"), encoding="utf-8") as f:
        plots = defaultdict(list)
        for curve in json.load(f):
            plots[curve["plot"]].append(curve)
    os.makedirs(images, exist_ok=True)
    for name, curves in plots.items():
        draw(name, curves, images)
