"""Whether a flight that is led has settled, and the case of its periodic flight (monarch settle, docs/trim.md)."""
import dataclasses
import math
import os
import pathlib
import re
import sys

import numpy as np

from monarch_flight import case_files
from monarch_flight.command.settle import KEYS
from monarch_flight.keys import Refused
from monarch_flight.settling import settled_case, settled_motion
from monarch_flight.settling.led_flight import ANGLE, COMMANDS, LedFlight, Unfit, shown


@dataclasses.dataclass
class Bounds:
    """What settled means, over the last `flaps` flaps."""
    flaps: int = 3
    repeat: float = 0.02  # largest scaled change of the state over a flap
    angle: float = 0.1  # largest change of a command's mean from flap to flap, of an angle [deg]
    relative: float = 0.002  # of a relative command

    def of(self, name):
        """For a command's mean, in its own unit (rad or relative)."""
        return math.radians(self.angle) if COMMANDS[name] == ANGLE else self.relative


@dataclasses.dataclass
class Verdict:
    """Largest changes over the last flaps; `reasons`: why it has not settled, empty when it has."""
    flaps: list  # those judged
    change: float
    command_changes: dict
    reasons: list

    def mean(self, name):
        return float(np.mean([flap.means[name] for flap in self.flaps]))

    @property
    def means(self):
        """Of every command over the flaps judged."""
        return {name: self.mean(name) for name in COMMANDS}

    @property
    def span(self):
        first, last = self.flaps[0].number, self.flaps[-1].number
        return f"flap {first}" if first == last else f"flaps {first} to {last}"


def judge(flight, bounds):
    """Each of the last flaps against itself one flap later, its mean commands against those of the flap before."""
    judged = flight.flaps[-bounds.flaps:]
    free = sum(flap.free for flap in flight.flaps)
    reasons = []
    if free <= bounds.flaps:
        reasons.append(f"it has {free} whole free flaps: flaps:={bounds.flaps} needs {bounds.flaps + 1}")
    change = float(np.max([flap.change for flap in judged]))  # NaN stays
    if not change <= bounds.repeat:
        reasons.append(f"a flap repeats within {change:.3g} (scaled): must be {bounds.repeat:g}")
    compared = flight.flaps[-bounds.flaps - 1:]
    changes = {name: float(np.max(np.abs(np.diff([flap.means[name] for flap in compared])), initial=0.0)) for name in flight.used}
    for name, value in changes.items():
        if not value <= bounds.of(name):
            reasons.append(f"the mean of {name} changes by {shown(name, value):.3g} {COMMANDS[name]} a flap: "
                           f"must be {shown(name, bounds.of(name)):.3g}")
    if flight.lost_from() is not None:
        reasons.append(f"the controller gave up in flap {flight.lost_from()}")
    return Verdict(judged, change, changes, reasons)


def head(flight):
    air = flight.case["fluid"]["solver"].replace("_", "-")
    text = f"{flight.folder}: {flight.case['name']}, {air} air, led by {flight.kind}"
    for flap, speed, climb in flight.set_points():
        text += f"\nset point from flap {flap + 1:g} on: {speed:.4g} m/s, climb {climb:.4g} deg"
    return text


def table(flight):
    """A line per flap."""
    yield ("flap  speed m/s  climb deg  theta_B mean, swing deg  "
           + "".join(f"{f'{name} {COMMANDS[name]} mean, from, to':>41s}" for name in flight.used) + f"{'change':>10s}")
    for flap in flight.flaps:
        commands = "".join(f"{shown(name, flap.means[name]):>21.3f} {shown(name, flap.lows[name]):>9.3f} "
                           f"{shown(name, flap.highs[name]):>9.3f}" for name in flight.used)
        yield (f"{flap.number:4d}{flap.speed:11.4f}{math.degrees(flap.climb):11.3f}{math.degrees(flap.theta_B_mean):16.2f}"
               f"{math.degrees(flap.theta_B_swing):9.2f}  {commands}{flap.change:10.2g}" + ("" if flap.free else "  prescribed"))


