"""The picture of an identification: each angle as measured and as flown over the flap, and their difference."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

COLOURS = ("tab:green", "tab:orange", "tab:blue", "tab:red", "tab:purple")


def by_flap(comparison):
    """Rows of each flap: phase in it from 0 to 1, and the rows."""
    numbers = np.ceil(comparison.phase - 1e-9).astype(int)
    for flap in np.unique(numbers):
        rows = np.flatnonzero(numbers == flap)
        yield flap, comparison.phase[rows] - (flap - 1), rows


def draw(study, found, path):
    n = len(study.measured)
    with plt.rc_context({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "savefig.dpi": 160}):
        figure, axes = plt.subplots(2, n, figsize=(7 if n == 1 else 5.5 * n, 5.6), sharex=True, constrained_layout=True, squeeze=False,
                                    gridspec_kw=dict(height_ratios=(2, 1)))
        for i, (measured, above, below) in enumerate(zip(study.measured, *axes)):
            draw_angle(measured, [(one.stage.name, one.comparisons.angles[i]) for one in found], above, below)
        figure.savefig(path)
        plt.close(figure)


def draw_angle(measured, stages, above, below):
    """`stages`: name and Comparison of each."""
    for _, phase, rows in by_flap(stages[-1][1]):
        above.plot(phase, stages[-1][1].measured[rows], color="black", lw=1.8)
    above.plot([], [], color="black", lw=1.8, label=f"measured ({measured.source})")
    for (name, comparison), colour in zip(stages, COLOURS[-len(stages):] if len(stages) > len(COLOURS) else COLOURS):
        curves(name, comparison, above, below, colour)
    below.axhline(0, color="black", lw=0.8)
    above.set(ylabel=f"{measured.angle} [deg]", xlim=(0, 1))
    below.set(ylabel="flown less measured [deg]", xlabel="t/T in the flap")
    above.legend(fontsize=8)


def curves(name, comparison, above, below, colour):
    for n, (_, phase, rows) in enumerate(by_flap(comparison)):
        style = dict(color=colour, lw=1.4, alpha=1.0 if n == 0 else 0.6)
        above.plot(phase, comparison.flown[rows], label=f"{name}: rms {comparison.rms:.1f} deg" if n == 0 else None, **style)
        below.plot(phase, comparison.residuals[rows], **style)
