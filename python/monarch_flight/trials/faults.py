"""The faults of monarch break-it: a flight over nodes, what strikes it, and what must come of it."""
import glob
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import time

from monarch_flight import places
from monarch_flight.trials.watched_flight import Flight

ROOT = str(places.source())
EVERY = 25  # steps between checkpoints
# s; two processes of a flow share a busy core
WATCHDOG = {"quasi_steady": 4.0, "two_wings": 4.0, "navier_stokes": 20.0, "navier_stokes_two_wings": 30.0}
UNHARMED = 60.0  # s: what is left of a flight, on a busy machine
AIR = {"quasi_steady": ("fluid:=quasi_steady", "flaps:=0.5", "steps_per_flap:=400"),
       "navier_stokes": ("fluid:=navier_stokes", "grid:=preview", "flaps:=0.25", "steps_per_flap:=300", "ranks:=2")}
AIR.update({"two_wings": (*AIR["quasi_steady"], "wings:=independent"),
            "navier_stokes_two_wings": (*AIR["navier_stokes"], "wings:=independent")})
SHIFTED_CLOCK = os.path.join(ROOT, "test", "flights", "shifted_clock.c")


class Fault:
    """name; act(flight) strikes a flight under way; says: what its end must name (None: unharmed)."""

    def __init__(self, name, act, says, limit=40.0, air="quasi_steady", random=True, **environment):
        self.name, self.act, self.says, self.limit = name, act, says, limit
        self.air, self.random, self.environment = air, random, environment


def sent(name, what):
    def act(flight):
        os.kill(flight.pids()[name], what)
    return act


def stopped(name, seconds):
    def act(flight):
        pid = flight.pids()[name]
        os.kill(pid, signal.SIGSTOP)
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline and flight.process.poll() is None:
            time.sleep(0.05)
        try:
            os.kill(pid, signal.SIGCONT)
        except ProcessLookupError:
            pass
    return act


def full(node, bytes_left):
    """No file of this node may grow beyond the limit: the disk is full for it."""
    def act(flight):
        pid = flight.pids()[node]
        size = bytes_left
        if node == "coordinator":
            size = os.path.getsize(os.path.join(flight.folder, bytes_left + ".active"))
        hard = resource.prlimit(pid, resource.RLIMIT_FSIZE)[1]
        resource.prlimit(pid, resource.RLIMIT_FSIZE, (size, hard))
    return act


def damaged(damage):
    """The flight is killed, then its newest checkpoint is damaged."""
    def act(flight):
        os.kill(flight.pids()["coordinator"], signal.SIGKILL)
        flight.end(40)
        newest = sorted(glob.glob(flight.folder + "/checkpoints/step_??????????"))[-1]
        damage(newest)
        flight.damaged = os.path.basename(newest)
    return act


