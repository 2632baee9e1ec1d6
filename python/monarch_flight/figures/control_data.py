"""What the figures of controlled flights are drawn from: led flights beside uncontrolled ones of the same insect."""
import math
import sys

import numpy as np

from monarch_flight.figures import data
from monarch_flight.settling.led_flight import LedFlight, Unfit, shown

CASE = "climb_controlled"
LENGTHS = dict(quasi_steady=(40, 12), navier_stokes=(30, 10))  # flaps with and without control
TUMBLED = math.radians(60.0)


def flights(settings):
    """The flights given by runs:=, or the case flown in both airs with and without control."""
    folders = settings.given or [
        data.run(settings.runs, CASE, f"fluid:={air}", f"flaps:={flaps}", "record:=false", *leader, may_fail=bool(leader))
        for air, lengths in LENGTHS.items() for flaps, leader in zip(lengths, ([], ["guidance:=motion"]))]
    try:
        return [LedFlight(folder) for folder in folders]
    except Unfit as unfit:
        sys.exit("\n".join(f"figures: {fault}" for fault in unfit.faults))


def pairs(all_flights):
    """{name of the figure: (led flight, uncontrolled one of the same insect in the same air and wind, or None)}."""
    led = [flight for flight in all_flights if flight.kind != "motion"]
    airs = [flight.case["fluid"]["solver"] for flight in led]
    found = {}
    for flight, air in zip(led, airs):
        name = f"control_{air}" + (f"_{flight.folder.name}" if airs.count(air) > 1 else "")
        alone = [other for other in all_flights if other.kind == "motion"
                 and all(other.case[key] == flight.case[key] for key in ("insect", "fluid"))]
        found[name] = (flight, alone[0] if alone else None)
    return found


def tumbled_from(flight):
    """Row at which body pitch first passes 60 deg, or None."""
    rows = np.flatnonzero(np.abs(flight.columns["theta_B"]) > TUMBLED)
    return int(rows[0]) if rows.size else None


def rows_shown(flight):
    """Up to a flap behind the one at which the body tumbles: what comes then is no flight."""
    row, phase = tumbled_from(flight), flight.columns["phase"]
    return slice(None) if row is None else slice(0, int(np.searchsorted(phase, phase[row] + 1.0)) + 1)


def flap_means(flight):
    """Middles of the flaps on the phase clock, climb [deg], speed [m/s], as far as rows are shown."""
    last = rows_shown(flight).stop
    flaps = [flap for flap in flight.flaps if last is None or flap.last < last]
    return [np.array(values) for values in ([flap.number - 0.5 for flap in flaps], [math.degrees(flap.climb) for flap in flaps],
                                            [flap.speed for flap in flaps])]


def set_point_steps(flight):
    """Edges on the phase clock, climb [deg] and speed [m/s] between them; empty without a controller."""
    points, end = flight.set_points(), float(flight.columns["phase"][-1])
    points = [point for point in points if point[0] < end]
    if not points:
        return [], [], []
    starts, speeds, climbs = (list(values) for values in zip(*points))
    return [max(0.0, float(starts[0]))] + [float(start) for start in starts[1:]] + [end], climbs, speeds


def command(flight, name):
    """A command as flown, over the rows, and its limits, in % or deg."""
    return (np.array([shown(name, value) for value in flight.columns["applied_" + name]]),
            [shown(name, value) for value in flight.case["guidance"]["limits"][name]])


def wind(flight):
    """North, east and up of the wind [m/s], or None in still air."""
    c = flight.columns
    return (c["wx"], c["wy"], -c["wz"]) if any(np.any(c[name]) for name in ("wx", "wy", "wz")) else None
