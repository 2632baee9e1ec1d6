"""The files of the flow of a run, and its flown path."""
import os
import xml.etree.ElementTree

import numpy as np
import yaml

from monarch_flight.keys import Refused
from monarch_flight.report.flown import measured


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


def paths(flown, until):
    """The flown path up to a time [s] in world axes, and the measured one from the same start, or none."""
    c, real = flown.columns, measured(flown)
    shown = c["t"] <= until + 1e-12
    found = [np.stack([c["y"], c["x"], -c["z"]], axis=1)[shown]]
    if real is not None:
        shown = real["t"] <= until
        moved = np.stack([real[name] - real[name][0] for name in ("y", "x", "z")], axis=1)[shown] * [1, 1, -1]
        found.append(found[0][0] + moved)
    return found
