"""The table of monarch neighbours, and that of monarch verify neighbours."""
import csv
import json
import os

import numpy as np

from monarch_flight.neighbours.estimate import VARIANTS, Estimate
from monarch_flight.neighbours.flown import Flight, clearance

TITLES = {"wing": "the other wing", "body": "the body's displacement", "both": "both",
          "sealed": "the other wing, roots at the mid-plane",
          "wing, no wake": "the other wing, without a wake"}
UNSTABLE = 3.0  # times the flight's largest force


def told(folder, numbers):
    flight = Flight(folder)
    estimate = Estimate(flight, **numbers)
    place(flight, estimate)
    loads = estimate.all(tuple(name for name in VARIANTS if "no wake" in name))
    with np.errstate(all="ignore"):  # where it is unstable
        attached = estimate.all(("alone",))["alone"]
    rows = estimate.rows[-estimate.flap:]
    flown = np.hypot(flight.FX, flight.FZ)[rows]
    stable = 2.0 * np.hypot(attached[:, 0], attached[:, 2]).max() < UNSTABLE * flown.max()  # false for nan, too
    if stable:
        loads["alone"] = attached
        loads.update(estimate.all(tuple(name for name in VARIANTS if name not in loads)))
        agreement(flight, rows, attached, flown)
    else:
        print("in this motion the wake comes too near to the wing for attached potential flow (the trailing edge\n"
              "leads, or the wings would cross by far): only what has no wake is told")
    changes(flight, rows, loads)
    body_drag(flight)
    written(os.path.join(folder, "neighbours.csv"), flight.phase[rows], loads)
    return 0


def place(flight, estimate):
    """Where the wings are."""
    rows = np.unique(np.linspace(estimate.rows[-estimate.flap], estimate.rows[-1], 400).astype(int))
    opening = np.degrees(2.0 * np.arcsin(flight.R_BW[rows][:, 1, 1]))
    up = flight.phi[rows] < 0.0
    near = clearance(flight, rows, inner=0.1)
    at = flight.phase[rows][near.argmin()] % 1.0
    sides = [f"{opening[side].min():.0f} deg {where}" for side, where in ((up, "above"), (~up, "below")) if side.any()]
    print(f"smallest angle between the wings      {', '.join(sides)} the body\n"
          f"smallest distance from the mid-plane  {1e3 * near.min():.1f} mm, at phase {at:.2f}, outside the inner tenth of the span")
    if near.min() < 0.0:
        print(f"the flat wings pass through each other for {100 * (near < 0.0).mean():.0f} % of the flap")


def agreement(flight, rows, attached, flown):
    both = 2.0 * attached[:, [0, 2]]
    air = np.stack([flight.FX, flight.FZ], axis=-1)[rows]
    size, least = np.hypot(*both.T).max() / flight.weight, np.corrcoef(air.ravel(), both.ravel())[0, 1]
    print(f"{'weights':38s}{'flight':>8s}{'here, wing alone':>18s}\n"
          f"{'  mean lift':38s}{-air[:, 1].mean() / flight.weight:8.2f}{-both[:, 1].mean() / flight.weight:18.2f}\n"
          f"{'  largest force':38s}{flown.max() / flight.weight:8.2f}{size:18.2f}\n"
          f"{'  correlation of the forces':38s}{'':8s}{least:18.2f}")


def changes(flight, rows, loads):
    peak, hinge = 0.5 * np.hypot(flight.FX, flight.FZ)[rows].max(), np.abs(flight.my[rows]).max()
    heads = ("mean lift", "thrust", "largest", "at phase", "rms", "hinge")
    units = ("% weight", "% weight", "% of peak", "", "% of peak", "% of peak")
    print()
    for words, title in ((heads, "what is left out"), (units, "")):
        print(f"{title:40s}" + "".join(f"{word:>10s}" for word in words))
    for name, title in TITLES.items():
        if name not in loads:
            continue
        more = loads[name] - (loads["alone, no wake"] if "no wake" in name else loads["alone"])
        size = np.hypot(more[:, 0], more[:, 2])
        numbers = (-200.0 * more[:, 2].mean() / flight.weight, 200.0 * more[:, 0].mean() / flight.weight,
                   100.0 * size.max() / peak, flight.phase[rows][size.argmax()] % 1.0,
                   100.0 * np.sqrt((size ** 2).mean()) / peak, 100.0 * np.abs(more[:, 3]).max() / hinge)
        print(f"{title:40s}" + "".join(f"{number:10.{2 if k == 3 else 1}f}" for k, number in enumerate(numbers)))


def body_drag(flight):
    insect = flight.case["insect"]
    speed2 = np.mean(np.gradient(flight.x, flight.t) ** 2 + np.gradient(flight.z, flight.t) ** 2)
    drag = 0.5 * flight.density * speed2 * 0.25 * np.pi * insect["body"]["width"] ** 2
    share = 100.0 * drag / flight.weight
    print(f"\nthe body's own drag, with a coefficient of 1 on its frontal area: {share:.1f} % of the weight")


def written(path, phase, loads):
    """Forces of both wings, NED [N], hinge moment of one [N m]."""
    names = [f"{part} {name}" for name in loads for part in ("FX", "FZ", "hinge")]
    with open(path + ".active", "w", encoding="utf-8", newline="") as file:
        lines = csv.writer(file)
        lines.writerow(["phase", *(name.replace(", ", " ").replace(" ", "_") for name in names)])
        for k, at in enumerate(phase):
            lines.writerow([f"{value:.9g}" for value in (at, *(
                value for part in loads.values() for value in (2 * part[k, 0], 2 * part[k, 2], part[k, 3])))])
    os.replace(path + ".active", path)


def verified(out):
    """Compares with exact solutions, prints the rows, adds them to out/verification.json."""
    from monarch_flight.neighbours import exact
    rows = exact.rows()
    print(f"{'quantity':50s} {'resolution':10s} {'computed':>12s} {'reference':>12s} {'error':>9s} {'bound':>9s}")
    for row in rows:
        print(f"{row['quantity']:50s} {row['resolution']:10s} {row['computed']:12.5g} {row['reference']:12.5g} "
              f"{row['error']:9.1e} {row['bound']:9.0e} {'pass' if row['pass'] else 'FAIL'}")
    os.makedirs(out, exist_ok=True)
    path = os.path.join(out, "verification.json")
    kept = []
    if os.path.isfile(path):
        with open(path, encoding="utf-8") as file:
            kept = [row for row in json.load(file) if row["case"] != "neighbours"]
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(kept + rows, file, indent=1)
    os.replace(path + ".new", path)
    return 0 if all(row["pass"] for row in rows) else 1
