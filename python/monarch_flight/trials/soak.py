"""A long flight in quasi-steady air under watch (monarch soak)."""
import json
import os
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

from monarch_flight import places
from monarch_flight.trials import processes

STEPS_PER_FLAP = 500
NODES = ("coordinator", "fluid", "flight", "wing")
PER_STEP = 2  # sub-iterations of a step of this case
MEMORY, DESCRIPTORS, COMPUTING = 2.0, 0, 1.25  # limits: MB, count, ratio


def memory(pid):
    with open("/proc/%d/statm" % pid) as f:
        return int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def descriptors(pid):
    return len(os.listdir("/proc/%d/fd" % pid))


def computing(pid):
    """Processor time [s]."""
    with open("/proc/%d/stat" % pid) as f:
        words = f.read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def single_process(out):
    """{name: pid} of the program that writes into `out`."""
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open("/proc/%s/cmdline" % pid) as f:
                words = f.read().split("\0")
        except OSError:
            continue
        if words[0].endswith("/fly_in_process") and "out:=" + out in words:
            return {"fly_in_process": int(pid)}
    return {}


def nodes(out):
    """{name: pid} of the solvers and the coordinator, once all are there."""
    found = {name: pid for name, pid in processes.nodes(out).items() if name in NODES}
    return found if len(found) == len(NODES) else {}


def watch(process, find, table):
    """Samples (time, bytes of flight.csv, {name: (MB, descriptors, s)}) until the end."""
    samples, pids = [], {}
    while process.poll() is None:
        time.sleep(1.0)
        try:
            pids = pids or find()
            seen = {name: (memory(pid), descriptors(pid), computing(pid)) for name, pid in pids.items()}
            samples.append((time.monotonic(), os.path.getsize(table), seen))
        except OSError:
            continue  # not begun, or just ended
    return samples


def verdict(samples):
    """Rows (what, early, late, limit, good)."""
    eighth = len(samples) // 8
    early, late = samples[eighth:2 * eighth + 1], samples[-eighth - 2:-1]
    for name in sorted(early[0][2]):
        for what, index, limit in (("memory [MB]", 0, MEMORY), ("descriptors", 1, DESCRIPTORS)):
            a, b = (statistics.median(s[2][name][index] for s in part) for part in (early, late))
            yield "%s of %s" % (what, name), a, b, "+%g" % limit, b - a <= limit

    def per_byte(part, seconds):
        return (seconds(part[-1]) - seconds(part[0])) / (part[-1][1] - part[0][1]) * 1e9

    a, b = (per_byte(p, lambda s: sum(x[2] for x in s[2].values())) for p in (early, late))
    yield "computing per byte of flight.csv [ns]", a, b, "x%g" % COMPUTING, b <= COMPUTING * a
    a, b = (per_byte(p, lambda s: s[0]) for p in (early, late))
    yield "wall time per byte of flight.csv [ns]", a, b, "none", True


def fly(count, over_nodes, folder):
    """(summary, samples) of a watched flight; the summary is None when it failed."""
    out, log = os.path.join(folder, "out"), os.path.join(folder, "log.txt")
    command = [*places.monarch(), "fly", "case:=hinge", "fluid:=quasi_steady", "report:=false",
               "record:=false", "flaps:=%.9g" % (round(count / PER_STEP) / STEPS_PER_FLAP),
               "steps_per_flap:=%d" % STEPS_PER_FLAP, "out:=" + out]
    command += ["rviz:=false"] if over_nodes else ["in_process:=true"]
    with open(log, "w") as f:
        process = subprocess.Popen(command, stdout=f, stderr=subprocess.STDOUT,
                                   env=dict(os.environ, **processes.marked(out)))
    try:
        samples = watch(process, (lambda: nodes(out)) if over_nodes else (lambda: single_process(out)),
                        os.path.join(out, "flight.csv.active"))
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            process.wait()
    if process.returncode != 0:
        with open(log) as f:
            sys.stderr.write(f.read()[-3000:])
        return None, samples
    with open(os.path.join(out, "summary.json")) as f:
        return json.load(f), samples


def soak(count, over_nodes):
    """Exit code."""
    folder = tempfile.mkdtemp(prefix="monarch_soak_")
    try:
        summary, samples = fly(count, over_nodes, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    if summary is None or len(samples) < 24:
        print("soak: the flight failed or was too short to judge (%d samples)" % len(samples), file=sys.stderr)
        return 1
    print("%d steps, %.0f sub-iterations, %d samples, %d messages ignored" % (
        summary["steps"], summary["steps"] * summary["sub_iterations"]["mean"], len(samples),
        sum(summary["ignored_messages"].values())))
    good = True
    for what, early, late, limit, fine in verdict(samples):
        print("  %-38s %10.2f -> %10.2f   limit %-6s %s" % (what, early, late, limit, "ok" if fine else "GROWS"))
        good = good and fine
    return 0 if good else 1
