"""Case files and table of a sweep."""
import csv
import json
import math
import pathlib

import numpy as np
import yaml

from monarch_flight import case_files
from monarch_flight.figures import data
from monarch_flight.measured import marker_reduction as reduction

COLUMNS = ("name", "status", "flaps", "steps retried", "climb [deg]", "speed [m/s]", "theta_B mean [deg]", "theta_B swing [deg]",
           "largest theta_B [deg]", "theta_R swing [deg]", "theta_R amplitude / measured", "theta_R phase - measured [deg]",
           "theta_R to measured, rms [deg]", "path to measured, rms [mm]")


def write_cases(case, over, out):
    """A case file for each value; those of other sweeps in `out` go."""
    key, _, values = over.partition("=")
    content = case_files.read(case)
    name, folder = content["name"], out / "cases"
    folder.mkdir(parents=True, exist_ok=True)
    wanted = {}
    for value in values.split(","):
        place = content["insect"]
        *above, last = key.split("/")
        for step in above:
            place = place.setdefault(step, {})
        place[last] = float(value)
        content["name"] = f"{name}_{above[-1] + '_' if above else ''}{last}_{value}"
        wanted[content["name"] + ".yaml"] = yaml.safe_dump(content, sort_keys=False)
    for old in folder.glob("*.yaml"):
        if old.name not in wanted:
            old.unlink()
    for file, text in wanted.items():
        path = folder / file
        if not path.exists() or path.read_text(encoding="utf-8") != text:  # the same again is not flown again
            path.write_text(text, encoding="utf-8")


def pitch_to_measured(flight, frequency):
    """Wing pitch against the series of the measured flight, over the last whole flaps (less than one: over all there is):
    ratio of the fundamentals' amplitudes, how far ours is ahead [deg], rms difference [deg]."""
    series = data.published()["theta_R_deg"]
    steps = int(round(1 / frequency / (flight["t"][1] - flight["t"][0])))
    flaps = (len(flight["t"]) - 1) // steps
    whole = slice(len(flight["t"]) - flaps * steps if flaps else 0, None)
    t, ours = flight["t"][whole], np.degrees(flight["theta_R"][whole])
    theirs = reduction.evaluate(series, t, frequency * series["multiple"])
    a, b = (np.mean(theta * np.exp(-2j * np.pi * frequency * t)) for theta in (ours, theirs))
    return abs(a / b), math.degrees(np.angle(a / b)), math.sqrt(np.mean((ours - theirs) ** 2))


def row(summary):
    """Averages from the second free flap on; of all free flaps, or of the whole flight, where that leaves no whole flap."""
    folder = summary.parent
    told = json.loads(summary.read_text(encoding="utf-8"))
    flight, case = data.flight(folder), data.case_of(folder)
    period = 1.0 / case["motion"]["frequency"]
    t = flight["t"] - flight["t"][0]
    release = case["coupling"]["prescribed_steps"] * (t[1] - t[0])
    start = next((s for s in (release + period, release) if t[-1] - s >= period), 0.0)
    late = t >= start
    part = {k: v[late] for k, v in flight.items()}
    dx, dz = part["x"][-1] - part["x"][0], part["z"][-1] - part["z"][0]
    theta_B, theta_R = np.degrees(part["theta_B"]), np.degrees(part["theta_R"])
    return (folder.name, told["status"], told["flaps"], told["retried_steps"], math.degrees(math.atan2(-dz, dx)),
            math.hypot(dx, dz) / (part["t"][-1] - part["t"][0]), theta_B.mean(), np.ptp(theta_B), np.abs(theta_B).max(),
            np.ptp(theta_R), *pitch_to_measured(part, case["motion"]["frequency"]), 1e3 * data.distance_to_measured(flight))


def write_table(path, summaries):
    """A row for each flight, into a file and onto the screen."""
    rows = sorted((row(pathlib.Path(one)) for one in summaries), key=lambda one: float(one[0].rpartition("_")[2]))
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([COLUMNS] + rows)
    for name, one in zip(COLUMNS, zip(*rows)):
        print(f"{name:28s}" + "".join(f"{v:>14.4g}" if isinstance(v, float) else f"  {v}" for v in one))
