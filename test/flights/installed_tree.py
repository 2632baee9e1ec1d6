"""What holds for an installed tree, wherever it lies."""
import os
import re
import subprocess
import tempfile

import flying

LINKER = "/lib64/ld-linux-x86-64.so.2"
LEVELS = ("x86-64-v4", "x86-64-v3")
FLIGHT = ("case:=climb_printed", "grid:=preview", "steps_per_flap:=200", "flaps:=0.05", "record:=false")
SAME = 1e-6  # of the largest entry of a column: sums in another order, and what the iterations leave


def naming(prefix, folders):
    """The files below `prefix` that hold the path of one of the folders, other than as a part of that of `prefix` or at
    the beginning of another name: /source is not in /etc/apt/sources.list."""
    words = [re.compile(re.escape(os.fsencode(folder)) + rb"(?![\w.-])") for folder in folders]
    found = []
    for place, _, names in os.walk(prefix):
        for path in (os.path.join(place, name) for name in names):
            if os.path.isfile(path):
                with open(path, "rb") as file:
                    content = file.read().replace(os.fsencode(prefix), b"")
                found += [path for word in words if word.search(content)]
    return sorted({os.path.relpath(path, prefix) for path in found})


def runnable():
    """Of LEVELS, those that this machine's dynamic linker uses."""
    told = subprocess.run([LINKER, "--help"], check=True, stdout=subprocess.PIPE, text=True).stdout
    return [level for level in LEVELS if level + " (supported" in told]


def flown(prefix, level, out):
    """(summary, columns, rows) of a short flight with the library of one level; None: that of all processors."""
    command = [LINKER, "--glibc-hwcaps-mask", level or "none", os.path.join(prefix, "lib/monarch_flight/fly_in_process"),
               *FLIGHT, "out:=" + out]
    done = subprocess.run(command, env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1"), check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200)
    if done.returncode:
        raise RuntimeError(done.stdout)
    return (flying.summary(out), *flying.table(out, "flight.csv"))


def check_levels(test, prefix):
    with tempfile.TemporaryDirectory(prefix="levels_") as folder:
        plain, columns, rows = flown(prefix, None, os.path.join(folder, "plain"))
        test.assertEqual(plain["instruction_set"], "x86-64")
        for level in runnable():
            summary, _, others = flown(prefix, level, os.path.join(folder, level))
            test.assertEqual(summary["instruction_set"], level)
            test.assertEqual(len(others), len(rows))
            for name, column, other in zip(columns, zip(*rows), zip(*others)):
                scale = max(map(abs, column))
                largest = max(abs(a - b) for a, b in zip(column, other))
                test.assertLessEqual(largest, SAME * scale, f"{name} with {level}")
