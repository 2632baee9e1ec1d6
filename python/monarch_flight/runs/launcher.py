"""Starts the nodes of a flight by the API of roslaunch, and tells facts of their ends, a line of JSON each.

usage: python3 -m monarch_flight.runs.launcher FACTS PORT RVIZ LAUNCH_FILE [KEY:=VALUE ...] FACTS is the number of an
open file; PORT that of a master to start, 0 where one runs; RVIZ is stays where rviz outlives the flight until it is
closed, else ends. Exit code: 0 the needed nodes ended well, 1 one of them did not, 2 the launch file or its arguments
are refused. """
import json
import os
import re
import signal
import sys
import threading
import time

REFUSED = 2  # exit code of a node
LAST_WORD = 3.0  # s, for a coordinator whose nodes have gone before it


class Interrupt:
    """Ctrl-C: before there are processes the end; later roslaunch ends them, and this only notes it."""

    def __init__(self):
        self.heard = self.launching = False
        signal.signal(signal.SIGINT, self)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])  # held back until now

    def __call__(self, *_):
        self.heard = True
        if not self.launching:
            os._exit(130)


interrupt = Interrupt() if __name__ == "__main__" else None  # what follows takes its time

import rospkg  # noqa: E402
import roslaunch  # noqa: E402
import roslaunch.core  # noqa: E402
import roslaunch.parent  # noqa: E402
import roslaunch.pmon  # noqa: E402
import roslaunch.rlutil  # noqa: E402

from monarch_flight.runs import node_program  # noqa: E402
from monarch_flight.runs.master import ROLES  # noqa: E402


RVIZ = "show.py"  # type of its node
ESCAPES = re.compile(r"\033\[[0-9;]*m|\033\][^\007]*\007\n?")


class Plain:
    """A stream without the escape codes of roslaunch (bold, red, the title of the window)."""

    def __init__(self, stream):
        self.stream = stream

    def write(self, text):
        return self.stream.write(ESCAPES.sub("", text))

    def __getattr__(self, name):
        return getattr(self.stream, name)


class Facts(roslaunch.pmon.ProcessListener):
    """Tells which process ended, and how; the end of a needed one ends them all, but for rviz where that stays."""

    def __init__(self, number, stays):
        self.file, self.needed, self.pm, self.code = os.fdopen(number, "w", encoding="utf-8"), {"master"}, None, 0
        self.stays, self.over, self.rviz = stays, False, set()  # names
        self.flown = True  # not refused by the coordinator

    def tell(self, **fact):
        try:
            print(json.dumps(fact), file=self.file, flush=True)
        except OSError:
            pass  # whoever listened is gone

    def process_died(self, process_name, exit_code):
        name = process_name if process_name in self.needed else process_name.rpartition("-")[0]
        if self.over:
            if name in self.rviz or name == "master":
                self.pm.shutdown()
            return
        self.ended(name, exit_code)
        if name in self.needed:
            self.last_word(process_name)
            self.end(exit_code, stays=name != "master")

    def ended(self, name, exit_code):
        self.tell(ended=name, exit_code=exit_code, needed=name in self.needed)
        if name.endswith("coordinator"):
            self.flown = exit_code != REFUSED

    def last_word(self, ended):
        """Tells how the coordinator ends, which knows what became of the run, where another node has `ended` before
        it."""
        for name in set(self.pm.get_active_names()) - {ended}:
            role = name.rpartition("-")[0]
            process = self.pm.get_process(name) if role in self.needed and role.endswith("coordinator") else None
            deadline = time.monotonic() + LAST_WORD
            while process is not None and process.is_alive() and time.monotonic() < deadline:
                time.sleep(0.05)
            if process is not None and process.exit_code is not None:
                self.ended(role, process.exit_code)

    def end(self, exit_code, stays=True):
        self.code = 1 if exit_code else self.code
        watched = [name for name in self.pm.get_active_names() if name.rpartition("-")[0] in self.rviz]
        if not (stays and self.stays and watched and self.flown):
            self.pm.shutdown()
            return
        self.over = True
        self.tell(over=True)
        print("fly: the flight is over; rviz stays until you close it or press Ctrl-C, then the summary comes", flush=True)
        threading.Thread(target=self.end_needed, daemon=True).start()

    def end_needed(self):
        """All nodes of the flight, as its end without rviz does."""
        for name in self.pm.get_active_names():
            process = self.pm.get_process(name)
            if process is not None and name.rpartition("-")[0] in self.needed:
                process.stop([])

    def missing(self):
        """Needed nodes that could not be started."""
        alive, ended = self.pm.get_process_names_with_spawn_count()
        seen = {name.rpartition("-")[0] for name, _ in alive + ended} | {"master"}
        for name in sorted(self.needed - seen) if not self.pm.is_shutdown else ():
            self.tell(ended=name, exit_code=None, needed=True)
            self.end(1, stays=False)


class Launcher(roslaunch.parent.ROSLaunchParent):
    """The parent of roslaunch; what its monitor says of ends is left to the facts, for it calls a good end a death."""

    def __init__(self, facts, *arguments, **options):
        super().__init__(*arguments, **options)
        self.facts = facts

    def _load_config(self):
        super()._load_config()
        # A flight ends with any of its own nodes.
        names = {(node.namespace + node.name).strip("/"): node for node in self.config.nodes}
        self.facts.needed |= {name for name, node in names.items() if node.name in ROLES}
        self.facts.rviz = {name for name, node in names.items() if node.type == RVIZ}

    def _init_runner(self):
        super()._init_runner()
        roslaunch.pmon._init_signal_handlers()  # else with the first process
        interrupt.launching = True

    def _start_pm(self):
        super()._start_pm()
        self.facts.pm = self.pm
        self.pm.add_process_listener(self.facts)
        told = roslaunch.core.printerrlog
        roslaunch.pmon.printlog_bold = lambda text: None
        roslaunch.pmon.printerrlog = lambda text: told(text) if self.pm.is_shutdown else None  # who would not end


def launch(facts, port, file, words):
    """Exit code."""
    run_id = roslaunch.rlutil.get_or_generate_uuid(None, False)
    roslaunch.configure_logging(run_id)
    launcher = Launcher(facts, run_id, [(file, words)], port=port or None, show_summary=False)
    launcher.start()
    facts.missing()
    launcher.spin()
    return facts.code


def main(words):
    facts, port, rviz, file, *keys = words
    sys.stdout, sys.stderr = (one if one.isatty() else Plain(one) for one in (sys.stdout, sys.stderr))
    facts = Facts(int(facts), rviz == "stays")
    if not node_program.good(keys):
        return 2
    try:
        return launch(facts, int(port), file, keys)
    except (roslaunch.core.RLException, OSError, ValueError, rospkg.ResourceNotFound) as error:
        if interrupt.heard:
            return 130
        print("fly: " + next(iter(str(error).splitlines()), type(error).__name__), file=sys.stderr)
        return 2 if facts.pm is None else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
