"""Made-up led flights for the tests: a periodic flight of few harmonics, as a run would have written it."""
import copy
import math

import numpy as np

from monarch_flight import case_files
from monarch_flight.settling.led_flight import COMMANDS

F = 10.0  # [Hz]
STEPS, SAMPLES = 20, 10  # a flap
SET_POINT = (1.3, 20.0)  # [m/s], [deg]
# Mean, harmonics of cos and sin.
X, Z = (0.0, [-0.003, 0.0004], [-0.004, 0.0]), (0.0, [0.001, 0.0], [-0.005, 0.0002])
THETA_B, THETA_R = (0.3, [0.1, 0.02], [0.2, 0.0]), (0.05, [0.4, 0.0], [-0.2, 0.1])


def wave(series, phase, order=0):
    """Value of a series at phases, or its derivative in time."""
    mean, *both = series
    total = np.full_like(phase, mean if order == 0 else 0.0)
    for n, (a, b) in enumerate(zip(*both), 1):
        w = 2 * math.pi * n
        turned = (a * np.cos(w * phase) + b * np.sin(w * phase), b * np.cos(w * phase) - a * np.sin(w * phase),
                  -a * np.cos(w * phase) - b * np.sin(w * phase))[order]
        total = total + turned * (w * F) ** order
    return total


def case():
    rng = np.random.default_rng(1)
    angle = dict(A0=1.0, AN=[50.0, 2.0], BN=[-6.0, 0.5], multiple=1)
    controller = dict(samples=SAMPLES, inputs="amplitude, deviation_mean",
                      set_points=dict(flaps=[0, 1], speeds=[1.0, SET_POINT[0]], climbs_deg=[0, SET_POINT[1]]), slew=0.1,
                      table=dict(speeds=[1.0, 1.5], climbs_deg=[10.0, 30.0], commands=rng.normal(0, 0.02, (4, 2)).tolist(),
                                 states=rng.normal(0, 1, (4 * SAMPLES, 6)).tolist()),
                      gains={key: rng.normal(size=(2 * SAMPLES, n)).tolist() for key, n in (("state", 6), ("filter", 6), ("integral", 2))})
    names = ("amplitude", "flapping_mean", "frequency", "deviation_mean", "rest_angle", "abdomen_mean", "abdomen_amplitude")
    return dict(name="made_up", description="a: b", insect=dict(kind="butterfly", wing=dict(theta_0=0.01, root=[0.0, 0.1, 0.2])),
                fluid=dict(solver="quasi_steady"),
                motion=dict(type="fourier", frequency=F, phi_deg=angle, psi_deg=-2.0, theta_A_deg=dict(angle),
                            theta_B_deg=dict(angle), theta_R_deg=dict(angle),
                            body=dict(position=[0, 0, 0], velocity=[1.0, 0, 0.0], sway_x="none", sway_z="none")),
                initial=dict(position="none"), free=dict(x=True, z=True, pitch=True, wing_pitch=True),
                time=dict(t_start=0, steps_per_flap=STEPS, flaps=6), coupling=dict(prescribed_steps=STEPS, tolerance=1e-8),
                guidance=dict(type="controller", time_constant=0.06, limits={name: [-0.3, 0.2] for name in names},
                              rates={name: 6.0 for name in names}, controller=controller))


def columns(flaps=6, means=None, velocity=(1.2, -0.4), wind=(0.0, 0.0)):
    """Of flight.csv; `means`: constant commands."""
    t = np.arange(flaps * STEPS + 1) / (F * STEPS)
    phase = F * t
    c = dict(t=t, phase=phase)
    for name, series, v in (("x", X, velocity[0]), ("z", Z, velocity[1])):
        c[name], c["v" + name], c["a" + name] = v * t + wave(series, phase), v + wave(series, phase, 1), wave(series, phase, 2)
    for name, series in (("theta_B", THETA_B), ("theta_R", THETA_R)):
        c[name], c[name + "_dot"], c[name + "_ddot"] = (wave(series, phase, order) for order in range(3))
    c |= {name: np.zeros_like(t) for name in ("clipped", "refused", "lost", "y", "vy", "ay", "wy", "roll", "yaw")} | dict(wx=0 * t + wind[0], wz=0 * t + wind[1])
    for name in COMMANDS:
        c["applied_" + name] = np.full_like(t, (means or {}).get(name, 0.0))
    return c


def write(folder, case_, columns_):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.yaml").write_text(case_files.text(copy.deepcopy(case_)), encoding="utf-8")
    rows = [",".join(repr(float(v)) for v in row) for row in np.column_stack(list(columns_.values()))]
    (folder / "flight.csv").write_text("\n".join([",".join(columns_)] + rows) + "\n", encoding="utf-8")
    return folder
