"""Flights led by a guidance node of one's own, for the tests: examples/climb_guidance.py."""
import os
import re

import yaml

import flying

AIR = ("fluid:=quasi_steady", "steps_per_flap:=100")
CLIMB = ("case:=climb_trimmed", *AIR)
LED = "guidance_node:=climb_guidance.py"


class Guided(flying.FlightTest):
    def case(self, name="case", **changes):
        """climb_trimmed with other values: section/key as section__key."""
        with open(os.path.join(flying.ROOT, "config", "cases", "climb_trimmed.yaml")) as f:
            case = yaml.safe_load(f)
        for place, value in changes.items():
            section = case
            *path, key = place.split("__")
            for part in path:
                section = section.setdefault(part, {})
            section[key] = value
        path = os.path.join(self.folder, name + ".yaml")
        with open(path, "w") as f:
            yaml.safe_dump(case, f)
        return "case:=" + path

    def complete(self, name, *keys, **more):
        code, output = self.fly(*keys, "out:=" + self.out(name), **more)
        self.assertEqual(code, 0, output)
        self.assertEqual(flying.summary(self.out(name))["status"], "complete", output)

    def sha(self, name):
        return flying.summary(self.out(name))["state_sha256"]

    def pids(self, process):
        return {name: int(pid) for name, pid in re.findall(
            r"process\[monarch_flight/(\w+)-\d+\]: started with pid \[(\d+)\]",
            self.output(process))}
