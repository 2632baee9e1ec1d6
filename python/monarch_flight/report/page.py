"""Puts the page together: one HTML file that needs nothing else."""
import base64
import json
import os
import pathlib
import re

import numpy as np

from monarch_flight import places
from monarch_flight.keys import Refused
from monarch_flight.report import curves, facts, pressure, provenance
from monarch_flight.report.flown import Flown, measured
from monarch_flight.report.model import ANGLES, Model

LIBRARIES = "/usr/share/javascript"  # of Debian's packages libjs-three and libjs-chart.js
SCRIPTS = ("three/three.min.js", "three/examples/js/controls/OrbitControls.js", "chart.js/chart.min.js")


class Lacking(Refused):
    """A package of the section [report] that is not there."""


def encoded(values, kind="<f4"):
    """An array as the page reads it: type, shape, bytes in base64."""
    array = np.ascontiguousarray(values, kind)
    return dict(type=kind, shape=array.shape, data=base64.b64encode(array.tobytes()).decode())


def to_world(c, rows):
    """Places (x east, y north, z up) and attitudes (x y z w) of base_link (x forward, y left, z up) [m]."""
    place = np.stack([c["y"], c["x"], -c["z"]], axis=1)[rows]
    w, x, y, z = (c[name][rows] for name in ("qw", "qx", "qy", "qz"))
    # q(NED to ENU) q q(FLU to FRD): half a turn about (1, 1, 0) / sqrt 2, and one about x.
    s = np.sqrt(0.5)
    w, x, y, z = -s * (x + y), s * (w + z), s * (w - z), s * (y - x)
    return place, np.stack([w, z, -y, -x], axis=1)  # (w, x, y, z) times (0, 1, 0, 0), ordered x y z w


def chart(one, t):
    told = []
    for curve in one.curves:
        told.append(dict(name=curve.name, kind=curve.kind, y=encoded(curve.y), x=None if curve.x is None else encoded(curve.x)))
    return dict(title=one.title, unit=one.unit, x=one.x, scale=one.scale, curves=told)


def wing_pressure(pictures, dynamic, limit, flown):
    """Pressure coefficients as bytes, 127 at the end of the scale."""
    sides = {side: encoded(np.clip(np.round(127 * values / dynamic / limit), -127, 127), "i1")
             for side, values in pictures.items() if side != "t"}
    return dict(t=encoded(pictures["t"] * flown.scale), **sides)


class Shown:
    """A run with everything that the page shows of it."""

    def __init__(self, flown):
        self.flown, self.model, self.real = flown, Model(flown.folder), measured(flown)
        self.reference = flown.summary.get("pressure_reference")
        self.pictures = pressure.pictures(flown, self.model)
        self.dynamic = self.reference["dynamic_Pa"] if self.reference else 1.0

    def coefficients(self):
        """Of all points and pictures, or nothing; in a run of an older version, which tells no reference, pressures [Pa]."""
        return [values / self.dynamic for side, values in (self.pictures or {}).items() if side != "t"]

    def data(self, label, limit):
        flown, c, rows = self.flown, self.flown.columns, self.flown.frames
        place, attitude = to_world(c, rows)
        real = None if self.real is None else np.stack([self.real[name] - self.real[name][0] for name in "xyz"], axis=1)
        return dict(
            label=label, beats=bool(flown.frequency), t=encoded(flown.column("t") * flown.scale), scale=flown.scale,
            charts=[chart(one, c) for one in curves.charts(flown, self.model.mass, self.real)],
            frames=dict(t=encoded(c["t"][rows] * flown.scale), place=encoded(place - place[0]), attitude=encoded(attitude),
                        angles=encoded(np.stack([c[name][rows] for name in ANGLES.values()], axis=1))),
            angles=list(ANGLES), joints=self.model.joints, span=self.model.span,
            solids={link: encoded(corners) for link, corners in self.model.solids.items()},
            wings={link: encoded(points) for link, points in self.model.wings.items()},
            measured=None if real is None else encoded(np.stack([real[:, 1], real[:, 0], -real[:, 2]], axis=1)),
            pressure=None if self.pictures is None else wing_pressure(self.pictures, self.dynamic, limit, flown),
            reference=self.reference)


def labels(runs):
    """A short name for each run that no other has."""
    names = [run.name for run in runs]
    if len(set(names)) < len(names):
        names = [f"{run.name}, {facts.air(run)}" for run in runs]
    if len(set(names)) < len(names):
        names = [run.folder.name for run in runs]
    return names if len(set(names)) == len(names) else [f"{name} ({i})" for i, name in enumerate(names, 1)]


def text_of(path):
    try:
        return pathlib.Path(path).read_text(encoding="utf-8")
    except OSError:
        raise Lacking(f"{path} is not there; it is of the packages that `scripts/install report` installs") from None


def library(name):
    """A script, fit to stand inside of a page."""
    text = text_of(os.path.join(LIBRARIES, name))
    return re.sub(r"//# sourceMappingURL=.*", "", text).replace("</script", "<\\/script")


def template():
    try:
        import jinja2
    except ModuleNotFoundError:
        raise Lacking("jinja2 is not there; it is of the packages that `scripts/install report` installs") from None
    loader = jinja2.FileSystemLoader(str(places.share() / "report"))
    return jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True).get_template("page.html")


def page(folders):
    """The text of the page of these runs' folders. Raises Refused."""
    made, scripts = template(), [library(name) for name in SCRIPTS]
    runs = [Flown(folder) for folder in folders]
    if not all(run.frequency for run in runs):
        for run in runs:
            run.scale = 1.0
    shown = [Shown(run) for run in runs]
    relative = all(one.reference for one in shown)  # else all in Pa
    if not relative:
        for one in shown:
            one.dynamic = 1.0
    coefficients = [values for one in shown for values in one.coefficients()]
    limit = pressure.limit(coefficients) if coefficients else None
    names = labels(runs)
    data = dict(beats=all(run.frequency for run in runs), limit=limit, frequency=runs[0].frequency,
                runs=[one.data(name, limit) for one, name in zip(shown, names)])
    told = json.dumps(data, allow_nan=False).replace("<", "\\u003c")
    own = places.share() / "report"
    speeds = [one.reference["speed_m_s"] for one in shown if one.pictures and relative]
    return made.render(
        names=names, runs=runs, facts=facts, provenance=provenance, data=told, scripts=scripts,
        has_pressure=limit is not None, limit=f"{limit or 0:g}", speed=speeds[0] if speeds else 0, relative=relative,
        has_measured=any(one.real is not None for one in shown),
        time_axis="flaps, t/T" if data["beats"] else "seconds",
        differences=facts.differences(runs) if len(runs) > 1 else None, style=text_of(own / "page.css"),
        own=[text_of(own / name) for name in ("data.js", "scene.js", "curves.js", "player.js")])



def write(folders, out):
    """Writes the page as a whole, or not at all."""
    text = page(folders)
    growing = pathlib.Path(f"{out}.active")
    growing.write_text(text, encoding="utf-8")
    os.replace(growing, out)
