"""A run as a child process: signals reach it once, nothing of it is left behind, and what ended is known."""
import json
import os
import secrets
import signal
import subprocess
import time

from monarch_flight.telling import FAILED, say

MARK = "MONARCH_FLIGHT_RUN"  # in the environment of every process of the run
PATIENCE = 20.0  # s, for the checkpoint of nodes that are asked to end
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Stop:
    """Ctrl-C, SIGTERM and the end of the terminal, from the beginning to the end of a command. A signal that was
    ignored when it began (nohup) stays ignored."""

    def __init__(self):
        self.heard, self.starting, self.child = False, False, None
        self.before = {number: signal.getsignal(number) for number in SIGNALS}
        for number, handler in self.before.items():
            if handler != signal.SIG_IGN:
                signal.signal(number, self)

    def __call__(self, *_):
        self.heard = True
        if self.child is None and not self.starting:
            raise KeyboardInterrupt  # there is no run yet
        self.hand_on()

    def hand_on(self):
        if self.child is not None and self.child.poll() is None:
            self.child.send_signal(signal.SIGINT)

    def end(self):
        for number, handler in self.before.items():
            signal.signal(number, handler)


def marked(mark):
    """Processes with this mark that have not ended."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/environ", "rb") as file:
                if f"{MARK}={mark}".encode() in file.read().split(b"\0"):
                    found.append(int(pid))
        except OSError:
            continue
    return found


def send(pids, number):
    for pid in pids:
        try:
            os.kill(pid, number)
        except OSError:
            pass


def end_left(mark, by_hand):
    """Processes that outlived the launcher (it was killed) are asked to end, and have time for a checkpoint."""
    if not by_hand and marked(mark):
        say("the launcher is gone; ending its nodes")
    end_all(mark, signal.SIGINT)


def end_all(mark, number=signal.SIGTERM):
    """Ends all processes with this mark: by that signal, and who has not heard it after some time by SIGKILL."""
    left = marked(mark)
    send(left, number)
    deadline = time.monotonic() + PATIENCE
    while left and time.monotonic() < deadline:
        time.sleep(0.1)
        left = marked(mark)
    send(left, signal.SIGKILL)


def fresh():
    """In the child, before it begins: it hears what its parent may have been told to ignore."""
    for number in SIGNALS[:2]:
        signal.signal(number, signal.SIG_DFL)


def held():
    """The same for a child in Python, which lets Ctrl-C through when it is ready to answer."""
    fresh()
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])


def run(command, environment, stop):
    """(exit code, negative where a signal ended it; facts) of a command that runs in a session of its own. FACTS among its words is replaced by the
    number of a file into which it writes lines of JSON."""
    mark, facts = secrets.token_hex(8), "FACTS" in command
    read, write = os.pipe()
    words = [str(write) if word == "FACTS" else str(word) for word in command]
    stop.starting = True
    try:
        stop.child = subprocess.Popen(words, env=dict(environment, **{MARK: mark}), start_new_session=True,
                                      preexec_fn=held if facts else fresh, pass_fds=[write] if facts else [])
    except OSError as error:
        os.close(read)
        say(f"{words[0]} cannot be started: {error.strerror}")
        return FAILED, []
    finally:
        os.close(write)
    if stop.heard:  # while it was started
        stop.hand_on()
    code = stop.child.wait()
    end_left(mark, stop.heard)
    os.set_blocking(read, False)
    with os.fdopen(read, "rb") as file:
        lines = (file.read() or b"").splitlines()
    return code, [json.loads(line) for line in lines if line.endswith(b"}")]
