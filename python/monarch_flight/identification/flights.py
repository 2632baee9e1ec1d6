"""Flights of a search, side by side, each kept as a small table: a search that was stopped flies none of them again."""
import hashlib
import os
import shutil
import subprocess
import time

import numpy as np

from monarch_flight import case_files, places
from monarch_flight.figures import data
from monarch_flight.runs import environment
from monarch_flight.telling import signal_of

PAUSE = 0.05  # between two looks at the flights [s]
REFUSED, STOPPED = 2, (130, -2, -15)  # exit codes


class Failed(Exception):
    """A flight that the case allows but the numerics do not; with the program's last words."""


class Unflown(Exception):
    """A flight that was refused, with the program's words."""


class Flights:
    """Flies cases; `points` holds what was flown, by the text of its case."""

    def __init__(self, folder, angles, jobs, threads):
        self.points, self.flying, self.angles = folder / "points", folder / "flying", list(angles)
        self.jobs, self.threads = jobs, threads
        shutil.rmtree(self.flying, ignore_errors=True)  # of a search that was stopped
        self.points.mkdir(parents=True, exist_ok=True)
        self.flown = 0

    def all(self, cases):
        """For each case (t, {angle: deg}) of its whole flight, or the Failed that it ended with. Raises Unflown."""
        texts = [case_files.text(case) for case in cases]
        names = [hashlib.sha256("\n".join([text, *self.angles]).encode()).hexdigest()[:16] for text in texts]
        missing = {name: text for name, text in zip(names, texts) if not self.kept(name)}
        try:
            self.fly(missing)
        finally:
            shutil.rmtree(self.flying, ignore_errors=True)
        return [self.read(name) for name in names]

    def kept(self, name):
        return any((self.points / (name + ending)).exists() for ending in (".csv", ".failed"))

    def read(self, name):
        failed = self.points / (name + ".failed")
        if failed.exists():
            return Failed(failed.read_text(encoding="utf-8"))
        table = data.table(self.points / (name + ".csv"))
        return table["t"], {angle: np.degrees(table[angle]) for angle in self.angles}

    def fly(self, texts):
        """Side by side, a thread each; one alone takes `threads`."""
        waiting, running = list(texts.items()), {}
        threads = self.threads if len(waiting) == 1 else 1
        try:
            while waiting or running:
                while waiting and len(running) < self.jobs:
                    name, text = waiting.pop(0)
                    running[name] = self.start(name, text, threads)
                time.sleep(PAUSE)
                for name in [name for name, flight in running.items() if flight.poll() is not None]:
                    self.keep(name, texts[name], running.pop(name).returncode)
        finally:
            for flight in running.values():
                flight.terminate()
            for flight in running.values():
                flight.wait()

    def start(self, name, text, threads):
        folder = self.flying / name
        folder.mkdir(parents=True)
        (folder / "case.yaml").write_text(text, encoding="utf-8")
        with open(folder / "log", "w", encoding="utf-8") as log:
            return subprocess.Popen([places.program("fly_in_process"), f"case:={folder / 'case.yaml'}", f"out:={folder / 'run'}",
                                     f"threads:={threads}"], stdout=log, stderr=log, env=environment.of_flight(os.environ))

    def keep(self, name, text, code):
        """What is left of a flight that has ended: its angles, or why it failed."""
        folder = self.flying / name
        words = [line for line in (folder / "log").read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
        if code in STOPPED:
            raise KeyboardInterrupt
        if code == REFUSED:
            raise Unflown("\n".join(words[-8:]))
        if code not in (0, 1):  # an accident, as no memory: it says nothing of these values
            raise Unflown(f"{signal_of(code) or f'exit code {code}'}: " + " ".join(words[-2:]))
        if code:
            why = f"{signal_of(code) or f'exit code {code}'}: " + " ".join(words[-2:])
            self.put(name + ".failed", why)
        else:
            self.flown += 1
            columns = data.table(folder / "run/flight.csv")
            names = ["t", *self.angles]
            rows = "\n".join(",".join(f"{value:.17g}" for value in row) for row in zip(*(columns[one] for one in names)))
            comments = "".join(f"# {line}\n" for line in text.splitlines())
            self.put(name + ".csv", f"{comments}{','.join(names)}\n{rows}\n")
        shutil.rmtree(folder)

    def put(self, name, text):
        """Whole or not at all."""
        active = self.points / (name + ".active")
        active.write_text(text, encoding="utf-8")
        active.rename(self.points / name)
