"""The reduced markers of a measured flight as files, and beside the published series."""
import csv
import math

import numpy as np
import yaml

from monarch_flight.measured import marker_reduction as reduction


def write(result, out):
    out.mkdir(parents=True, exist_ok=True)
    columns = result["columns"]
    with open(out / "measured.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows([f"{value:.9g}" for value in row] for row in zip(*columns.values()))
    series = {}
    for name, s in result["series"].items():
        series[name + "_deg"] = dict(
            A0=round(math.degrees(s["A0"]), 6), AN=[round(math.degrees(a), 6) for a in s["AN"]],
            BN=[round(math.degrees(b), 6) for b in s["BN"]], frequency=round(s["frequency"], 6),
            rms=round(math.degrees(s["rms"]), 4))
    summary = dict(velocity=[round(float(v), 5) for v in result["velocity"]], speed=round(result["speed"], 5),
                   climb_deg=round(math.degrees(result["climb"]), 4), beta_deg=round(math.degrees(result["beta"]), 4))
    with open(out / "measured.yaml", "w", encoding="utf-8") as file:
        file.write("# Reduced markers: mean velocity NED [m/s], speed, climb angle, tilt of the stroke plane; series\n"
                   "# A0 + sum AN cos(2 pi n f t) + BN sin(2 pi n f t) [deg], frequency f [Hz], rms of the fit [deg].\n")
        yaml.safe_dump(summary | series, file, sort_keys=False, default_flow_style=None, width=110)
    return summary


def compare(result, published, frequencies):
    """rms [deg] over the recording between our series and the published one, each at its own frequency."""
    t = result["columns"]["t"]
    rows = []
    for name, f in frequencies.items():
        ours = result["series"][name]
        a = np.degrees(reduction.evaluate(ours, t, ours["frequency"]))
        b = reduction.evaluate(published[name + "_deg"], t, f)
        rows.append((name, math.sqrt(np.mean((a - b) ** 2)), math.degrees(ours["A0"]), published[name + "_deg"]["A0"],
                     ours["frequency"], f))
    return rows


# Fitted frequencies that the authors of the published series give [Hz].
FREQUENCIES = dict(theta_B=10.2213, phi=10.2247, psi=20.2767, theta_R=10.1838, theta_A=10.1756)
