"""The motion that flies a settled flap without commands in the mean (monarch settle, docs/trim.md)."""
import math

import numpy as np

from monarch_flight.settling.led_flight import STATES, Unfit

HARMONICS = 8
SWUNG = dict(amplitude="phi_deg", abdomen_amplitude="theta_A_deg")
SHIFTED = dict(flapping_mean="phi_deg", deviation_mean="psi_deg", abdomen_mean="theta_A_deg")


def check(flight):
    """Refuses what cannot be folded."""
    case, faults, c = flight.case, [], flight.columns
    if case["motion"]["type"] != "fourier":
        faults.append(f"motion/type = {case['motion']['type']}: must be fourier for commands to be folded into it; "
                      "fly a case with series")
    steps = 1.0 / ((c["t"][1] - c["t"][0]) * flight.frequency)
    if abs(steps - round(steps)) > 1e-6 or abs(c["phase"][0] - round(c["phase"][0])) > 1e-6:
        faults.append(f"time: a flap of {steps:.6g} steps from phase {c['phase'][0]:g} on: must be whole steps from a whole phase "
                      "on; give time/steps_per_flap and t_start 0")
    if np.any(c["applied_frequency"] != 0.0):
        faults.append(f"applied_frequency of {c['applied_frequency'][-1]:g} at the end: must be 0, for the gains belong to the "
                      "frequency they were computed with; lead by amplitude instead")
    if flight.turns:
        faults.append("free/yaw = true: must be false, the motion that commands are folded into stays in the plane of symmetry; "
                      "fly the case with wings:=mirrored")
    if faults:
        raise Unfit(*(f"{flight.folder}: {fault}" for fault in faults))


def flown(flight, flaps):
    """Columns of flight.csv over a flap, both ends there, in the mean of these flaps; x and z from its start."""
    def mean(name):
        return np.mean([flight.columns[name][flap.first:flap.last + 1] for flap in flaps], axis=0)
    rows = {name: mean(name) for name in (*STATES, "x", "z", "wx", "wz")}
    return rows | {name: rows[name] - rows[name][0] for name in ("x", "z")}


def series_of(node):
    """A constant is a series, too."""
    return node if isinstance(node, dict) else dict(A0=node, AN=[], BN=[], multiple=1)


def fold(case, means):
    """The mean commands become part of motion and hinge."""
    motion = case["motion"]
    for name, key in SWUNG.items():
        if means[name] != 0.0:
            series = series_of(motion[key])
            motion[key] = series | {part: [(1.0 + means[name]) * value for value in series[part]] for part in ("AN", "BN")}
    for name, key in SHIFTED.items():
        if means[name] != 0.0:
            series = series_of(motion[key])
            motion[key] = series | dict(A0=series["A0"] + math.degrees(means[name]))
    if means["rest_angle"] != 0.0:
        case["insect"]["wing"]["theta_0"] += means["rest_angle"]


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
    series["BN"][0] += float(rate - now_rate) / (2 * math.pi * frequency)
    series["A0"] += float(value - now)
    return series


def in_degrees(series):
    return {key: np.degrees(value).tolist() if key != "multiple" else value for key, value in series.items()}


def prescribe(case, rows):
    """The first flap follows the flown one, so that the release goes on with it; returns the keys that it changed."""
    motion, free, f = case["motion"], case["free"], case["motion"]["frequency"]
    body, changed = motion["body"], ["motion/body"]
    for axis, name in ((0, "x"), (2, "z")):
        if free[name]:
            mean = float(rows[name][-1]) * f
            series = periodic_series(rows[name]) | dict(A0=0.0)
            body["sway_" + name] = through(series, f, at_start(series, f)[0], rows["v" + name][0] - mean)
            body["velocity"][axis] = mean
    for name, flag in (("theta_B", "pitch"), ("theta_R", "wing_pitch")):
        if free[flag]:
            motion[name + "_deg"] = in_degrees(through(periodic_series(rows[name]), f, rows[name][0], rows[name + "_dot"][0]))
            changed.append(f"motion/{name}_deg")
    case.pop("initial", None)
    case["coupling"].pop("prescribed_steps")
    if "steps_per_flap" in case["time"]:  # also with other steps a flap
        case["coupling"]["prescribed_flaps"] = 1
    else:
        case["coupling"]["prescribed_steps"] = len(rows["x"]) - 1
    return changed
