"""Error against cost of two codes on the plates of monarch bench accuracy."""
from matplotlib import pyplot as plt

from monarch_flight.figures.style import GREY, OURS, THEIRS

TITLES = {"mean": "mean of the normal force", "peak": "its peak", "history": "its history"}
CODES = {"theirs": ("OpenFOAM", THEIRS), "ours": ("monarch_flight", OURS)}
KINDS = {"own": dict(marker="o", ms=4, ls="-"), "common": dict(marker="o", ms=3, ls=":", lw=1.1, mfc="white")}


def panel(axes, found):
    for code, (name, colour) in CODES.items():
        line = found["lines"][code]
        for kind, style in KINDS.items():
            label = name if kind == "own" else f"{name}, against the mean of both limits"
            axes.plot(line["cpu_s"], line[kind], color=colour, label=label, **style)
    axes.axhline(found["limits_apart"], color=GREY, ls="--", lw=1, label="the two limits apart")
    axes.set(xscale="log", yscale="log")


def draw(told, path):
    """`told`: accuracy.json."""
    plates = told["compared"]
    figure, grid = plt.subplots(len(plates), len(TITLES), figsize=(10, 3 * len(plates) + 0.6), sharex=True, sharey=True,
                                squeeze=False)
    for row, (plate, found) in zip(grid, plates.items()):
        for axes, (quantity, title) in zip(row, TITLES.items()):
            panel(axes, found[quantity])
            axes.set_title(f"{plate} plate: {title}")
        row[0].set_ylabel("error")
    for axes in grid[-1]:
        axes.set_xlabel("computing time of one core [s]")
    figure.legend(*grid[0][0].get_legend_handles_labels(), loc="lower center", ncol=3)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)
