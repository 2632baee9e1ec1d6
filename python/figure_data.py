"""What the figures are drawn from: tables of runs, the reduced measured flight, and runs made when missing."""
import csv
import math
import pathlib
import subprocess
import sys

import numpy as np
import yaml

import marker_reduction as reduction

ROOT = pathlib.Path(__file__).resolve().parent.parent
BETA = math.radians(25.4292)  # stroke plane of the published series, config/insects


def table(path):
    """Columns of a CSV file by name."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    numbers = np.array([[float(cell) for cell in row] for row in rows[1:]])
    return {name: numbers[:, i] for i, name in enumerate(rows[0])}


def flight(folder):
    """flight.csv of a run; the table of a run that still goes or died is taken as far as it reaches."""
    for name in ("flight.csv", "flight.csv.active"):
        if (folder / name).exists():
            data = table(folder / name)
            if len(data["t"]) > 2:
                return data
    sys.exit(f"figures: {folder}: no flight.csv with steps in it; give the folder of a run")


def case_of(folder):
    with open(folder / "case.yaml", encoding="utf-8") as file:
        return yaml.safe_load(file)


def run(folder, case, *options):
    """The run in `folder`; flown first where it is missing."""
    if not (folder / "summary.json").exists():
        command = [str(ROOT / "scripts/fly"), f"case:={case}", f"out:={folder}", "in_process:=true", "rviz:=false",
                   *options]
        print("figures: flying", " ".join(command[1:]), flush=True)
        if subprocess.run(command, check=False).returncode:
            sys.exit(f"figures: the run of {case} failed; the reason is above")
    return folder


def with_wing_mass(case, mass, folder):
    """A case file like `case` with another mass of one wing [kg]."""
    with open(ROOT / f"config/cases/{case}.yaml", encoding="utf-8") as file:
        content = yaml.safe_load(file)
    content["name"] = f"{content['name']}_{mass * 1e6:.2f}mg"
    content["insect"].setdefault("wing", {})["mass"] = mass
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{content['name']}.yaml"
    path.write_text(yaml.safe_dump(content, sort_keys=False), encoding="utf-8")
    return path


def markers():
    return reduction.read_markers(ROOT / "config/measured/monarch_markers.csv")


def measured():
    """The reduced measured flight (python/marker_reduction.py)."""
    return reduction.reduce(*markers(), BETA)


def published():
    with open(ROOT / "config/insects/monarch_kinematics.yaml", encoding="utf-8") as file:
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


def strokes(folder, first):
    """Mean over the whole strokes from number `first` (1 is the first): half the swing and the fundamental's amplitude
    of the wing's pitch [rad], the fundamental's phase behind cos(2 pi f t) [strokes], mean lift [N], peak lift [N]."""
    table_, frequency = flight(folder), case_of(folder)["motion"]["frequency"]
    steps = int(round(1 / frequency / (table_["t"][1] - table_["t"][0])))
    found = []
    for start in range((first - 1) * steps, len(table_["t"]) - steps, steps):
        theta, lift = (table_[name][start:start + steps] for name in ("theta_R", "FZ"))
        fundamental = 2 * np.mean(theta * np.exp(-2j * np.pi * frequency * table_["t"][start:start + steps]))
        found.append([np.ptp(theta) / 2, abs(fundamental), -np.angle(fundamental) / (2 * np.pi), -lift.mean(), -lift.min()])
    if not found:
        sys.exit(f"figures: {folder}: has no whole stroke from number {first} on")
    return np.mean(found, axis=0)
