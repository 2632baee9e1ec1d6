"""The paper's figures 2, 4 to 9, those of docs/dynamics.md and of controlled flights; each function returns a matplotlib
figure, or several by their names."""
import json
import math

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from monarch_flight import places
from monarch_flight.figures import data
from monarch_flight.figures.control import air, figure_control
from monarch_flight.figures.style import FAINT, GREY, MEASURED, OURS, THEIRS, THIRD
from monarch_flight.measured import marker_reduction as reduction

deg = np.degrees
FLU = np.array([1, -1, -1])  # forward, right, down to forward, left, up: what a plot with z up shows unmirrored


def rotation(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array({"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
                     "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis])


def arrows(axes, frame, names, colour, length, lift):
    """Unit vectors from the origin; `lift` moves the names off each other on the picture [points]."""
    for i, name in enumerate(names):
        if not name:
            continue
        tip = length * frame[:, i] * FLU
        axes.quiver(0, 0, 0, *tip, color=colour, lw=1.5, arrow_length_ratio=0.09)
        x, y, _ = proj3d.proj_transform(*(1.04 * tip), axes.get_proj())
        x0, y0, _ = proj3d.proj_transform(0, 0, 0, axes.get_proj())
        away = np.array([x - x0, y - y0]) / max(math.hypot(x - x0, y - y0), 1e-9)
        shift = 9 * away + lift.get(name, (0, 0))
        axes.annotate(name, (x, y), xytext=shift, textcoords="offset points", color=colour, ha="center", va="center", zorder=20,
                      bbox=dict(boxstyle="round,pad=0.08", fc="white", ec="none", alpha=0.8))


B, S, R = ([rf"${frame}_{axis}$" for axis in "xyz"] for frame in "bsr")
S[1] = ""  # that of the body


def figure_2(_):
    """Frames and the right wing's angles, each at 30 deg alone."""
    beta, angle = data.BETA, math.radians(30)
    outline = data.table(places.config() / "insects/monarch_planform.csv")
    x = np.concatenate([outline["leading"], outline["trailing"][::-1]])
    y = np.concatenate([outline["y"], outline["y"][::-1]])
    plate = np.stack([x, y, 0 * x])
    # Names that would lie on others, and where they go instead [points].
    wings = {r"a) flapping $\varphi_R$ = 30°": (rotation("x", angle), {S[0]: (-14, 4), R[0]: (8, -4), R[2]: (10, 0), B[2]: (-4, 0)}),
             r"b) pitch $\theta_R$ = 30°": (rotation("y", angle), {R[1]: (-14, -4), B[1]: (0, 10), B[2]: (-9, 4)}),
             r"c) deviation $\psi_R$ = 30°": (rotation("z", -angle), {S[2]: (-12, 0), R[2]: (12, 0)})}
    figure = plt.figure(figsize=(11.5, 4.4))
    for n, (title, (Q, lift)) in enumerate(wings.items()):
        axes = figure.add_axes((0.333 * n, 0.0, 0.333, 0.9), projection="3d", proj_type="ortho")
        stroke, wing = rotation("y", beta), rotation("y", beta) @ Q
        flat = stroke @ plate
        axes.plot(*(FLU[:, None] * flat), color=GREY, lw=1, ls="--", label="wing with all angles 0")
        axes.add_collection3d(Poly3DCollection([(FLU[:, None] * (wing @ plate)).T], fc=OURS, ec=OURS, alpha=0.22, lw=1.6))
        axes.plot(*(FLU[:, None] * (wing @ plate)), color=OURS, lw=1.6, label="wing")
        s = np.linspace(0, 2 * np.pi, 60)
        axes.plot(1.5 * np.cos(s), 0 * s, 0.4 * np.sin(s), color=GREY, lw=1.2, label="body")
        axes.set(xlim=(-4, 4), ylim=(-7, 1), zlim=(-4, 4))
        axes.set_box_aspect((1, 1, 1), zoom=1.25)
        axes.view_init(elev=35, azim=-125)
        axes.set_axis_off()
        arrows(axes, np.eye(3), B, MEASURED, 2.4, lift)
        arrows(axes, stroke, S, THIRD, 3.4, lift)
        arrows(axes, wing, R, THEIRS, 4.2, lift)
        figure.text(0.333 * n + 0.03, 0.87, title, fontsize=10)
        if n == 0:
            axes.legend(loc="lower left", bbox_to_anchor=(0.05, 0.02))
    figure.suptitle(r"Body axes $b$ (black), stroke axes $s$ at $\beta$ = 25.4° (green), axes $r$ of the right wing (orange); z points down; "
                    "lengths differ only to tell them apart", x=0.03, ha="left", fontsize=9)
    return figure


def last_stroke(flight, frequency):
    steps = int(round(1 / frequency / (flight["t"][1] - flight["t"][0])))
    return {k: v[-steps - 1:] for k, v in flight.items()}, (flight["t"][-steps - 1:] - flight["t"][-steps - 1]) * frequency


def figure_4(settings):
    """Passive pitch and lift of the hinge case: Navier-Stokes beside Whitney and Wood's blade elements."""
    runs = {"Navier-Stokes (preview grid)": ("navier_stokes", OURS, "-"),
            "blade elements (Whitney & Wood)": ("quasi_steady", THEIRS, "--")}
    figure, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7, 6), constrained_layout=True)
    for label, (fluid, colour, line) in runs.items():
        folder = data.run(settings.runs, "hinge", f"fluid:={fluid}", "grid:=preview", "flaps:=6")
        flight, frequency = data.flight(folder), data.case_of(folder)["motion"]["frequency"]
        swing, fundamental, phase, mean, peak = data.strokes(flight, frequency, 3)
        print(f"{label}, strokes 3 to 6: half the swing {deg(swing):.2f} deg, fundamental {deg(fundamental):.2f} deg, "
              f"{phase:.4f} strokes behind the flapping; lift mean {1e3 * mean:.4f} mN, peak {1e3 * peak:.4f} mN")
        flight, t = last_stroke(flight, frequency)
        lift = -1e3 * flight["FZ"]
        top.plot(t, deg(flight["theta_R"]), color=colour, ls=line, label=label)
        bottom.plot(t, lift, color=colour, ls=line, label=f"{label}, mean {lift[:-1].mean():.3f} mN")
    top.plot(t, deg(flight["phi"]), color=GREY, lw=1, label=r"flapping $\varphi$ (prescribed)")
    top.set(ylabel="angle [deg]", title="Hinge case, sixth stroke: a) passive pitch, b) lift")
    bottom.set(xlabel="t/T", ylabel="lift of the wing [mN]", xlim=(0, 1), ylim=(-0.2, 2.4))
    for axes in (top, bottom):
        axes.legend(fontsize=8)
    return figure


def figure_5(_):
    """Markers of the measured flight and the path of the thorax."""
    t, markers = data.markers()
    markers, velocity = reduction.along_flight(t, markers)
    figure = plt.figure(figsize=(12, 4.6))
    axes = figure.add_axes((0.0, 0.0, 0.5, 0.95), projection="3d", proj_type="ortho")
    groups = {"thorax": (["T1", "T2"], "black"), "abdomen": (["A1", "A2"], THIRD),
              "left wing": (["LW1", "LW2", "LW3"], OURS), "right wing": (["RW1", "RW2", "RW3"], THEIRS)}
    origin = 0.5 * (markers["T1"][0] + markers["T2"][0])
    for label, (names, colour) in groups.items():
        for n, frame in enumerate(range(0, len(t), 12)):
            points = 1e2 * np.array([markers[k][frame] - origin for k in names + names[:1]])
            axes.plot(*(points * FLU).T, "o-", color=colour, ms=2.5, lw=0.8,
                      label=label if n == 0 else None)
    axes.set(xlabel="forward [cm]", ylabel="left [cm]", zlabel="up [cm]", title="a) markers, every 60 ms")
    axes.set_box_aspect((3, 1.2, 1.4), zoom=1.15)
    axes.view_init(elev=18, azim=-60)
    axes.legend(fontsize=8)
    path = figure.add_axes((0.6, 0.12, 0.38, 0.8))
    columns = data.measured()["columns"]
    path.plot(1e2 * columns["x"], -1e2 * columns["z"], "o-", color=MEASURED, ms=2.5, lw=0.8, label="thorax, 200 Hz")
    lines = [np.polyval(np.polyfit(t, columns[name], 1), t) for name in ("x", "z")]
    path.plot(1e2 * lines[0], -1e2 * lines[1], color=THEIRS, ls="--",
              label=f"mean: {np.hypot(velocity[0], velocity[2]):.2f} m/s, "
                    f"{deg(np.arctan2(-velocity[2], velocity[0])):.1f}° up")
    path.set(xlabel="forward [cm]", ylabel="up [cm]", title="b) path", aspect="equal")
    path.legend()
    return figure


def figure_6(_):
    """Angles of the measured flight over the stroke, their Fourier fits and the published series."""
    flight, published = data.measured(), data.published()
    names = dict(phi=r"flapping $\varphi$", theta_R=r"wing pitch $\theta_R$", psi=r"deviation $\psi$",
                 theta_B=r"body pitch $\theta_B$", theta_A=r"abdomen $\theta_A$")
    figure, grid = plt.subplots(2, 3, figsize=(11, 6), constrained_layout=True)
    s = np.linspace(0, 1, 200)
    for axes, (name, title) in zip(grid.flat, names.items()):
        series, t = flight["series"][name], flight["columns"]["t"]
        flap = series["frequency"] / (2 if name == "psi" else 1)
        for side, marker in (("L", "<"), ("R", ">")):
            if f"{name}_{side}" in flight["columns"]:
                axes.plot(t * flap % 1, deg(flight["columns"][f"{name}_{side}"]), marker, color=FAINT, ms=3,
                          label={"L": "left wing", "R": "right wing"}[side])
        if f"{name}_L" not in flight["columns"]:
            axes.plot(t * flap % 1, deg(flight["columns"][name]), "o", color=FAINT, ms=3, label="measured")
        axes.plot(s, deg(reduction.evaluate(series, s / flap, series["frequency"])), color=OURS, label="fit (ours)")
        theirs = published[name + "_deg"]
        axes.plot(s, reduction.evaluate(theirs, s, theirs["multiple"]), color=THEIRS, ls="--", label="published series")
        axes.set(title=title, xlabel="t/T", ylabel="angle [deg]", xlim=(0, 1))
        axes.legend(fontsize=7)
    grid.flat[-1].axis("off")
    return figure


MASSES = [35.35e-6, 35.8e-6, 36.25e-6, 36.75e-6, 37.25e-6]  # of a wing, the range of the paper [kg]


def flight_options(settings):
    return [f"fluid:={settings.fluid}", f"flaps:={settings.flaps}"] + ["grid:=preview"] * (settings.fluid == "navier_stokes")


def free_runs(settings, masses):
    """{label: run folder}: those given by runs:=, or one flight for each wing mass."""
    if settings.given:
        return {str(folder.name): folder for folder in settings.given}
    return data.sweep(settings.runs, settings.case, masses, *flight_options(settings))


def free_run(settings):
    """Folder of the run: the first one given by runs:=, or a flight of the case as it is."""
    if settings.given:
        return settings.given[0]
    fields = ["fields_every:=250"] * (settings.fluid == "navier_stokes")
    return data.run(settings.runs, settings.case, *flight_options(settings), *fields)


def figure_7(settings):
    """Paths of the free flights over the mass of a wing, and the measured path."""
    figure, axes = plt.subplots(figsize=(9, 4), constrained_layout=True)
    flights = {label: data.flight(folder) for label, folder in free_runs(settings, MASSES).items()}
    gaps = {label: 1e3 * data.distance_to_measured(flight) for label, flight in flights.items()}
    colours = plt.cm.viridis(np.linspace(0, 0.9, len(flights)))
    for (label, flight), colour in zip(flights.items(), colours):
        best = gaps[label] == min(gaps.values())
        axes.plot(1e2 * (flight["x"] - flight["x"][0]), -1e2 * (flight["z"] - flight["z"][0]),
                  label=f"{label}, {gaps[label]:.1f} mm from measured" + " (nearest)" * best,
                  lw=2.2 if best else 1.1, color=THEIRS if best else colour)
    columns = data.measured()["columns"]
    axes.plot(1e2 * columns["x"], -1e2 * columns["z"], color=MEASURED, ls=":", lw=1.8, label="measured (thorax)")
    axes.set(xlabel="forward [cm]", ylabel="up [cm]", aspect="equal", title=f"Path of the body, {settings.title()}")
    axes.legend(fontsize=8, title=("run" if settings.given else "mass of a wing") + ", rms distance over the measured time")
    return figure


def figure_8(settings):
    """Thrust, lift, wing pitch and body pitch of a free flight against the measured ones."""
    folder = free_run(settings)
    flight, case, real = data.flight(folder), data.case_of(folder), data.measured()
    f, insect = case["motion"]["frequency"], case["insect"]
    mass = insect["body"]["mass"] + insect["abdomen"]["mass"] + 2 * insect["wing"]["mass"]
    t, s = flight["t"] * f, real["columns"]["t"] * real["series"]["theta_B"]["frequency"]
    shown = t <= s[-1]
    flight, t = {k: v[shown] for k, v in flight.items()}, t[shown]
    figure, grid = plt.subplots(2, 2, sharex=True, figsize=(11, 6.5), constrained_layout=True)
    ours, theirs = data.body_forces(flight), data.measured_forces(real, mass)
    for axes, title, a, b in zip(grid[0], ("a) thrust", "b) lift"), ours, theirs):
        axes.plot(t[1:], 1e3 * a[1:], color=OURS, label="simulated")
        axes.plot(s, 1e3 * b, color=MEASURED, ls=":", label="measured: mass times (a - g) of the thorax")
        axes.set(title=title + ", body axes", ylabel="force [mN]")
    for axes, title, name in zip(grid[1], (r"c) wing pitch $\theta_R$", r"d) body pitch $\theta_B$"), ("theta_R", "theta_B")):
        axes.plot(t, deg(flight[name]), color=OURS, label="simulated")
        fit = real["series"][name]
        axes.plot(s, deg(real["columns"][name]), "o", color=FAINT, ms=2.5, label="measured")
        axes.plot(s, deg(reduction.evaluate(fit, real["columns"]["t"], fit["frequency"])), color=MEASURED, ls=":",
                  label="measured, Fourier fit")
        axes.set(title=title, ylabel="angle [deg]", xlabel="t/T")
    grid[1, 1].set_xlim(0, min(t[-1], s[-1]))
    for axes in grid.flat:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.3 * (high - low))  # room for the legend
        axes.legend(fontsize=7, loc="upper right")
    figure.suptitle(f"{case['name']}, {air(case)}")
    return figure


