"""A run as the page shows it: its tables, case and summary; which rows are kept."""
import json
import math
import os

import numpy as np

from monarch_flight import case_files, places
from monarch_flight.keys import Refused

ROWS = 5000  # of the curves, at most
FRAMES_PER_FLAP, FRAMES = 60, 5000  # of the view, at most


def table(path):
    """Columns of a CSV file by name."""
    with open(path, encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        lines = [line for line in file if line.endswith("\n")]  # the last one may not be whole yet
    numbers = np.loadtxt(lines, delimiter=",", ndmin=2)
    return dict(zip(names, numbers.reshape(-1, len(names)).T))


def spread(count, most):
    """Numbers of at most `most` of `count` rows, evenly, the last one always."""
    step = max(1, math.ceil(count / most))
    rows = np.arange(0, count, step)
    return rows if rows[-1] == count - 1 else np.append(rows, count - 1)


class Flown:
    """A run's folder. `columns`: those of flight.csv; `scale`: flaps a second, or 1 where nothing beats (then time is in
    seconds); `rows`: of the curves, `frames`: of the view, numbers of rows of flight.csv."""

    def __init__(self, folder, ended=True):
        """`ended`: it must have; else what is flown so far will do, without a summary."""
        self.folder = folder
        flight = folder / ("flight.csv" if ended or os.path.isfile(folder / "flight.csv") else "flight.csv.active")
        missing = [f"{path}: does not exist; name the folder of a run that has ended (monarch fly writes one)"
                   for path in (folder / "case.yaml", flight, folder / "summary.json")[:3 if ended else 2] if not os.path.isfile(path)]
        if missing:
            raise Refused(*missing)
        try:
            self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8")) if ended else {}
            self.case = case_files.read(folder / "case.yaml")
            self.columns = table(flight)
            self.iterations = table(folder / "iterations.csv") if os.path.isfile(folder / "iterations.csv") else None
            self.name, self.frequency = self.case["name"], self.case["motion"].get("frequency", 0)
        except (ValueError, KeyError, TypeError) as error:
            raise Refused(f"{folder}: its files are not those of a run: {error}") from None
        count = len(self.columns.get("t", ()))
        if count < 2 or "qw" not in self.columns:
            raise Refused(f"{folder / 'flight.csv'}: holds {count} steps, or is of an older version; fly the case again")
        self.scale = self.frequency or 1.0
        self.rows = spread(count, ROWS)
        self.frames = spread(count, max(2, self._frames(count)))

    def _frames(self, count):
        flaps = (self.columns["t"][-1] - self.columns["t"][0]) * self.scale
        return min(count, FRAMES, int(FRAMES_PER_FLAP * flaps) + 1 if self.frequency else 600)

    @property
    def bare(self):
        return self.case["insect"]["kind"] == "bare_wing"

    @property
    def independent(self):
        return self.case.get("wings") == "independent"

    def column(self, name):
        """At the rows of the curves."""
        return self.columns[name][self.rows]

    def flap_mean(self, values):
        """Mean over the flap that ends at each row of the curves; nan in the first flap, or without a period."""
        t = self.columns["t"]
        if not self.frequency:
            return np.full(len(self.rows), np.nan)
        flap = int(round(1.0 / (self.frequency * (t[1] - t[0]))))
        if len(t) <= flap:
            return np.full(len(self.rows), np.nan)
        sums = np.concatenate([[0.0], np.cumsum(values[1:])])
        means = np.full(len(t), np.nan)
        means[flap:] = (sums[flap:] - sums[:-flap]) / flap
        return means[self.rows]


def measured(flown):
    """Histories of the measured monarch, or None where this insect does not flap as it did."""
    if flown.bare:
        return None
    from monarch_flight.measured import marker_reduction as reduction

    with open(places.config() / "insects/monarch_kinematics.yaml", encoding="utf-8") as file:
        published = case_files.yaml.load(file, case_files.CaseLoader)["phi_deg"]
    if flown.case["motion"].get("phi_deg") != published:
        return None
    markers = reduction.read_markers(places.config() / "measured/monarch_markers.csv")
    return reduction.histories(*markers, flown.case["insect"]["beta"])[0]
