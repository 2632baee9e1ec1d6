"""The files of the flow of a run, and its flown path."""
import csv
import os
import xml.etree.ElementTree

import yaml

from monarch_flight.keys import Refused


def period(folder):
    with open(os.path.join(folder, "case.yaml")) as f:
        frequency = yaml.safe_load(f)["motion"].get("frequency", 0)
    return 1 / frequency if frequency else None


def chosen_files(folder, flap):
    """(time, flow file, wing file) nearest to the wanted time."""
    series = os.path.join(folder, "fields", "fields.pvd")
    if not os.path.isfile(series):
        raise Refused("%s: no files of the flow; fly with fields_every:=<steps>" % series)
    times = {}
    for item in xml.etree.ElementTree.parse(series).iter("DataSet"):
        times.setdefault(float(item.get("timestep")), {})[item.get("name")] = item.get("file")
    t = max(times)
    if flap is not None:
        T = period(folder)
        if T is None:
            raise Refused("flap:=%g: this motion has no period" % flap)
        t = min(times, key=lambda s: abs(s - flap * T))
    return t, *(os.path.join(folder, "fields", times[t][part]) for part in ("flow", "wings"))


def path_points(folder, until):
    """The flown path in world axes."""
    name = os.path.join(folder, "flight.csv")
    name = name if os.path.isfile(name) else name + ".active"
    with open(name, newline="") as f:
        rows = [row for row in csv.DictReader(f) if float(row["t"]) <= until + 1e-12]
    return [(float(r["y"]), float(r["x"]), -float(r["z"])) for r in rows]
