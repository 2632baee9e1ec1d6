"""A flight whose wingbeat was led (docs/run_files.md), cut into the flaps of its phase clock."""
import dataclasses
import math
import os

import numpy as np

from monarch_flight import case_files
from monarch_flight.figures import data
from monarch_flight.keys import Refused

# What can be commanded, as kCommandTable in include/monarch_flight/insect/wingbeat.h: an angle, or relative.
ANGLE, RELATIVE = "deg", "%"
COMMANDS = dict(amplitude=RELATIVE, flapping_mean=ANGLE, frequency=RELATIVE, deviation_mean=ANGLE, rest_angle=ANGLE,
                abdomen_mean=ANGLE, abdomen_amplitude=RELATIVE, differential_amplitude=RELATIVE, differential_flapping=ANGLE,
                differential_deviation=ANGLE, differential_rest_angle=ANGLE)
# State at a phase, and units in which a change counts 1 (docs/trim.md).
STATES = ("vx", "vz", "theta_B", "theta_B_dot", "theta_R", "theta_R_dot")
RATES = ("ax", "az", "theta_B_dot", "theta_B_ddot", "theta_R_dot", "theta_R_ddot")
SCALES = np.array([0.1, 0.1, 0.1, 5.0, 0.1, 10.0])
ON_TIME = 1e-6  # of a flap


def shown(name, value):
    """A command's value as people read it: in % or deg."""
    return 100.0 * value if COMMANDS[name] == RELATIVE else math.degrees(value)


class Unfit(Refused):
    """A folder that does not hold what is asked for; every fault at once."""


@dataclasses.dataclass
class Flap:
    """One flap; `first` and `last`: rows of its start and its end, which is the start of the next one."""
    number: int  # 1 begins at phase 0
    first: int
    last: int
    start: np.ndarray  # STATES
    end: np.ndarray
    speed: float  # of the mean velocity over ground [m/s]
    climb: float  # of it, up [rad]
    theta_B_mean: float
    theta_B_swing: float
    means: dict  # of the commands as the wings flew them
    lows: dict
    highs: dict
    free: bool  # behind the prescribed steps

    @property
    def change(self):
        """How far the next flap's start differs from this one's: the largest change of a state, scaled."""
        return float(np.abs((self.end - self.start) / SCALES).max())


class LedFlight:
    """Columns of flight.csv, the resolved case, and the whole flaps between them."""

    def __init__(self, folder):
        self.folder = folder
        faults = [f"{folder / name}: does not exist; give the folder of a run that was flown to its end"
                  for name in ("case.yaml", "flight.csv") if not os.path.isfile(folder / name)]
        if faults:
            raise Unfit(*faults)
        self.case = case_files.read(folder / "case.yaml")
        self.columns = data.table(folder / "flight.csv")
        self.kind = self.case.get("guidance", {}).get("type", "motion")
        if "phase" not in self.columns or "applied_amplitude" not in self.columns:
            raise Unfit(f"{folder}/flight.csv: has no columns phase and applied_*; it must be of a version that writes them; "
                        "fly the case again")
        self.frequency = self.case["motion"]["frequency"]
        self.flaps = self._cut()

    @property
    def used(self):
        """Commands that moved, or that the controller may use."""
        controller = self.case.get("guidance", {}).get("controller", {}) if self.kind == "controller" else {}
        inputs = [name.strip() for law in (controller, controller.get("lateral", {})) for name in law.get("inputs", "").split(",")]
        return [name for name in COMMANDS if name in inputs or np.any(self.columns["applied_" + name])]

    @property
    def turns(self):
        """Whether the flight leaves the plane of symmetry."""
        return bool(self.case.get("free", {}).get("yaw"))

    def heading(self):
        """Yaw over the rows, whole turns included [rad]."""
        return np.unwrap(self.columns["yaw"])

    def _cut(self):
        phase = self.columns["phase"]
        marks = np.arange(math.ceil(phase[0] - ON_TIME), math.floor(phase[-1] + ON_TIME) + 1)
        levels = [self._level(mark) for mark in marks]
        return [self._flap(int(mark) + 1, *one, *two) for mark, one, two in zip(marks, levels, levels[1:])]

    def _level(self, mark):
        """Row, part of the way to the next one, of a phase."""
        phase = self.columns["phase"]
        row = min(int(np.searchsorted(phase, mark - ON_TIME)), len(phase) - 1)
        if abs(phase[row] - mark) <= ON_TIME or row == 0:
            return row, 0.0
        return row - 1, (mark - phase[row - 1]) / (phase[row] - phase[row - 1])

    def at(self, row, part, name, rate):
        """Between two rows by Hermite's cubic."""
        c = self.columns
        if part == 0.0:
            return c[name][row]
        dt, p = c["t"][row + 1] - c["t"][row], part
        return ((1 + 2 * p) * (1 - p) ** 2 * c[name][row] + p * p * (3 - 2 * p) * c[name][row + 1]
                + p * (1 - p) ** 2 * dt * c[rate][row] - p * p * (1 - p) * dt * c[rate][row + 1])

    def state(self, row, part=0.0):
        return np.array([self.at(row, part, *names) for names in zip(STATES, RATES)])

    def _flap(self, number, row, part, end_row, end_part):
        c, ends = self.columns, ((row, part), (end_row, end_part))
        t = [c["t"][r] + (p * (c["t"][r + 1] - c["t"][r]) if p else 0.0) for r, p in ends]
        dx, dy, dz = (self.at(*ends[1], q, "v" + q) - self.at(*ends[0], q, "v" + q) for q in "xyz")
        first, last = (r + (p > 0.0) for r, p in ends)
        rows = slice(first, last)
        applied = {name: c["applied_" + name][rows] for name in COMMANDS}
        return Flap(number, first, last, self.state(row, part), self.state(end_row, end_part),
                    speed=math.hypot(dx, dy, dz) / (t[1] - t[0]), climb=math.atan2(-dz, math.hypot(dx, dy) if dy else dx),
                    theta_B_mean=c["theta_B"][rows].mean(), theta_B_swing=np.ptp(c["theta_B"][rows]),
                    means={k: v.mean() for k, v in applied.items()}, lows={k: v.min() for k, v in applied.items()},
                    highs={k: v.max() for k, v in applied.items()},
                    free=bool(row >= self.case["coupling"]["prescribed_steps"]))

    def set_points(self):
        """(flap, speed [m/s], climb [deg]) of the controller, over ground; none without one."""
        points = self.case.get("guidance", {}).get("controller", {}).get("set_points", {}) if self.kind == "controller" else {}
        return list(zip(*(points[key] for key in ("flaps", "speeds", "climbs_deg")))) if points else []

    def headings(self):
        """(flap, heading [deg]) of the controller; none without them."""
        points = self.case.get("guidance", {}).get("controller", {}).get("set_points", {}) if self.kind == "controller" else {}
        return list(zip(points["flaps"], points["headings_deg"])) if "headings_deg" in points else []

    def lost_from(self):
        """Flap in which the controller gave up, or None."""
        lost = np.flatnonzero(self.columns["lost"])
        return int(math.floor(self.columns["phase"][lost[0]] - ON_TIME)) + 1 if lost.size else None
