"""Compares the package with something known: the flow solver with exact solutions, tables and experiments
(docs/verification.md), or, with the name dynamics, the flight dynamics: conservation, exact motions, published
histories, an independent engine (docs/dynamics.md).

monarch verify [NAME ...]
  of the flow: direct_solve added_mass uniform_stream affine taylor_green stokes blasius momentum_balance (the quick
  ones, which run without a name), plate_re100 disc_drag pitching_rolling revolving_wing rim stability monarch_flap
  outer, or all
monarch verify dynamics [NAME ...]
  reduced exact momentum energy newmark published simbody; without a name all of them
monarch verify neighbours
  the estimate of what the other wing and the body would change (monarch neighbours); seconds, compiles nothing

The core is compiled without ROS. The exit code is 0 only if every row is within its bound. What the files hold of
other names is kept."""
import re

from monarch_flight import keys, preparing
from monarch_flight.keys import Key, Table
from monarch_flight.runs.programs import called

SECTIONS = ("fly", "verify")
KEYS = Table([
    Key("out", "path", "folder of verification.json and of the curves", default="verification"),
    Key("images", "path", "folder of the plots of the flow, as docs/images, which renews those of the documentation",
        default="that of out")])


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="NAME | key:=value")
    parser.epilog = KEYS.help()


def known(names, source):
    """Refuses at once what the program would refuse after it has been compiled; its table of subjects tells."""
    subjects = re.findall(r'^ +\{"(\w+)", ', source.read_text(encoding="utf-8"), re.MULTILINE)
    faults = [f"{name}: no such subject{keys.nearest(name, subjects)}; known are {', '.join(subjects)}"
              for name in names if name not in subjects]
    if faults:
        raise keys.Refused(*faults)


def flow(names, values):
    known([name for name in names if name != "all"], preparing.source_only("verify") / "bench/verify/main.cpp")
    preparing.installed("fly", "verify")
    program = preparing.core_built("verify", "verify")
    out = values.get("out", "verification")
    code = called(program, [*names, "out:=" + out])
    if code in (0, 1):
        from monarch_flight.figures import verification
        verification.draw_all(out, values.get("images", out))
    return code


def dynamics(names, values):
    preparing.source_only("verify")
    preparing.installed("fly", "dynamics")
    program = preparing.core_built("verify_dynamics", "verify dynamics")
    words = names + [f"out:={values['out']}"] * ("out" in values)
    return called(program, words)


def neighbours(_, values):
    preparing.installed("fly")
    from monarch_flight.neighbours import table
    return table.verified(values.get("out", "verification"))


PARTS = {"flow": flow, "dynamics": dynamics, "neighbours": neighbours}


def run(arguments):
    values, names, faults = KEYS.read(arguments.words, plain=True)
    part = names[0] if names and names[0] in PARTS else ""
    if part in ("dynamics", "neighbours") and "images" in values:
        faults.append(f"images:={values['images']}: the {part} have no plots of their own; leave it out")
    if part == "neighbours" and names[1:]:
        faults.append(f"{names[1]}: neighbours are verified as a whole; leave it out")
    if faults:
        raise keys.Refused(*faults)
    return PARTS[part or "flow"](names[bool(part):], values)
