"""What monarch identify is asked for: a study, read from YAML and checked (docs/identification.md)."""
import copy
import dataclasses
import difflib
import math
import numbers
import os
import pathlib
import re

import yaml

from monarch_flight import case_files, places
from monarch_flight.identification import measured
from monarch_flight.keys import Refused, nearest

KEYS = ("name", "case", "set", "unknown", "measured", "compare", "difference", "stages")
QUIET = dict(record=False, checkpoint_every=0, surface_every=0, flow_every=0, fields_every=0)


@dataclasses.dataclass(frozen=True)
class Unknown:
    """A number of the case that is sought."""
    key: str  # of the case, as insect/wing/kappa or, of a list, insect/wing/root/0
    start: float
    low: float
    high: float

    @property
    def short(self):
        """The last part of the key; of a list with its name."""
        above, _, last = self.key.rpartition("/")
        return f"{above.rpartition('/')[2]}/{last}" if last.isdecimal() else last

    def value(self, share):
        """At a share of its range, rounded so that a case file shows it whole."""
        return float(f"{self.low + share * (self.high - self.low):.12g}")

    def share(self, value):
        return (value - self.low) / (self.high - self.low)


@dataclasses.dataclass(frozen=True)
class Stage:
    """Air, grid and time step of a part of the search; what it leaves out is as in the stage before."""
    name: str
    changes: dict  # of the case, by its keys


@dataclasses.dataclass
class Study:
    name: str
    case: dict  # content of the case file, `set` included
    origin: pathlib.Path  # that file
    set: dict  # what the study puts into it
    unknowns: list
    measured: list  # one an angle
    flaps: list  # compared, counted from 1
    difference: float  # of the Jacobian, in shares of a range
    stages: list

    def content(self, stage, values):
        """The case of a flight."""
        content = copy.deepcopy(self.case)
        for key, value in stage.changes.items():
            place(content, key, value)
        for unknown, value in zip(self.unknowns, values):
            place(content, unknown.key, value)
        return content

    def flown(self, stage, values):
        """The same, as long as it is compared and without files that nobody reads."""
        content = self.content(stage, values)
        content["time"]["flaps"] = max(self.flaps)
        content["output"] = dict(QUIET)
        return content


def place(content, key, value):
    """Puts a value at a key of a case. Raises Refused where the path leads through a number."""
    *above, last = key.split("/")
    for n, step in enumerate(above):
        content = content.setdefault(step, {})
        if not isinstance(content, dict) and not (isinstance(content, list) and n + 1 == len(above)):
            raise Refused(f"{key}: {step} is no section of the case; give a key as docs/case_files.md has it")
    if last.isdecimal() and not isinstance(content, list):
        raise Refused(f"{key}: {above[-1] if above else key} is no list of the case (one of its preset does not count); give the whole list by set first")
    content[item(content, last, key) if isinstance(content, list) else last] = copy.deepcopy(value)


def item(values, step, key):
    """Place in a list of the case."""
    if not (step.isdecimal() and int(step) < len(values)):
        raise Refused(f"{key}: {step} is no place in this list of {len(values)}; they are counted from 0")
    return int(step)


