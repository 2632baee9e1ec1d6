"""What the figures are drawn from: recorded runs, the reduced measured flight, and runs made when missing."""
import csv
import math
import subprocess
import sys

import numpy as np
import yaml

from monarch_flight import case_files, places
from monarch_flight.measured import marker_reduction as reduction
from monarch_flight.runs import recorded

BETA = math.radians(25.4292)  # stroke plane of the published series, config/insects


def table(path):
    """Columns of a CSV file by name."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    numbers = np.array([[float(cell) for cell in row] for row in rows[1:]])
    return {name: numbers[:, i] for i, name in enumerate(rows[0])}


def flight(folder):
    """The flight that a run recorded in flight.bag: time, path, angles and force of both wings, NED, SI."""
    import rosbag  # takes its time

    path = folder / "flight.bag"
    if not path.exists():
        sys.exit(f"figures: {path}: does not exist; give the folder of a run that was recorded to its end")
    rows = []
    with rosbag.Bag(str(path)) as bag:
        for m in recorded.states(bag):
            place, right = m.body.position, m.right_wing
            rows.append((m.t, place.x, place.z, m.body.pitch.position, right.theta.position, right.phi.position,
                         m.force.x, m.force.z))
    if len(rows) < 3:
        sys.exit(f"figures: {path}: holds no steps; the run ended at its start")
    return dict(zip(("t", "x", "z", "theta_B", "theta_R", "phi", "FX", "FZ"), np.array(rows).T))


def case_of(folder):
    return case_files.read(folder / "case.yaml")


def run(runs, case, *options, may_fail=False):
    """The run of a case with these options of monarch fly, in a folder of its own below `runs`; flown first where it is
    missing. `may_fail`: what was flown until a solver failed will do."""
    folder = runs / case_files.run_name(case, *options)
    if not (folder / "summary.json").exists():
        command = [*places.monarch(), "fly", f"case:={case}", f"out:={folder}", "in_process:=true", "rviz:=false",
                   "report:=false", *options]
        print("figures: flying", " ".join(command[3:]), flush=True)
        failed = subprocess.run(command, check=False).returncode
        if failed and not (may_fail and (folder / "flight.csv").exists()):
            sys.exit(f"figures: the run of {case} failed; the reason is above")
    return folder


def sweep(runs, case, masses, *options):
    """{label: run folder} of flights over the mass of one wing [kg]; flown first where they are missing."""
    values = ",".join(f"{mass:.4g}" for mass in masses)
    folder = runs / case_files.run_name(case, *options, f"masses:={len(masses)}")
    command = [*places.monarch(), "sweep", f"case:={case}", f"over:=wing/mass={values}", f"out:={folder}", *options]
    if subprocess.run(command, check=False).returncode:
        sys.exit(f"figures: the sweep of {case} failed; the reason is above")
    found = {}
    for run_ in (folder / "runs").iterdir():
        found[case_of(run_)["insect"]["wing"]["mass"]] = run_
    return {f"{1e6 * mass:.2f} mg": found[mass] for mass in sorted(found)}


def rendered(folder, flap, out):
    """The picture of a run's flow at t/T = `flap` (monarch render-field)."""
    picture = out / f"fig9_{flap:.1f}.png"
    command = [*places.monarch(), "render-field", str(folder), str(picture), f"flap:={flap}", "view:=ahead"]
    if subprocess.run(command, check=False).returncode:
        sys.exit(f"figures: {folder}: no picture of its flow; the reason is above")
    return picture


def distance_to_measured(flight_):
    """rms distance of the body's path to the measured path of the thorax, both from their starts, as far as both go [m]."""
    real, t = measured()["columns"], flight_["t"] - flight_["t"][0]
    both = real["t"] <= t[-1]
    gaps = [np.interp(real["t"][both], t, flight_[k] - flight_[k][0]) - (real[k][both] - real[k][0]) for k in ("x", "z")]
    return math.sqrt(np.mean(gaps[0] ** 2 + gaps[1] ** 2))


def markers():
    return reduction.read_markers(places.config() / "measured/monarch_markers.csv")


def measured():
    """The reduced measured flight (measured/marker_reduction.py)."""
    return reduction.reduce(*markers(), BETA)


def published():
    with open(places.config() / "insects/monarch_kinematics.yaml", encoding="utf-8") as file:
        return yaml.safe_load(file)


def body_forces(data):
    """Thrust (along b_x) and lift (along -b_z) of both wings [N]."""
    c, s = np.cos(data["theta_B"]), np.sin(data["theta_B"])
    return c * data["FX"] - s * data["FZ"], -(s * data["FX"] + c * data["FZ"])


def measured_forces(flight_, mass, gravity=9.81):
    """Thrust and lift that move `mass` as the measured thorax moves: path and pitch as straight line and two
    harmonics, so neither the appendages' inertia nor the mass centre's place are in it [N]."""
    columns, f = flight_["columns"], flight_["series"]["theta_B"]["frequency"]
    t = columns["t"]
    w = 2 * np.pi * f * np.arange(1, 3)
    basis = np.column_stack([np.ones_like(t), t] + [g(k * t) for k in w for g in (np.cos, np.sin)])
    second = np.column_stack([0 * t, 0 * t] + [-k * k * g(k * t) for k in w for g in (np.cos, np.sin)])
    ax, az = (second @ np.linalg.lstsq(basis, columns[name], rcond=None)[0] for name in ("x", "z"))
    theta = reduction.evaluate(flight_["series"]["theta_B"], t, f)
    fx, fz = mass * ax, mass * (az - gravity)
    return np.cos(theta) * fx - np.sin(theta) * fz, -(np.sin(theta) * fx + np.cos(theta) * fz)


def strokes(table_, frequency, first):
    """Mean over the whole strokes from number `first` (1 is the first): half the swing and the fundamental's amplitude
    of the wing's pitch [rad], the fundamental's phase behind cos(2 pi f t) [strokes], mean lift [N], peak lift [N]."""
    steps = int(round(1 / frequency / (table_["t"][1] - table_["t"][0])))
    found = []
    for start in range((first - 1) * steps, len(table_["t"]) - steps, steps):
        theta, lift = (table_[name][start:start + steps] for name in ("theta_R", "FZ"))
        fundamental = 2 * np.mean(theta * np.exp(-2j * np.pi * frequency * table_["t"][start:start + steps]))
        found.append([np.ptp(theta) / 2, abs(fundamental), -np.angle(fundamental) / (2 * np.pi), -lift.mean(), -lift.min()])
    if not found:
        sys.exit(f"figures: the run has no whole stroke from number {first} on; fly more")
    return np.mean(found, axis=0)
