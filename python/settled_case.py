"""The case of a settled flight: its mean commands folded into the motion, its periodic flight as the prescribed flap."""
import copy
import math

import numpy as np

from led_flight import ANGLE, COMMANDS, Unfit, shown

HARMONICS = 8
DIGITS = 12  # of tables and gains


def check(flight):
    """Refuses what cannot be folded."""
    case, faults, columns = flight.case, [], flight.columns
    if case["motion"]["type"] != "fourier":
        faults.append(f"motion/type = {case['motion']['type']}: must be fourier for commands to be folded into it; fly a case with series")
    steps = flight.flaps[-1].last - flight.flaps[-1].first
    length = steps * (columns["t"][1] - columns["t"][0]) * flight.frequency
    if abs(length - 1.0) > 1e-6 or abs(columns["phase"][0] - round(columns["phase"][0])) > 1e-6:
        faults.append(f"time: a flap of {1 / (length / steps):.6g} steps from phase {columns['phase'][0]:g} on: must be whole steps from a "
                      "whole phase on; give time/steps_per_flap and t_start 0")
    if np.any(columns["applied_frequency"] != 0.0):
        faults.append(f"applied_frequency of {columns['applied_frequency'][-1]:g} at the end: must be 0, for the gains belong to the "
                      "frequency they were computed with; lead by amplitude instead")
    if faults:
        raise Unfit(*(f"{flight.folder}: {fault}" for fault in faults))


def periodic_series(samples):
    """Mean and harmonics of one flap from phase 0, both ends given; what the ends differ by counts as a straight
    line (as src/trim/periodic_shape.cpp)."""
    n = len(samples) - 1
    value = samples[:-1] - (samples[-1] - samples[0]) / n * np.arange(n)
    waves = np.exp(2j * math.pi * np.outer(np.arange(1, HARMONICS + 1), np.arange(n)) / n) @ value * (2.0 / n)
    return dict(A0=float(value.mean()), AN=waves.real.tolist(), BN=waves.imag.tolist(), multiple=1)


def at_start(series, frequency):
    """Value and rate at phase 0."""
    orders = np.arange(1, len(series["AN"]) + 1)
    return series["A0"] + sum(series["AN"]), 2 * math.pi * frequency * float(orders @ series["BN"])


def through(series, frequency, value, rate):
    """Mean and first harmonic changed so that phase 0 has this value and rate."""
    now, now_rate = at_start(series, frequency)
    series["BN"][0] += (rate - now_rate) / (2 * math.pi * frequency)
    series["A0"] += value - now
    return series


def in_degrees(series):
    return {key: np.degrees(value).tolist() if key != "multiple" else value for key, value in series.items()}


def fold(case, means):
    """The commands become part of motion and hinge; returns the keys that changed."""
    motion, changed = case["motion"], []
    for key, amplitude, mean in (("phi_deg", "amplitude", "flapping_mean"), ("psi_deg", None, "deviation_mean"),
                                 ("theta_A_deg", "abdomen_amplitude", "abdomen_mean")):
        swing, shift = 1.0 + means.get(amplitude, 0.0), math.degrees(means[mean])
        if swing == 1.0 and shift == 0.0:
            continue
        series = motion[key] if isinstance(motion[key], dict) else dict(A0=motion[key], AN=[], BN=[], multiple=1)
        motion[key] = series | dict(A0=series["A0"] + shift, AN=[swing * a for a in series["AN"]],
                                    BN=[swing * b for b in series["BN"]])
        changed.append("motion/" + key)
    if means["rest_angle"] != 0.0:
        case["insect"]["wing"]["theta_0"] += means["rest_angle"]
        changed.append("insect/wing/theta_0")
    return changed


def prescribe(case, flight, flap):
    """The first flap follows the flown one, so that the release goes on with it; returns the keys that changed."""
    motion, free, f, columns = case["motion"], case["free"], flight.frequency, flight.columns
    rows = slice(flap.first, flap.last + 1)
    body, changed = motion["body"], ["motion/body"]
    for axis, name, speed in ((0, "x", flap.start[0]), (2, "z", flap.start[1])):
        if free[name]:
            way = columns[name][rows]
            mean = float(way[-1] - way[0]) * f
            series = periodic_series(way) | dict(A0=0.0)
            body["sway_" + name] = through(series, f, at_start(series, f)[0], speed - mean)
            body["velocity"][axis] = mean
    for key, name, flag, first in (("theta_B_deg", "theta_B", "pitch", 2), ("theta_R_deg", "theta_R", "wing_pitch", 4)):
        if free[flag]:
            series = through(periodic_series(columns[name][rows]), f, flap.start[first], flap.start[first + 1])
            motion[key] = in_degrees(series)
            changed.append("motion/" + key)
    case.pop("initial", None)
    case["coupling"]["prescribed_steps"] = flap.last - flap.first
    return changed


def corners(value, points):
    """[(index, weight)] of a value in an ascending list, the ends beyond it."""
    if value <= points[0] or len(points) < 2:
        return [(0, 1.0)]
    if value >= points[-1]:
        return [(len(points) - 1, 1.0)]
    above = int(np.searchsorted(points, value, side="right"))
    part = (value - points[above - 1]) / (points[above] - points[above - 1])
    return [(above - 1, 1.0 - part), (above, part)]


def velocity(speed, climb):
    """x and z of NED; climb in rad."""
    return np.array([speed * math.cos(climb), -speed * math.sin(climb)])