def mean_commands(flight, verdict):
    return ", ".join(f"{name} {shown(name, verdict.mean(name)):+.4f} {COMMANDS[name]}" for name in flight.used) or "none"


def words_of(flight, verdict, bounds):
    """The verdict in sentences."""
    yield f"mean commands of {verdict.span}: {mean_commands(flight, verdict)}"
    rows = slice(verdict.flaps[0].first, verdict.flaps[-1].last + 1)
    cut = np.ptp(flight.columns["clipped"][rows])
    if cut:
        yield f"note: {cut:.0f} commands of these flaps were cut to their bounds"
    if verdict.reasons:
        yield "not settled: " + "\n             ".join(verdict.reasons)
        return
    means = ", ".join(f"{name} by {shown(name, value):.2g} (bound {shown(name, bounds.of(name)):.2g} {COMMANDS[name]})"
                      for name, value in verdict.command_changes.items())
    yield (f"settled: in {verdict.span} a flap repeats within {verdict.change:.2g} (bound {bounds.repeat:g}, scaled)"
           + (f"; from flap to flap the means change at most: {means}" if means else ""))


def settings_from(words):
    """Folder, bounds, path of the case to write (or None). Raises Refused."""
    values, folders, faults = KEYS.read(words, plain=True)
    if len(folders) != 1:
        faults.append(f"{len(folders)} folders given: must be one, that of a flight that was led; as flights/climb_controlled")
    out = pathlib.Path(values["out"]) if "out" in values else None
    if out is not None and (out.suffix != ".yaml" or not re.fullmatch(r"[A-Za-z0-9_.-]{1,200}", out.stem)):
        faults.append(f"out:={out}: must end in .yaml, its name of letters, digits and _ - . only; it names the case")
    if out is not None and os.path.lexists(out):
        faults.append(f"out:={out}: exists already; name another file or move that one away")
    if faults:
        raise Refused(*faults)
    numbers = {key: (int if key == "flaps" else float)(value) for key, value in values.items() if key != "out"}
    return pathlib.Path(folders[0]), Bounds(**numbers), out


def write(flight, verdict, out):
    """The case of the periodic flight; a file is there whole or not at all."""
    content, comments, heading = settled_case.settled(flight, verdict, out.stem)
    out.parent.mkdir(parents=True, exist_ok=True)
    active = out.with_name(out.name + ".active")
    active.write_text(heading + case_files.text(content, comments), encoding="utf-8")
    active.rename(out)


def led_flight(folder, folding):
    """The flight in a folder; refused when it has not what is needed."""
    flight = LedFlight(folder)
    if flight.kind not in ("controller", "commands", "node"):
        raise Unfit(f"{folder}: guidance/type = {flight.kind}: must be controller, commands or node, by which a flight is led; "
                    "give the folder of such a flight")
    if not flight.flaps:
        raise Unfit(f"{folder}: holds no whole flap; fly more")
    if flight.case.get("wings") == "independent":
        raise Unfit(f"{folder}: wings = independent: must be mirrored, for what is folded is what both wings do; "
                    "fly it with wings:=mirrored")
    if folding:
        settled_motion.check(flight)
    return flight


def main(words):
    """Exit code: 0 settled (and written), 1 not settled. Raises Refused."""
    folder, bounds, out = settings_from(words)
    flight = led_flight(folder, out is not None)
    verdict = judge(flight, bounds)
    print(head(flight), *table(flight), *words_of(flight, verdict, bounds), sep="\n")
    if out is not None and verdict.reasons:
        print(f"settle: out:={out}: not written, for the flight has not settled; fly more flaps, or give wider bounds",
              file=sys.stderr)
    elif out is not None:
        write(flight, verdict, out)
        print(f"case: {out}")
    return 1 if verdict.reasons else 0
