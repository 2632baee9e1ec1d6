"""monarch identify: searches, and writes what was found into a folder."""
import sys

from monarch_flight.identification import confidence, fit, flights, picture, report
from monarch_flight.keys import Refused
from monarch_flight.telling import FAILED


def tell(text):
    print(text, flush=True)


def identify(study, out, jobs, threads, most):
    """Exit code."""
    flown = flights.Flights(out, [one.angle for one in study.measured], jobs, threads)
    try:
        found = fit.search(study, flown, most, tell)
    except flights.Unflown as refusal:
        raise Refused(f"a flight of the study was refused; correct its case, its ranges or its stages:\n{refusal}") from None
    except fit.NoWay as end:
        print(f"identify: {end}", file=sys.stderr)
        return FAILED
    last = found[-1]
    known = confidence.confidence(last.jacobian, last.comparisons.residuals, last.comparisons.independent)
    write(study, found, known, out)
    tell(f"\n{report.text(study, found, known)}\n\n{flown.flown} flights flown; case, identification.yaml, identification.txt and "
         f"residual.png are in {out}")
    return 0


def write(study, found, known, out):
    """The case that was found, what is known of it, and the picture."""
    put(out / f"{study.name}.yaml", report.case(study, found, known))
    put(out / "identification.yaml", report.record(study, found, known))
    put(out / "identification.txt", report.text(study, found, known) + "\n")
    picture.draw(study, found, out / "residual.png")


def put(path, text):
    """A file is there whole or not at all."""
    active = path.with_name(path.name + ".active")
    active.write_text(text, encoding="utf-8")
    active.rename(path)