def reference(controller, wanted):
    """Commands and states at every sample that the controller's table has for a mean velocity x, z through the air
    (as TrimTable::at in src/guidance/controller_settings.cpp)."""
    table = controller["table"]
    speeds, climbs = np.array(table["speeds"], float), np.radians(table["climbs_deg"])
    norm, angle = math.hypot(*wanted), math.atan2(-wanted[1], wanted[0])
    states = np.array(table["states"], float).reshape(len(speeds) * len(climbs), controller["samples"], -1)
    command, state, mean = 0.0, 0.0, np.zeros(2)
    for i, a in corners(norm, speeds):
        for k, b in corners(angle, climbs):
            point = i * len(climbs) + k
            command = command + a * b * np.array(table["commands"][point], float)
            state = state + a * b * states[point]
            mean += a * b * velocity(speeds[i], climbs[k])
    state[:, :2] += velocity(np.clip(norm, speeds[0], speeds[-1]), np.clip(angle, climbs[0], climbs[-1])) - mean
    return command, state


def orbit(flight, flap, samples):
    """States of a flap at the controller's samples, velocities through the air."""
    rows = flap.first + (flap.last - flap.first) // samples * np.arange(samples)
    states = np.array([flight.state(row) for row in rows])
    states[:, :2] -= np.column_stack([flight.columns[name][rows] for name in ("wx", "wz")])
    return states


def units(names, means):
    """What a command of the folded motion is in units of the old one: 1 % of a larger swing is more than 1 %."""
    return np.array([1.0 / (1.0 + means[name]) if name in ("amplitude", "abdomen_amplitude") else 1.0 for name in names])


def plain(matrix):
    return [[float(f"{value:.{DIGITS}g}") for value in row] for row in np.asarray(matrix, float)]


def shift_limits(guidance, means):
    """The same bounds of the wings' motion, told as changes of the folded one; inputs that are not used stay."""
    for name, (low, high) in guidance["limits"].items():
        if means[name] != 0.0:
            unit = units([name], means)[0]
            guidance["limits"][name] = [min(0.0, float(unit * (low - means[name]))), max(0.0, float(unit * (high - means[name])))]
            guidance["rates"][name] *= float(unit)


def shift_controller(controller, flight, flap, means):
    """The law about the folded motion: no command and the flown states at the set point that was held, the whole table
    moved alike; gains in the units of the new commands."""
    flaps, speeds, climbs = (controller["set_points"][key] for key in ("flaps", "speeds", "climbs_deg"))
    held = max((i for i, start in enumerate(flaps) if start <= flight.columns["phase"][-1]), default=0)
    controller["set_points"] = dict(flaps=[0], speeds=[speeds[held]], climbs_deg=[climbs[held]])
    rows = slice(flap.first, flap.last)
    wind = np.array([flight.columns[name][rows].mean() for name in ("wx", "wz")])
    commands, states = reference(controller, velocity(speeds[held], math.radians(climbs[held])) - wind)
    samples, table, gains = controller["samples"], controller["table"], controller["gains"]
    moved = (orbit(flight, flap, samples)[:, :states.shape[1]] - states)
    points = len(table["commands"])
    names = [name.strip() for name in controller["inputs"].split(",")]
    unit = units(names, means)
    table["commands"] = plain((np.array(table["commands"], float) - commands) * unit)
    table["states"] = plain(np.array(table["states"], float) + np.tile(moved, (points, 1)))
    rows_of = np.tile(unit, samples)[:, None]
    gains["state"] = plain(np.array(gains["state"], float) * rows_of)
    gains["integral"] = plain(np.array(gains["integral"], float) * rows_of)
    gains["filter"] = plain(np.array(gains["filter"], float) * rows_of / np.repeat(unit, 3))


def settled(flight, verdict, name):
    """Content, comments by key, heading of the case in which the settled flight needs no commands in the mean."""
    case, means, flap = copy.deepcopy(flight.case), verdict.means, verdict.flaps[-1]
    case["name"] = name
    folded = fold(case, means)
    flown = prescribe(case, flight, flap)
    origin = f"{flight.folder.name}/flight.csv"
    amounts = ", ".join(f"{key} {shown(key, means[key]):+.5g} {COMMANDS[key]}" for key in flight.used)
    comments = {key: f"status: as flown, with the mean commands of {verdict.span} of {origin} folded in" for key in folded}
    comments |= {key: f"status: flown, flap {flap.number} of {origin}: {HARMONICS} harmonics; value and rate at the flap's start are exact"
                 for key in flown}
    comments["coupling/prescribed_steps"] = "The first flap is prescribed: the flight that the release goes on with."
    if flight.kind == "controller":
        shift_controller(case["guidance"]["controller"], flight, flap, means)
        comments["guidance/controller/set_points"] = "Mean velocity over ground: the one that was held."
        comments["guidance/controller/table"] = ("Moved alike at all points: at the set point no command and the states of the flown flap. "
                                                 "Rows: speed by speed, in each\nthe climbs; of states the samples of a flap.")
        comments["guidance/controller/gains"] = "Rows: sample by sample, in each the inputs; in units of the folded motion."
    shift_limits(case["guidance"], means)
    comments["guidance/limits"] = "The bounds that the wings' motion had, told as changes of the folded one."
    heading = (f"# Made by scripts/settle (docs/trim.md, Through control) from {flight.folder.name}, a flight of the case "
               f"{flight.case['name']}.\n# Mean commands of its {verdict.span}, folded into the motion: {amounts or 'none'}.\n"
               f"# There a flap repeats within {verdict.change:.2g} (scaled).\n")
    return case, comments, heading