class Check:
    """Reads the parts of a study, collects the faults."""

    def __init__(self, path, content):
        self.path, self.content, self.faults = path, content, []
        for key in content:
            if key not in KEYS:
                near = difflib.get_close_matches(str(key), KEYS, 1, 0.6)
                self.fault(key, "unknown" + (f"; did you mean '{near[0]}'?" if near else f"; known are {', '.join(KEYS)}"))

    def fault(self, key, text):
        self.faults.append(f"{self.path.name}: {key}: {text}")

    def section(self, key):
        value = self.content.get(key)
        if isinstance(value, dict) and value:
            return value
        self.fault(key, "is missing or no section; docs/identification.md has an example")
        return {}

    def name(self):
        name = self.content.get("name", self.path.stem)
        if not re.fullmatch(r"[A-Za-z0-9_.-]{1,200}", str(name)):
            self.fault("name", f"'{name}': must be of letters, digits and _ - . only; it names the case")
        return str(name)

    def case(self):
        """(path, content)"""
        wanted = self.content.get("case")
        path = case_files.path_of(wanted) if isinstance(wanted, str) else None
        if path is not None and not path.is_absolute():
            path = self.path.parent / path
        if path is None or not os.path.isfile(path):
            near = difflib.get_close_matches(str(wanted), case_files.shipped(), 1, 0.6)
            self.fault("case", f"'{wanted}': neither a shipped case nor a file" + (f"; did you mean '{near[0]}'?" if near else ""))
            return self.path, {}
        try:
            content = case_files.read(path)
        except (OSError, ValueError, yaml.YAMLError) as error:
            self.fault("case", f"{path} cannot be read: {error}")
            return path, {}
        content = content if isinstance(content, dict) else {}
        time, motion = content.get("time"), content.get("motion")
        if not (isinstance(time, dict) and "steps_per_flap" in time and isinstance(motion, dict) and number(motion.get("frequency"))):
            self.fault("case", f"{path}: must have motion/frequency and time/steps_per_flap; flaps are compared")
        return path, content

    def set(self):
        value = self.content.get("set", {})
        if not isinstance(value, dict):
            self.fault("set", "must be keys of the case with their values; as {insect/wing/mass: 3.7e-5}")
            return {}
        return value

    def unknowns(self):
        found = []
        for key, told in self.section("unknown").items():
            start, span = (told.get(part) for part in ("start", "range")) if isinstance(told, dict) else (None, None)
            if not (number(start) and isinstance(span, list) and len(span) == 2 and all(map(number, span)) and set(told) == {"start", "range"}):
                self.fault(f"unknown/{key}", "must be {start: number, range: [low, high]}")
            elif not span[0] < start < span[1]:
                self.fault(f"unknown/{key}", f"start = {start:g}: must lie within its range, {span[0]:g} to {span[1]:g}, and not on its end")
            else:
                found.append(Unknown(str(key), float(start), float(span[0]), float(span[1])))
        return found

    def flaps(self):
        flaps = self.content.get("compare")
        if not (isinstance(flaps, list) and flaps and all(isinstance(flap, int) and flap >= 1 for flap in flaps)
                and len(set(flaps)) == len(flaps)):
            self.fault("compare", f"{flaps}: must be a list of flaps, counted from 1, as [3, 4]")
            return [1]
        return sorted(flaps)

    def difference(self):
        share = self.content.get("difference", 0.005)
        if not (number(share) and 1e-6 <= share <= 0.1):
            self.fault("difference", f"{share}: must be in [1e-6, 0.1], shares of a range; 0.005 is usual")
        return share

    def stages(self):
        told, found, changes = self.content.get("stages"), [], {}
        if not (isinstance(told, list) and told and all(isinstance(stage, dict) for stage in told)):
            self.fault("stages", "must be a list of {fluid, grid, steps_per_flap}, coarse to fine, each of them optional")
            return found
        for n, stage in enumerate(told, 1):
            if not set(stage) <= {"name", "fluid", "grid", "steps_per_flap"}:
                self.fault(f"stages[{n}]", f"has {', '.join(map(str, stage))}: must have name, fluid, grid, steps_per_flap only")
                continue
            changes = dict(changes)
            if "fluid" in stage:
                changes["fluid/solver"] = stage["fluid"]
            if "grid" in stage:
                changes["grid"] = stage["grid"] if isinstance(stage["grid"], dict) else dict(level=stage["grid"])
            if "steps_per_flap" in stage:
                changes["time/steps_per_flap"] = stage["steps_per_flap"]
            found.append(Stage(str(stage.get("name", f"stage {n}")), changes))
        return found


def number(value):
    return isinstance(value, numbers.Real) and not isinstance(value, bool) and math.isfinite(value)


def read(path):
    """The study in a file. Raises Refused with every fault."""
    path = pathlib.Path(path)
    if not path.is_file():
        shipped = sorted(one.stem for one in (places.config() / "studies").glob("*.yaml"))
        raise Refused(f"{path}: neither a study of config/studies nor a file{nearest(path.name, shipped)}; shipped are {', '.join(shipped)}")
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), case_files.CaseLoader)
    except (ValueError, yaml.YAMLError) as error:
        raise Refused(f"{path}: is not YAML: {error}") from None
    if not isinstance(content, dict):
        raise Refused(f"{path}: holds no keys; docs/identification.md has an example")
    check = Check(path, content)
    name, (origin, case), unknowns = check.name(), check.case(), check.unknowns()
    flaps, difference, stages = check.flaps(), check.difference(), check.stages()
    for key, value in check.set().items():
        place(case, key, value)
    angles, faults = measured.read(content.get("measured"), path)
    for fault in faults:
        check.fault("measured", fault)
    if check.faults:
        raise Refused(*check.faults)
    study = Study(name, case, origin, check.set(), unknowns, angles, flaps, difference, stages)
    study.content(stages[0], [unknown.start for unknown in unknowns])  # a path that leads through a number is told now
    return study
