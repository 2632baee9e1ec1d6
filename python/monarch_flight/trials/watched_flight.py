"""One run of monarch fly under the eyes of a trial."""
import os
import signal
import subprocess
import time

from monarch_flight import places
from monarch_flight.trials import processes


class Flight:
    """One run of monarch fly in a folder."""

    def __init__(self, folder, keys, environment):
        self.folder, self.log = folder, folder + ".txt"
        env = {k: v for k, v in os.environ.items() if not k.startswith("ROS_") and k != "DISPLAY"}
        env.update(processes.marked(folder), MONARCH_AS_BUILT="1", ROS_LOG_DIR=folder + ".log", **environment)
        with open(self.log, "a") as log:
            # Commands in a shell's background do not hear SIGINT, and hand that on.
            self.process = subprocess.Popen([*places.monarch(), "fly", "report:=false", *keys], stdout=log, stderr=log, env=env,
                                            stdin=subprocess.DEVNULL, start_new_session=True,
                                            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))

    def output(self):
        with open(self.log, errors="replace") as f:
            return f.read()

    def pids(self):
        return processes.nodes(self.folder)

    def step(self):
        """The last step in the table of the flight, which may have any of its names."""
        for name in ("flight.csv.active", "flight.csv"):
            try:
                with open(os.path.join(self.folder, name)) as f:
                    return max(f.read().count("\n") - 2, 0)
            except FileNotFoundError:
                continue
        return 0

    def wait_for_step(self, step, limit=120):
        deadline = time.monotonic() + limit
        while self.step() < step and time.monotonic() < deadline and self.process.poll() is None:
            time.sleep(0.01)

    def end(self, limit):
        """Exit code, or None when it had to be ended by force: a hang."""
        try:
            return self.process.wait(limit)
        except subprocess.TimeoutExpired:
            for pid in (*self.pids().values(), self.process.pid):
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            self.process.wait()
            return None

    def leftovers(self):
        """Nodes that outlive the run by two seconds."""
        deadline = time.monotonic() + 2
        while True:
            alive = sorted(self.pids())
            if not alive or time.monotonic() > deadline:
                return alive
            time.sleep(0.1)
