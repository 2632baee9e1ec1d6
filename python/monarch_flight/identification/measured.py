"""What was measured: angles over time, each as a Fourier series of the flap or as a table."""
import dataclasses
import math
import numbers

import numpy as np
import yaml

from monarch_flight import places
from monarch_flight.measured import marker_reduction as reduction

ANGLES = ("theta_R", "theta_L", "theta_B", "theta_A", "phi", "psi", "roll", "yaw")  # columns of flight.csv


@dataclasses.dataclass(frozen=True)
class Series:
    """A0 + sum AN cos(2 pi n m f t) + BN sin(2 pi n m f t) [deg], run at the flapping frequency."""
    angle: str
    source: str
    weight: float  # of its residuals
    terms: dict

    def at(self, t, frequency):
        return reduction.evaluate(self.terms, t, frequency * self.terms.get("multiple", 1))


@dataclasses.dataclass(frozen=True)
class Rows:
    """A table, straight lines between its rows; `repeats`: it is one flap, which goes on and on."""
    angle: str
    source: str
    weight: float
    t: np.ndarray  # [s], on the clock of the motion
    degrees: np.ndarray
    repeats: bool

    def at(self, t, frequency):
        if self.repeats:
            return np.interp(t, self.t, self.degrees, period=1.0 / frequency)
        return np.interp(t, self.t, self.degrees, left=np.nan, right=np.nan)


def read(told, study):
    """(list of what was measured, faults) of one angle, or of a list of several."""
    found = [read_one(one, study) for one in (told if isinstance(told, list) and told else [told])]
    angles = [one.angle for one, _ in found if one]
    faults = [fault for _, several in found for fault in several]
    faults += [f"angle = {angle}: stands twice; give each angle once" for angle in ANGLES if angles.count(angle) > 1]
    return [one for one, _ in found], faults


def read_one(told, study):
    """(what was measured of one angle, faults)"""
    keys = {"angle", "series", "file", "repeats", "weight"}
    if not isinstance(told, dict) or not set(told) <= keys or ("series" in told) == ("file" in told):
        return None, ["must be {angle, series} or {angle, file, repeats}, or a list of them; as {angle: theta_R, series: monarch}"]
    angle, weight = told.get("angle"), told.get("weight", 1.0)
    if angle not in ANGLES:
        return None, [f"angle = {angle}: must be one of {', '.join(ANGLES)}"]
    if isinstance(weight, bool) or not isinstance(weight, numbers.Real) or not (math.isfinite(weight) and weight > 0):
        return None, [f"weight = {weight}: must be a number above 0; 1 is usual"]
    if "series" in told:
        return series(angle, float(weight), told["series"])
    if not isinstance(told.get("repeats", False), bool):
        return None, [f"repeats = {told['repeats']}: must be true (the table is one flap) or false"]
    return rows(angle, float(weight), study.parent / str(told["file"]), told.get("repeats", False))


def series(angle, weight, name):
    path = places.config() / "insects" / f"{name}_kinematics.yaml"
    if not path.is_file():
        known = sorted(one.name[:-len("_kinematics.yaml")] for one in path.parent.glob("*_kinematics.yaml"))
        return None, [f"series = {name}: there is none of this name; known are {', '.join(known)}"]
    terms = yaml.safe_load(path.read_text(encoding="utf-8")).get(angle + "_deg")
    if not isinstance(terms, dict):
        return None, [f"series = {name}: has no {angle}_deg"]
    return Series(angle, f"config/insects/{path.name}", weight, terms), []


def rows(angle, weight, path, repeats):
    """From a CSV with columns t [s] and the angle, as theta_R [rad] or theta_R_deg."""
    try:
        table = np.genfromtxt(path, delimiter=",", names=True, comments="#")
    except (OSError, ValueError) as error:
        return None, [f"file: {path} cannot be read as a table: {str(error).splitlines()[0]}"]
    names = table.dtype.names or ()
    unit = next((scale for column, scale in ((angle + "_deg", 1.0), (angle, 180.0 / np.pi)) if column in names), None)
    if unit is None or "t" not in names:
        return None, [f"file: {path} has columns {', '.join(names)}: must have t [s] and {angle} [rad] or {angle}_deg"]
    t, degrees = np.atleast_1d(table["t"]), unit * np.atleast_1d(table[angle + "_deg" if unit == 1.0 else angle])
    if len(t) < 6 or not (np.isfinite(t).all() and np.isfinite(degrees).all() and (np.diff(t) > 0).all()):
        return None, [f"file: {path}: must have six rows or more of finite numbers, its time increasing"]
    return Rows(angle, path.name, weight, t, degrees, repeats), []
