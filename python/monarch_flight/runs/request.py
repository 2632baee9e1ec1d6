"""What a person wants flown: the keys of monarch fly, checked together, every fault at once."""
import dataclasses
import os
import pathlib
import sys
import time

import yaml

from monarch_flight import case_files, keys, places
from monarch_flight.runs import node_keys


def new_folder(name):
    """That of a run for which nobody has named one."""
    return places.flights() / f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"


@dataclasses.dataclass
class Request:
    """A run that may be flown. `values`: the keys that are given or follow from others, paths absolute."""
    values: dict
    folder: pathlib.Path
    leader: str  # who leads the wingbeat
    stays: bool = False  # rviz outlives the flight
    unnamed: str = ""  # the case, where nobody has named a folder

    def given(self, name):
        return self.values.get(name, "")

    def true(self, name):
        return self.given(name) == "true"

    @property
    def plan(self):
        return self.true("plan")

    @property
    def in_process(self):
        return self.true("in_process") or self.plan

    @property
    def ranks(self):
        return int(self.values.get("ranks", 1))

    def begin(self):
        """The run begins now, perhaps long after it was asked for: a folder that nobody has named has this time."""
        if self.unnamed:
            self.folder = places.person_path(new_folder(self.unnamed))
            self.values["out"] = str(self.folder)

    def words(self, taker):
        """key:=value, as another program takes them."""
        table = keys.run_keys().of(taker)
        return [f"{name}:={self.values[name]}" for name in table if name in self.values]


class Check:
    """Collects the faults of a set of values."""

    def __init__(self, values, faults, display):
        self.values, self.faults, self.display = values, faults, display
        self.name = self.unnamed = ""  # of the case, for people
        self.stays, self.asked = False, values.get("rviz") == "true"  # batch runs do not wait for somebody to close it
        self.resumed, self.replayed = values.get("resume"), values.get("replay")

    def fault(self, name, text):
        self.faults.append(f"{name}:={self.values[name]}: {text}")

    def resume(self):
        if not self.resumed:
            return
        if "out" in self.values:
            self.fault("out", "a resumed run goes on in its own folder; leave it out")
        if not os.path.isfile(os.path.join(self.resumed, "case.yaml")):
            self.fault("resume", "not the folder of a run (it has no case.yaml)")
        self.values["resume"] = os.path.abspath(self.resumed)

    def replay(self):
        if not self.replayed:
            return
        for name in ("resume", "case", "guidance_node", "guidance_pkg"):
            if name in self.values:
                self.faults.append(f"replay:={self.replayed} with {name}:={self.values[name]}: give only one of them")
        if self.values.get("guidance", "replay") != "replay":
            self.fault("guidance", "a replay is guidance:=replay; leave one of them out")
        if all(os.path.isfile(os.path.join(self.replayed, name)) for name in ("case.yaml", "flight.csv")):
            self.values["case"] = os.path.join(self.replayed, "case.yaml")
        else:
            self.fault("replay", "not the folder of a recorded flight (it has no case.yaml and flight.csv)")
        self.values["guidance"] = "replay"
        self.values["guidance_file"] = os.path.abspath(os.path.join(self.replayed, "flight.csv"))

    def case(self):
        """Finds the file of the case; what stands in it, as far as it can be read here."""
        wanted = self.values.get("case") or (
            os.path.join(self.resumed, "case.yaml") if self.resumed else keys.run_keys()["case"].default)
        path = case_files.path_of(wanted)
        self.name = pathlib.Path(self.replayed).name if self.replayed and self.replayed != "/" else path.stem
        if os.path.isfile(path):
            shipped = path.parent == places.config() / "cases" and path.stem == wanted
            self.values["case"] = wanted if shipped else os.path.abspath(path)
        elif "case" in self.values:
            cases = case_files.shipped()
            self.fault("case", f"neither a shipped case ({' '.join(cases)}) nor a file"
                       + keys.nearest(wanted, cases))
        try:
            content = case_files.read(path)
        except (OSError, ValueError, RecursionError, yaml.YAMLError):  # whoever flies it says what is wrong
            return {}
        return content if isinstance(content, dict) else {}

    def folder(self):
        named = self.values.get("resume") or self.values.get("out")
        self.unnamed = "" if named else self.name
        out = named or new_folder(self.name)
        folder = places.person_path(out)
        try:
            if not self.resumed and folder.exists() and not (folder.is_dir() and not any(folder.iterdir())):
                self.faults.append(f"out:={out}: holds something already; name a new folder")
        except OSError as error:
            self.faults.append(f"out:={out}: {error.strerror}; name another folder")
        if not self.resumed:
            self.values["out"] = str(folder)
        return folder

    def leader(self, case):
        """The key, else the case."""
        section = case.get("guidance")
        of_case = section.get("type") if isinstance(section, dict) else None
        node = self.values.get("guidance_node")
        leader = self.values.get("guidance") or ("node" if node else of_case or "motion")
        if leader == "node" and not node:
            given = " (guidance:=node)" if "guidance" in self.values else ""
            self.faults.append(f"guidance by a node{given}: name its program by guidance_node:=")
        elif leader != "node" and node:
            self.fault("guidance_node", f"needs guidance:=node, not {leader}")
        if "guidance_pkg" in self.values and not node:
            self.fault("guidance_pkg", "name the program of this package by guidance_node:=")
        if self.values.get("guidance") == "replay" and not self.replayed:
            self.faults.append("guidance:=replay: name the folder of the recorded flight by replay:=")
        return leader

    def wings(self, case):
        """The nodes must know whether the left wing has a fluid of its own."""
        if case.get("wings") == "independent":
            self.values.setdefault("wings", "independent")

    def paths(self):
        """A launch file puts them between quotes into the command of a parameter."""
        if "true" in (self.values.get("in_process"), self.values.get("plan")):
            return
        for name in ("case", "resume", "guidance_file"):
            if set(self.values.get(name, "")) & set('"\\'):
                self.fault(name, 'a run with nodes cannot use a path with " or \\; rename it, or fly with in_process:=true')

    def transport(self):
        """What needs nodes, and a display."""
        if "true" in (self.values.get("in_process"), self.values.get("plan")):
            for name, value in (("rviz", "true"), *((name, None) for name in node_keys.ALL),
                                ("guidance", "commands"), ("paused", "true"), ("rate", None), ("theme", None), ("launch_prefix", None)):
                if name in self.values and value in (None, self.values[name]):
                    self.fault(name, "needs the nodes, so in_process:=false")
            self.values["rviz"] = "false"
        elif not self.display:
            if self.values.get("rviz") == "true":
                self.fault("rviz", "there is no display (DISPLAY is not set)")
            self.values["rviz"] = "false"
        self.stays = self.values.setdefault("rviz", "true") == "true" and (self.asked or sys.stdout.isatty())


def request(words, environment=None):
    """The Request of these key:=value words. Raises keys.Refused with every fault."""
    environment = os.environ if environment is None else environment
    values, _, faults = keys.run_keys().of("fly").read(words)
    check = Check(values, faults, environment.get("DISPLAY"))
    check.resume()
    check.replay()
    case = check.case()
    folder = check.folder()
    leader = check.leader(case)
    check.wings(case)
    check.transport()
    check.paths()
    if faults:
        raise keys.Refused(*faults)
    return Request(values, folder, leader, check.stays, check.unnamed)
