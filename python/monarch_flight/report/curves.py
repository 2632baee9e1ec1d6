"""The curves of a run, each in the unit that the page shows."""
import dataclasses

import numpy as np

from monarch_flight.measured.reduced import FREQUENCIES
from monarch_flight.settling.led_flight import ANGLE, COMMANDS, RELATIVE, shown

NAMES = dict(amplitude="flapping amplitude", flapping_mean="flapping, mean", frequency="frequency",
             deviation_mean="deviation, mean", rest_angle="rest angle of the hinge", abdomen_mean="abdomen, mean",
             abdomen_amplitude="abdomen, amplitude", differential_amplitude="right less left: amplitude",
             differential_flapping="right less left: flapping", differential_deviation="right less left: deviation",
             differential_rest_angle="right less left: rest angle")


@dataclasses.dataclass
class Curve:
    """`x`: flaps (seconds where nothing beats), or metres of a path; none: the rows that the page knows."""
    name: str
    y: np.ndarray
    x: np.ndarray = None
    kind: str = "flown"  # measured: points; level: what is wanted or borne, a thin line


@dataclasses.dataclass
class Chart:
    title: str
    unit: str
    curves: list
    x: str = "time"  # or path
    scale: str = "linear"


def measured_curve(real, name, label):
    """An angle of the measured flight over its own flaps."""
    return Curve(label + ", measured", np.degrees(real[name]), real["t"] * FREQUENCIES["theta_B"], "measured")


def angle(flown, real, title, columns):
    """columns: {label: name in flight.csv}."""
    curves = [Curve(label, np.degrees(flown.column(name))) for label, name in columns.items()]
    curves += [measured_curve(real, name, label) for label, name in columns.items() if real is not None and name in real]
    return Chart(title, "deg", curves)


def angles(flown, real):
    left = flown.independent
    if not flown.bare:
        yield angle(flown, real, "Body pitch", {"pitch": "theta_B"})
        if left:
            yield angle(flown, None, "Body roll and heading", {"roll": "roll", "heading": "yaw"})
    yield angle(flown, real, "Wing pitch", {"right": "theta_R", "left": "theta_L"} if left else {"pitch": "theta_R"})
    beat = {"flapping": "phi", "deviation": "psi"}
    beat |= {"flapping, left": "phi_L", "deviation, left": "psi_L"} if left else {}
    yield angle(flown, real, "Wingbeat" if flown.bare else "Wingbeat and abdomen",
                beat if flown.bare else beat | {"abdomen": "theta_A"})


def unit_of_force(flown):
    """(name, units in a newton)."""
    largest = np.abs(np.stack([flown.columns[name] for name in ("FX", "FY", "FZ")])).max()
    return ("N", 1.0) if largest > 1.0 else ("mN", 1e3)


def forces(flown, mass):
    unit, k = unit_of_force(flown)
    total = [Curve("forward", k * flown.column("FX")), Curve("up", -k * flown.column("FZ"))]
    total += [Curve("to the right", k * flown.column("FY"))] if flown.independent or flown.bare else []
    if not flown.bare:
        weight = k * mass * flown.case["fluid"]["gravity"]
        total.append(Curve("weight", np.full(len(flown.rows), weight), kind="level"))
    yield Chart("Air force on the wing" if flown.bare else "Air force on both wings", unit, total)
    each = [Curve("right" if flown.independent else "each wing" if not flown.bare else "wing", -k * flown.column("fz"))]
    each += [Curve("left", -k * flown.column("fz_L"))] if flown.independent else []
    yield Chart("Force square to the wing, to its back", unit, each)


def commands(flown):
    """What guidance asked for, as the wings flew it."""
    for unit, title in ((RELATIVE, "Commands, relative"), (ANGLE, "Commands, angles")):
        moved = [name for name in COMMANDS if COMMANDS[name] == unit and np.any(flown.columns.get("applied_" + name, 0))]
        if moved:
            factor = [shown(name, 1.0) for name in moved]
            yield Chart(title, unit, [Curve(NAMES[name], f * flown.column("applied_" + name)) for name, f in zip(moved, factor)])


def path(flown, real):
    c = {name: flown.column(name) - flown.columns[name][0] for name in "xyz"}
    reach = max(float(np.ptp(values)) for values in c.values())
    unit, k = ("m", 1.0) if reach > 3.0 else ("cm", 100.0)
    side = [Curve("flown", -k * c["z"], k * c["x"])]
    if real is not None:
        side.append(Curve("measured", -k * (real["z"] - real["z"][0]), k * (real["x"] - real["x"][0]), "measured"))
    yield Chart("Path from the side: up over forward", unit, side, "path")
    if np.ptp(c["y"]) > 1e-6:
        yield Chart("Path from above: to the right over forward", unit, [Curve("flown", k * c["y"], k * c["x"])], "path")


def speed(flown):
    v = np.stack([flown.columns["v" + axis] for axis in "xyz"])
    if not np.any(v):
        return
    means = np.stack([flown.flap_mean(row) for row in v])
    length = np.sqrt((v ** 2).sum(axis=0))[flown.rows]
    curves = [Curve("speed", length)]
    if np.isfinite(means).any():
        curves.append(Curve("mean velocity of the last flap", np.sqrt((means ** 2).sum(axis=0))))
        yield Chart("Speed over ground", "m/s", curves)
        climb = np.degrees(np.arctan2(-means[2], np.hypot(means[0], means[1])))
        yield Chart("Climb, mean of the last flap", "deg", [Curve("climb", climb)])
    else:
        yield Chart("Speed over ground", "m/s", curves)


def last_residuals(iterations, steps):
    """Largest residual of all coordinates in the last sub-iteration of each step, by step."""
    residual = np.max(np.stack([values for name, values in iterations.items() if name.startswith("residual_")]), axis=0)
    found = np.full(steps, np.nan)
    found[np.clip(iterations["step"].astype(int), 0, steps - 1)] = residual  # the last one of a step stays
    return found


def solving(flown):
    count = len(flown.columns["t"])
    yield Chart("Sub-iterations of a step", "", [Curve("sub-iterations", flown.column("sub_iterations"))])
    if flown.iterations is not None:
        left = last_residuals(flown.iterations, count)[flown.rows]
        left[~(left > 0)] = np.nan
        if np.isfinite(left).any():
            yield Chart("Residual that a step ended with", "", [Curve("largest of all coordinates", left)], scale="logarithmic")
    if np.any(flown.columns["courant"]):
        yield Chart("Courant number", "", [Curve("largest in the grid", flown.column("courant"))])


def charts(flown, mass, real):
    """In the order of the page."""
    return [*angles(flown, real), *path(flown, real), *speed(flown), *forces(flown, mass), *commands(flown), *solving(flown)]
