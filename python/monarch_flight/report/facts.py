"""The tables of the page: key figures, differences of runs, versions and hashes."""
import datetime

from monarch_flight.report.provenance import told

AIRS = dict(navier_stokes="Navier-Stokes", quasi_steady="quasi-steady")


def air(flown):
    solver = flown.case["fluid"]["solver"]
    return AIRS.get(solver, solver)


def duration(seconds):
    if seconds < 120:
        return f"{seconds:.1f} s"
    return f"{seconds / 60:.1f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def length(flown):
    t = flown.columns["t"]
    seconds = f"{t[-1] - t[0]:.4g} s"
    return (f"{flown.summary['flaps']:.4g} flaps, " if flown.frequency else "") + seconds


def key_figures(flown):
    """(name, value, remark), the most important first."""
    s, t = flown.summary, flown.columns["t"]
    cells = s.get("cells", 0)
    yield "Flown", f"{s['flaps']:.4g} flaps" if flown.frequency else f"{t[-1] - t[0]:.4g} s", f"{s['steps']} steps, {t[-1] - t[0]:.4g} s"
    if not flown.bare:
        yield "Climb", f"{s['climb_angle_deg']:.1f}°", "of the mean velocity"
    yield "Speed", f"{s['speed_m_s']:.3f} m/s", "of the mean velocity"
    if not flown.bare:
        pitch = s["theta_B_deg"]
        yield "Body pitch", f"{pitch['mean']:.1f}°", f"from {pitch['min']:.1f} to {pitch['max']:.1f}°"
    wing = s["theta_R_deg"]
    yield "Wing pitch", f"{wing['min']:.1f} to {wing['max']:.1f}°", f"mean {wing['mean']:.1f}°"
    yield "Air", air(flown), f"{cells:,} cells".replace(",", " ") if cells else "blade elements" if air(flown) == AIRS[
        "quasi_steady"] else ""
    sub = s["sub_iterations"]
    retried = f", {s['retried_steps']} steps tried twice" if s["retried_steps"] else ""
    yield "Sub-iterations", f"{sub['mean']:.2f}", f"a step, at most {sub['max']}{retried}"
    yield "Computing", duration(s["wall_s"]["total"]), f"{1e3 * s['wall_s']['total'] / max(s['steps'], 1):.3g} ms a step"


def remarks(flown):
    """Sentences that a reader must not miss."""
    s = flown.summary
    if s["status"] != "complete":
        yield f"This run is not complete: {s['failure'] or s['status']}."
    if s.get("tumbled_from_step") is not None:
        place = f"flap {s['tumbled_from_flap']}" if s.get("tumbled_from_flap") is not None else f"step {s['tumbled_from_step']}"
        yield f"The body tumbled: pitch or roll passed 60° in {place}."
    guidance = s.get("guidance") or {}
    if guidance.get("lost_from_flap") is not None:
        yield f"The controller gave up in flap {guidance['lost_from_flap']}."
    yield from s.get("remarks", [])


def versions(flown):
    s = flown.summary
    yield "Version of monarch_flight", s["version"]
    yield "Instruction set of the flow", s.get("instruction_set", "not told")
    yield "SHA-256 of the states", s["state_sha256"]
    yield "SHA-256 of the case", s["case_sha256"]
    ended = datetime.datetime.fromtimestamp((flown.folder / "summary.json").stat().st_mtime)
    yield "Ended", f"{ended:%Y-%m-%d %H:%M}"
    yield "Folder", flown.folder.name
    for part in s.get("resumed", []):
        yield "Went on from step", str(part["step"])


def differences(runs):
    """(name, values) of the figures in which runs differ, then of the keys of their cases."""
    figures = [{name: value + (f" ({remark})" if remark else "") for name, value, remark in key_figures(run)} for run in runs]
    hashes = [dict(list(versions(run))[:4]) for run in runs]
    rows = [(name, [figure.get(name, "-") for figure in figures]) for name in figures[0]]
    rows += [(name, [one[name] for one in hashes]) for name in hashes[0]]
    found = [row for row in rows if len(set(row[1])) > 1]
    cases = [dict(flat(run.case)) for run in runs]
    keys = dict.fromkeys(key for case in cases for key in case)
    return found, [(key, [told(case[key]) if key in case else "-" for case in cases]) for key in keys
                   if len({repr(case.get(key)) for case in cases}) > 1]


def flat(node, above=""):
    """Keys of a case by their paths; a table of numbers counts as one."""
    for key, value in node.items():
        if isinstance(value, dict):
            yield from flat(value, f"{above}{key}/")
        else:
            yield above + key, value