def cropped(picture, margin=20):
    """A picture without its white rim."""
    seen = np.argwhere((picture[..., :3] < 0.985).any(axis=2))
    low, high = np.maximum(seen.min(axis=0) - margin, 0), seen.max(axis=0) + margin
    return picture[low[0]:high[0], low[1]:high[1]]


def figure_9(settings):
    """Vortices, wing pressure and flown path at t/T = 0.5 and 3, rendered off screen."""
    folder = free_run(settings)
    pictures = {flap: cropped(plt.imread(data.rendered(folder, flap, settings.out))) for flap in (0.5, 3.0)}
    shares = [picture.shape[1] / picture.shape[0] for picture in pictures.values()]
    figure, panels = plt.subplots(1, 2, figsize=(12, 12 / sum(shares) + 0.35), gridspec_kw=dict(width_ratios=shares),
                                  constrained_layout=True)
    for axes, (flap, picture), name in zip(panels, pictures.items(), "ab"):
        axes.imshow(picture, interpolation="lanczos")
        axes.set(title=f"{name}) t/T = {flap}")
        axes.axis("off")
    return figure


def figure_dynamics(settings):
    """Body pitch over the published hover with either moment row; error of the time stepping over its step."""
    attitude = data.table(settings.verification / "published_attitude.csv")
    with open(settings.verification / "verification.json", encoding="utf-8") as file:
        rows = [r for r in json.load(file) if r["case"] == "dynamics/newmark" and "error" in r["quantity"]]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), constrained_layout=True)
    t = attitude["t"] / attitude["t"][-1] * 3
    for name, label, style in (("correct_row", "correct moment row", dict(color=OURS)),
                               ("published", "published", dict(color=MEASURED, lw=2.5)),
                               ("their_row", "their moment row in this solver", dict(color=THEIRS, ls="--"))):
        left.plot(t, deg(attitude["theta_B_" + name]), label=label, **style)
    left.set(xlabel="t/T", ylabel=r"body pitch $\theta_B$ [deg]", title="Published hover under its published loads")
    for start in dict.fromkeys(r["quantity"].split(":")[0] for r in rows):
        chosen = [r for r in rows if r["quantity"].startswith(start)]
        n = [int(r["resolution"].split()[0]) for r in chosen]
        right.loglog(n, [r["error"] for r in chosen], "o-", label=start)
    ticks, n = n, np.array([250, 2000])
    right.loglog(n, 1e-3 * (250 / n) ** 2, color=GREY, ls="--", label="second order")
    right.loglog(n, 0.2 * 250 / n, color=GREY, ls=":", label="first order")
    right.set(xlabel="steps a flap", ylabel="relative error after a flap", title="Time stepping against order 8")
    right.set_xticks(ticks, map(str, ticks))
    right.minorticks_off()
    for axes in (left, right):
        axes.legend(fontsize=8)
    return figure


FIGURES = {"fig2": figure_2, "fig4": figure_4, "fig5": figure_5, "fig6": figure_6, "fig7": figure_7,
           "fig8": figure_8, "fig9": figure_9, "dynamics": figure_dynamics,
           "control": figure_control}
