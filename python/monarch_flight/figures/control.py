"""Figures of controlled flights (monarch figures control): states and commands beside the uncontrolled flight."""
import matplotlib.pyplot as plt
import numpy as np

from monarch_flight.figures import control_data as control
from monarch_flight.figures.style import GREY, MEASURED, OURS, THEIRS, THIRD
from monarch_flight.settling.led_flight import COMMANDS

WANTED = MEASURED
NAMES = dict(amplitude="flapping amplitude", flapping_mean="mean of the flapping", frequency="frequency",
             deviation_mean="mean of the deviation", rest_angle="rest angle of the hinge", abdomen_mean="mean of the abdomen",
             abdomen_amplitude="amplitude of the abdomen", differential_amplitude="differential flapping amplitude",
             differential_flapping="differential mean of the flapping",
             differential_deviation="differential mean of the deviation",
             differential_rest_angle="differential rest angle of the hinges")
AIRS = dict(quasi_steady="quasi-steady air", navier_stokes="Navier-Stokes air")


def air(case):
    solver = case["fluid"]["solver"]
    return AIRS.get(solver, f"air by {solver}")


def pitch(axes, flight, alone):
    for one, style in ((alone, dict(color=THEIRS, ls="--", lw=1, label="without control")),
                       (flight, dict(color=OURS, lw=1, label="controlled"))):
        if one is not None:
            rows = control.rows_shown(one) if one is alone else slice(None)
            axes.plot(one.columns["phase"][rows], np.degrees(one.columns["theta_B"][rows]), **style)
    for limit in (-60, 60):
        axes.axhline(limit, color=GREY, ls=":", lw=1.2, label="60 deg: tumbled" if limit > 0 else None)
    axes.set(title=r"body pitch $\theta_B$", ylabel="angle [deg]", ylim=(-100, 100))


def means(axes, flight, alone, which, title, label):
    """Climb (1) or speed (2) of each flap, with the set point."""
    edges, *wanted = control.set_point_steps(flight)
    if edges:
        steps = wanted[which - 1]
        axes.plot(edges, steps + steps[-1:], drawstyle="steps-post", color=WANTED, lw=1.2, label="set point")
    if alone is not None:
        found = control.flap_means(alone)
        axes.plot(found[0], found[which], "x--", color=THEIRS, ms=4, lw=1, label="without control")
    found = control.flap_means(flight)
    axes.plot(found[0], found[which], "o-", color=OURS, ms=3, lw=1, label="controlled")
    axes.set(title=title + ", mean of each flap", ylabel=label)


def command(axes, flight, name):
    values, limits = control.command(flight, name)
    axes.plot(flight.columns["phase"], values, color=OURS, lw=1, label="flown")
    for i, limit in enumerate(limits):
        axes.axhline(limit, color=GREY, ls=":", lw=1.2, label=None if i else "limits")
    axes.set(title=f"command: {NAMES[name]}", ylabel=f"change [{COMMANDS[name]}]")


def wind(axes, flight):
    for values, name, line in zip(control.wind(flight), ("north", "east", "up"), ("-", ":", "--")):
        axes.plot(flight.columns["phase"], values, color=THIRD, ls=line, lw=1.2, label=name)
    axes.set(title="wind at the body", ylabel="velocity [m/s]")


def heading(axes, flight):
    end = flight.columns["phase"][-1]
    points = [point for point in flight.headings() if point[0] < end]
    if points:
        axes.plot([flap for flap, _ in points] + [end], [value for _, value in points] + [points[-1][1]],
                  drawstyle="steps-post", color=WANTED, lw=1.2, label="set point")
    axes.plot(flight.columns["phase"], np.degrees(flight.heading()), color=OURS, lw=1.2, label="flown")
    axes.set(title="heading", ylabel="angle [deg]")


def roll(axes, flight):
    axes.plot(flight.columns["phase"], np.degrees(flight.columns["roll"]), color=OURS, lw=1, label="roll, right wing down")
    axes.set(title="roll", ylabel="angle [deg]")


def plan(axes, flight):
    c = flight.columns
    axes.plot(c["y"] - c["y"][0], c["x"] - c["x"][0], color=OURS, lw=1.2, label="from above")
    axes.plot(0.0, 0.0, "o", color=OURS, ms=4, label="start")
    axes.set(title="path of the body", xlabel="east [m]", ylabel="north [m]", aspect="equal", adjustable="datalim")


def path(axes, flight, alone):
    for one, style in ((alone, dict(color=THEIRS, ls="--", label="without control")),
                       (flight, dict(color=OURS, label="controlled"))):
        if one is not None:
            rows = control.rows_shown(one) if one is alone else slice(None)
            c = one.columns
            axes.plot(c["x"][rows] - c["x"][0], c["z"][0] - c["z"][rows], lw=1.2, **style)
    axes.set(title="path of the body", xlabel="forward [m]", ylabel="up [m]", aspect="equal", adjustable="datalim")


def draw(flight, alone):
    """States on the left, commands and wind on the right, the path where there is room: from above if the flight turns."""
    left = [lambda axes: pitch(axes, flight, alone),
            lambda axes: means(axes, flight, alone, 1, "climb angle", "angle [deg]"),
            lambda axes: means(axes, flight, alone, 2, "speed", "speed [m/s]")]
    if flight.turns:
        left += [lambda axes: heading(axes, flight), lambda axes: roll(axes, flight)]
    right = [lambda axes, name=name: command(axes, flight, name) for name in flight.used]
    if control.wind(flight) is not None:
        right.append(lambda axes: wind(axes, flight))
    rows = max(len(left), len(right))
    inside = len(right) < rows  # the path in the last place on the right
    figure = plt.figure(figsize=(12, 2.5 * (rows + (not inside))), constrained_layout=True)
    grid = figure.add_gridspec(rows + (not inside), 2)
    over_flaps = []
    for column, draws in enumerate((left, right)):
        for row, one in enumerate(draws):
            over_flaps.append(figure.add_subplot(grid[row, column]))
            one(over_flaps[-1])
            over_flaps[-1].set(xlabel="flaps", xlim=(0, flight.columns["phase"][-1]))
    path_axes = figure.add_subplot(grid[rows - 1, 1] if inside else grid[rows, :])
    if flight.turns:
        plan(path_axes, flight)
    else:
        path(path_axes, flight, alone)
    for axes in (*over_flaps, path_axes):
        axes.legend(fontsize=7, loc="best")
    figure.suptitle(f"{flight.case['name']}, {air(flight.case)}")
    return figure


def figure_control(settings):
    """{name: figure}, one for each flight that is led."""
    found = control.pairs(control.flights(settings))
    if not found:
        raise SystemExit("figures: runs: none of them is a flight that is led (guidance/type controller, commands, node or "
                         "replay); give one")
    return {name: draw(*pair) for name, pair in found.items()}
