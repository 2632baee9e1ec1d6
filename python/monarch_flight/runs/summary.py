"""The summary of a run as a small table."""
import json
import os
import sys


def spread(values, form):
    texts = (form % values[key] for key in ("mean", "min", "max"))
    return "mean %s, from %s to %s" % tuple(form % 0 if float(text) == 0 else text for text in texts)  # no -0.0


def guidance(g):
    """What has become of the commands of a flight that was led."""
    lost = ", lost from flap %d" % g["lost_from_flap"] if g.get("lost_from_flap") is not None else ""
    cut = "1 command cut to its bounds" if g["clipped"] == 1 else "%d commands cut to their bounds" % g["clipped"]
    return "%s, %s, %d refused%s" % (g["type"], cut, g["refused"], lost)


def table(s):
    """(name, text) rows of a summary.json."""
    sub, wall = s["sub_iterations"], s["wall_s"]
    flaps = "1 flap" if s["flaps"] == 1 else "%g flaps" % s["flaps"]
    yield "steps", "%d (%s), %d at the second attempt" % (s["steps"], flaps, s["retried_steps"])
    for remark in s.get("remarks", []):
        yield "note", remark
    if s.get("tumbled_from_flap") is not None:
        yield "tumbled", "from flap %d on (step %d): body pitch or roll beyond 60 deg" % (s["tumbled_from_flap"],
                                                                              s["tumbled_from_step"])
    elif s.get("tumbled_from_step") is not None:
        yield "tumbled", "from step %d on: body pitch or roll beyond 60 deg" % s["tumbled_from_step"]
    if s.get("guidance", {"type": "motion"})["type"] != "motion":
        yield "guidance", guidance(s["guidance"])
    yield "sub-iterations", "mean %.1f, at most %d" % (sub["mean"], sub["max"])
    if s.get("free_steps", 1):  # where nothing is free, nothing is solved
        yield "air", "%.2f evaluations a step, added-mass ratio up to %.2f" % (s["fluid_evaluations"]["mean"],
                                                                               s["added_mass_ratio"]["max"])
    yield "climb angle", "%.1f deg" % s["climb_angle_deg"]
    yield "speed", "%.3f m/s" % s["speed_m_s"]
    yield "body pitch", spread(s["theta_B_deg"], "%.1f") + " deg"
    if "roll_deg" in s:
        yield "body roll", spread(s["roll_deg"], "%.1f") + " deg"
    yield "wing pitch", spread(s["theta_R_deg"], "%.1f") + " deg"
    if "theta_L_deg" in s:
        yield "left wing pitch", spread(s["theta_L_deg"], "%.1f") + " deg"
    yield "grid", "%d cells" % s["cells"] if s["cells"] else "none (%s)" % s.get("fluid", "quasi_steady")
    names = ("fluid", "fluid_left", "flight", "wing", "exchange", "coupling", "outputs")
    parts = ", ".join("%s %.1f" % (key, wall[key]) for key in names if key in wall)
    yield "wall time", "%.1f s (%s)" % (wall["total"], parts)
    if "fluid_s" in s:
        largest = sorted(s["fluid_s"].items(), key=lambda part: -part[1])[:5]
        whole = max(wall["fluid"] + wall.get("fluid_left", 0), 1e-9)
        yield "of the fluid", ", ".join("%s %.0f %%" % (name, 100 * t / whole) for name, t in largest)
    yield "state sha256", s["state_sha256"]


def load(folder):
    """The summary of a run's folder, or (None, why there is none)."""
    path = os.path.join(folder, "summary.json")
    try:
        with open(path) as f:
            return json.load(f), ""
    except FileNotFoundError:
        if not os.path.isdir(folder):
            return None, "%s: there is no such folder; give that of a run" % folder
        return None, "the run wrote no summary (%s)" % path
    except (OSError, ValueError) as e:
        return None, "%s cannot be read: %s" % (path, e)


def size(path):
    """Of a file, or of all files below a folder [bytes]."""
    if not os.path.isdir(path):
        return os.path.getsize(path)
    return sum(os.path.getsize(os.path.join(place, name)) for place, _, names in os.walk(path) for name in names)


def in_words(count):
    return "%.1f MB" % (count / 1e6) if count >= 1e6 else "%.1f kB" % (count / 1e3)


def show(folder):
    """Prints the summary of a run's folder; exit code 0 only for a complete run."""
    told, problem = load(folder)
    if told is None:
        print("summary: failed: " + problem, file=sys.stderr)
        return 1
    try:
        rows = list(table(told))
    except (KeyError, TypeError, AttributeError) as error:
        print("summary: failed: %s/summary.json is not that of a run: it lacks %s" % (folder, error), file=sys.stderr)
        return 1
    print("summary of %s" % folder)
    for name, text in rows:
        print("  %-15s %s" % (name, text))
    for name in sorted(os.listdir(folder)):
        print("  %-15s %s" % (name, in_words(size(os.path.join(folder, name)))))
    if told["status"] != "complete":
        print("summary: %s: %s" % (told["status"], told["failure"]), file=sys.stderr)
        return 1
    return 0
