"""What is told of a run that has ended, and the exit code of monarch fly."""
import os
import shlex

from monarch_flight.runs import node_keys, reporting, summary
from monarch_flight.telling import FAILED, STOPPED, passed_on, say, signal_of

REFUSED = 2
KEPT = ("ranks", *node_keys.ALL)  # keys that a resumed run needs again


def how(exit_code):
    """died (SIGKILL), or ended with exit code 1."""
    if exit_code is None:
        return "could not be started"
    name = signal_of(exit_code)
    return f"died ({name})" if name else f"ended with exit code {exit_code}"


def nodes(facts):
    """What became of nodes that did not end well."""
    for fact in facts:
        if fact["exit_code"] in (0, REFUSED):
            continue
        name = "the ROS master" if fact["ended"] == "master" else "the node " + fact["ended"]
        say(f"{name} {how(fact['exit_code'])}, " + ("which ended the run" if fact["needed"] else "the flight went on"))


class Ending:
    """Of the run of a request, which began at `begin` [ns]; `command`: how the person calls monarch fly."""

    def __init__(self, request, begin, command):
        self.request, self.begin, self.command, self.folder = request, begin, command, request.folder

    def written(self, name):
        """By this run."""
        try:
            return os.stat(self.folder / name).st_mtime_ns >= self.begin
        except OSError:
            return False

    def told(self):
        """The summary of this run, empty where it has not written one."""
        return (summary.load(self.folder)[0] or {}) if self.written("summary.json") else {}

    def again(self):
        keys = [f"{key}:={self.request.values[key]}" for key in KEPT if key in self.request.values]
        return " ".join([self.command] + [shlex.quote(word) for word in [f"resume:={self.folder}"] + keys])

    def has_checkpoint(self):
        return any(self.folder.glob("checkpoints/step_*/manifest.json"))

    def stopped(self):
        told = self.told()
        flown = told["steps"] > 0 if told else self.written("flight.csv") or self.written("flight.csv.active")
        if not flown:
            resumed = f" since the last checkpoint; go on with {self.again()}" if self.request.given("resume") else ""
            say("stopped by hand before the first step: nothing was flown" + resumed)
        elif self.has_checkpoint():
            say(f"stopped by hand; what was flown is in {self.folder}, and goes on with {self.again()}")
        else:
            say(f"stopped by hand; what was flown is in {self.folder}, which has no checkpoint to go on from")
        return STOPPED

    def of(self, code, facts, by_hand):
        """Exit code, after the words."""
        over = any("over" in fact for fact in facts)  # by itself; then only rviz was ended by hand
        facts = [fact for fact in facts if "ended" in fact]
        if by_hand and not over and self.told().get("status") != "complete":
            return self.stopped()
        nodes(facts)
        code = passed_on(code, "the program that flies" if self.request.in_process else "the launcher", "fly")
        refused = code == REFUSED or any(fact["exit_code"] == REFUSED for fact in facts if fact["needed"])
        if not self.written("summary.json") and (code or refused or self.request.given("resume")):
            if self.written("flight.csv.active"):
                say(f"a process was lost, which ended the run; what was flown is in {self.folder}")
            else:
                say("not flown; the reason is above")
            return REFUSED if refused else code or FAILED
        page = reporting.written(self.folder) if reporting.wanted(self.request) and self.told().get("steps") else None
        code = summary.show(self.folder)
        if page:
            print(f"see the flight in a browser: {page}")
        return code