def truncate(folder):
    path = os.path.join(folder, "fluid.h5")
    os.truncate(path, os.path.getsize(path) // 2)


def flip(folder):
    path = os.path.join(folder, "coordinator.h5")
    with open(path, "r+b") as f:
        f.seek(os.path.getsize(path) // 2)
        byte = f.read(1)[0]
        f.seek(-1, os.SEEK_CUR)
        f.write(bytes([byte ^ 16]))


def foreign(folder):
    older = sorted(glob.glob(os.path.dirname(folder) + "/step_??????????"))[0]
    shutil.rmtree(folder)
    shutil.copytree(older, folder)


def clock(seconds):
    def act(flight):
        with open(flight.folder + ".clock", "w") as f:
            f.write("%d" % seconds)
    return act


NODES = ("fluid", "flight", "wing", "coordinator")
FAULTS = (
    [Fault("SIGKILL " + node, sent(node, signal.SIGKILL), "node monarch_flight/%s died" % node) for node in NODES]
    + [Fault("SIGKILL master", sent("master", signal.SIGKILL), "the ROS master died"),
       Fault("SIGKILL mpirun", sent("fluid", signal.SIGKILL), "node monarch_flight/fluid died",
             limit=60.0, air="navier_stokes"),
       Fault("SIGINT run", lambda flight: flight.process.send_signal(signal.SIGINT), "stopped by hand")]
    + [Fault("SIGKILL fluid_left", sent("fluid_left", signal.SIGKILL), "node monarch_flight/fluid_left died", air="two_wings"),
       Fault("SIGSTOP fluid_left, 1 s", stopped("fluid_left", 1.0), None, limit=UNHARMED, air="two_wings"),
       Fault("SIGSTOP fluid_left, too long", stopped("fluid_left", 60.0), "the fluid_left node", limit=75.0, air="two_wings"),
       Fault("disk full: checkpoint of fluid_left", full("fluid_left", 1000), "fluid_left.h5.active cannot be written",
             air="two_wings"),
       Fault("SIGKILL mpirun of fluid_left", sent("fluid_left", signal.SIGKILL), "node monarch_flight/fluid_left died",
             limit=90.0, air="navier_stokes_two_wings")]
    + [Fault("SIGSTOP %s, 1 s" % node, stopped(node, 1.0), None, limit=UNHARMED) for node in NODES]
    + [Fault("SIGSTOP %s, too long" % node, stopped(node, 60.0), words, limit=75.0)
       for node, words in (("fluid", "the fluid node"), ("flight", "the flight node"), ("wing", "the wing node"),
                           ("coordinator", "has been silent for"))]
    + [Fault("disk full: flight.bag", full("coordinator", "flight.bag"), "flight.bag.active"),
       Fault("disk full: checkpoint", full("fluid", 1000), "fluid.h5.active cannot be written"),
       Fault("checkpoint truncated", damaged(truncate), "fluid.h5 has"),
       Fault("checkpoint with a flipped bit", damaged(flip), "coordinator.h5 has changed"),
       Fault("checkpoint of another step", damaged(foreign), "is a checkpoint of step"),
       Fault("clock jumps an hour forth", clock(3600), None, limit=UNHARMED, clock="1"),
       Fault("clock jumps an hour back", clock(-3600), None, limit=UNHARMED, clock="1")])


class Bench:
    """Flies one undisturbed flight of each kind of air, and compares the broken ones with it."""

    def __init__(self, work, random):
        self.work, self.random, self.count, self.hashes = work, random, 0, {}
        self.folder = ""

    def keys(self, air):
        case = os.path.join(self.work, "impatient_%s.yaml" % air)
        if not os.path.exists(case):
            with open(os.path.join(ROOT, "config", "cases", "climb.yaml")) as f:
                text = f.read()
            with open(case, "w") as f:
                f.write(text + "\nwatchdog_s: %g\n" % WATCHDOG[air])
        return ("case:=" + case, "checkpoint_every:=%d" % EVERY, *AIR[air])

    def undisturbed(self, air):
        if air not in self.hashes:
            folder = os.path.join(self.work, "undisturbed_" + air)
            whole = () if air == "navier_stokes_two_wings" else ("in_process:=true",)  # two flows have a node each
            flight = Flight(folder, (*self.keys(air), *whole, "out:=" + folder), {})
            if flight.end(600) != 0:
                raise SystemExit("break-it: the undisturbed flight failed:\n" + flight.output())
            self.hashes[air] = summary(folder)["state_sha256"]
        return self.hashes[air]

    def prefix(self, fault, folder):
        """Keys that start the nodes with a clock of their own, where the fault needs one."""
        if "clock" in fault.environment:
            with open(folder + ".clock", "w") as f:
                f.write("0")
            library = os.path.join(self.work, "shifted_clock.so")
            if not os.path.exists(library):
                subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, SHIFTED_CLOCK, "-ldl"], check=True)
            return ("launch_prefix:=env LD_PRELOAD=%s CLOCK_SHIFT_FILE=%s.clock" % (library, folder),)
        return ()

    def trial(self, fault):
        self.count += 1
        self.folder = folder = os.path.join(self.work, "flight_%d" % self.count)
        result = {"good": False, "unharmed": False, "end_s": None, "again": None, "said": "", "verdict": ""}
        expected = self.undisturbed(fault.air)
        slow = {} if flows(fault.air) else {"MONARCH_ANSWER_DELAY_MS": "8"}
        flight = Flight(folder, (*self.keys(fault.air), "out:=" + folder, *self.prefix(fault, folder)), slow)
        last = 70 if flows(fault.air) else 190
        flight.wait_for_step(self.random.randint(2 * EVERY + 2, last - 10))
        time.sleep(self.random.uniform(0.0, 0.02))
        begin = time.monotonic()
        try:
            fault.act(flight)
        except (KeyError, ProcessLookupError, FileNotFoundError) as e:
            result["verdict"] = "could not strike: %r" % e
            flight.end(40)
            return result
        code = flight.end(max(fault.limit - (time.monotonic() - begin), 1.0))
        result["end_s"] = round(time.monotonic() - begin, 1)
        return self.judge(fault, flight, code, expected, result)

    def judge(self, fault, flight, code, expected, result):
        left = flight.leftovers()
        if not os.path.isdir(flight.folder):
            result["verdict"] = "never flown:\n" + flight.output()
            return result
        if code is None or left:
            result["verdict"] = "a hang" if code is None else "still alive: " + ", ".join(left)
            return result
        if code == 0:
            result["unharmed"] = summary(flight.folder)["state_sha256"] == expected
            result["good"] = result["unharmed"] and fault.says is None
            result["verdict"] = "a WRONG flight" if not result["unharmed"] else \
                "unharmed" if result["good"] else "unharmed: the fault did NOT STRIKE"
            return result
        flown = flight.step()
        again = Flight(flight.folder, ("resume:=" + flight.folder, *ranks(fault.air)), {})
        if again.end(600) != 0 or summary(flight.folder)["state_sha256"] != expected:
            result["verdict"] = "not resumed to the same flight"
            return result
        text = flight.output()
        said = [line for line in text.splitlines() if fault.says and fault.says in line]
        resumed = summary(flight.folder)["resumed"][-1]["step"]
        result["again"] = flown - resumed
        result["said"] = tidy(said[0], flight.folder) if said else ""
        bound = EVERY * (2 if hasattr(flight, "damaged") else 1)
        result["good"] = bool(said) and result["again"] <= bound and fault.says is not None
        result["verdict"] = "ended (%s), resumed from step %d, %d steps again" % (
            result["said"] if said else "WITHOUT NAMING ITS CAUSE", resumed, result["again"])
        return result


def flows(air):
    return air.startswith("navier_stokes")


def ranks(air):
    return ("ranks:=2",) if flows(air) else ()


def tidy(line, folder):
    line = re.sub(r"\x1b\[[0-9;]*m", "", line).replace(folder + "/", "").strip()
    return re.sub(r"^=+", "", line)[:160]


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as f:
        return json.load(f)
