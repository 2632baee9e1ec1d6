"""The case of a settled flight: motion and controller about the flight that needs no commands in the mean."""
import copy
import math

import numpy as np

from monarch_flight.settling import settled_motion
from monarch_flight.settling.led_flight import COMMANDS, shown

DIGITS = 12  # of tables and gains


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


def orbit(rows, samples):
    """States of a flap at the controller's samples, velocities through the air."""
    every = (len(rows["x"]) - 1) // samples
    states = np.column_stack([rows[name] for name in settled_motion.STATES])
    states[:, :2] -= np.column_stack([rows["wx"], rows["wz"]])
    return states[:-1:every]


def units(names, means):
    """A command of the new motion in units of the old one: 1 % of a larger swing is more than 1 %."""
    return np.array([1.0 / (1.0 + means[name]) if name in settled_motion.SWUNG else 1.0 for name in names])


def plain(matrix):
    return [[float(f"{value:.{DIGITS}g}") for value in row] for row in np.asarray(matrix, float)]


def shift_limits(guidance, means):
    """The same bounds of the wings' motion, told as changes of the new one."""
    for name, (low, high) in guidance["limits"].items():
        if means.get(name, 0.0) != 0.0:  # those that tell the wings apart are not folded
            unit = float(units([name], means)[0])
            guidance["limits"][name] = [min(0.0, unit * (low - means[name])), max(0.0, unit * (high - means[name]))]
            guidance["rates"][name] *= unit


def held(controller, flap):
    """(speed, climb in deg) of the set point at a flap on the phase clock."""
    points = controller["set_points"]
    last = max((i for i, start in enumerate(points["flaps"]) if start <= flap), default=0)
    return points["speeds"][last], points["climbs_deg"][last]


def shift_controller(controller, rows, point, means):
    """The law about the new motion: at the set point no command and the flown states, the whole table moved alike; gains
    in the units of the new commands."""
    controller["set_points"] = dict(flaps=[0], speeds=[point[0]], climbs_deg=[point[1]])
    wind = np.array([rows[name][:-1].mean() for name in ("wx", "wz")])
    commands, states = reference(controller, velocity(point[0], math.radians(point[1])) - wind)
    samples, table, gains = controller["samples"], controller["table"], controller["gains"]
    moved = orbit(rows, samples)[:, :states.shape[1]] - states
    unit = units([name.strip() for name in controller["inputs"].split(",")], means)
    points, each = len(table["commands"]), np.tile(unit, samples)[:, None]
    table["commands"] = plain((np.array(table["commands"], float) - commands) * unit)
    table["states"] = plain(np.array(table["states"], float) + np.tile(moved, (points, 1)))
    gains["state"] = plain(np.array(gains["state"], float) * each)
    gains["integral"] = plain(np.array(gains["integral"], float) * each)
    gains["filter"] = plain(np.array(gains["filter"], float) * each / np.repeat(unit, 3))


def comments_of(means, prescribed, origin, controlled):
    """By the keys that they stand above."""
    keys = {key for name, key in (*settled_motion.SWUNG.items(), *settled_motion.SHIFTED.items()) if means[name] != 0.0}
    comments = {f"motion/{key}": f"status: as flown, with the mean commands folded in ({origin})" for key in keys}
    if means["rest_angle"] != 0.0:
        comments["insect/wing/theta_0"] = f"status: as flown, with the mean command folded in ({origin})"
    comments |= {key: f"status: flown, mean of the {origin};\n{settled_motion.HARMONICS} harmonics, value and rate at its start "
                 "exact" for key in prescribed}
    for key in ("prescribed_flaps", "prescribed_steps"):
        comments["coupling/" + key] = "The first flap is prescribed: the flight that the release goes on with."
    comments["guidance/limits"] = "The bounds that the wings' motion had, told as changes of this one."
    if controlled:
        comments["guidance/controller/set_points"] = "Mean velocity over ground: the one that was held."
        comments["guidance/controller/table"] = (
            "Moved alike at all points: at the set point no command, and the states that were flown.\n"
            "Rows: speed by speed, in each the climbs; of states the samples of a flap.")
        comments["guidance/controller/gains"] = "Rows: sample by sample, in each the inputs; in units of this motion's commands."
    return comments


def settled(flight, verdict, name):
    """Content, comments by key, heading of the case in which the settled flight needs no commands in the mean."""
    case, means, rows = copy.deepcopy(flight.case), verdict.means, settled_motion.flown(flight, verdict.flaps)
    origin = f"{verdict.span} of {flight.folder.name}/flight.csv"
    settled_motion.fold(case, means)
    prescribed = settled_motion.prescribe(case, rows)
    case["name"] = name
    controlled = flight.kind == "controller"
    if controlled:
        controller = case["guidance"]["controller"]
        shift_controller(controller, rows, held(controller, flight.columns["phase"][-1]), means)
    shift_limits(case["guidance"], means)
    amounts = ", ".join(f"{key} {shown(key, means[key]):+.5g} {COMMANDS[key]}" for key in flight.used)
    heading = (f"# Made by monarch settle (docs/trim.md, Through control) from a flight of the case {flight.case['name']},\n"
               f"# {origin}. Mean commands, folded into the motion: {amounts or 'none'}.\n"
               f"# There a flap repeats within {verdict.change:.2g} (scaled).\n")
    return case, comments_of(means, prescribed, origin, controlled), heading
