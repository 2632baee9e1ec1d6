"""The processes of a flight that a trial has started: found by a mark in their environment, whatever roslaunch says."""
import os

MARK = "MONARCH_TRIAL"


def marked(folder):
    """What the environment of the flight into `folder` must hold."""
    return {MARK: folder}


def words_of(pid, name):
    with open(f"/proc/{pid}/{name}", "rb") as file:
        return os.fsdecode(file.read()).split("\0")


def parent(pid):
    with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
        return int(file.read().rpartition(")")[2].split()[1])


def called(words):
    """Name of the node, or master; empty where it is neither."""
    if any(os.path.basename(word) == "rosmaster" for word in words[:2]):
        return "master"
    return next((word.partition(":=")[2] for word in words if word.startswith("__name:=")), "")


def nodes(folder):
    """{name: pid} of the living nodes and of the master; of a node on several processes it is that of mpirun."""
    found = {}
    for pid in map(int, filter(str.isdigit, os.listdir("/proc"))):
        try:
            if f"{MARK}={folder}" in words_of(pid, "environ"):
                found[pid] = called(words_of(pid, "cmdline")), parent(pid)
        except OSError:
            continue  # it has just ended
    return {name: pid for pid, (name, above) in found.items() if name and found.get(above, ("",))[0] != name}
