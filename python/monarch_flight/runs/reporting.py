"""The page of a flight that has ended (monarch report). Whatever becomes of it, the flight is what it is."""
from monarch_flight.keys import Refused
from monarch_flight.report import NAME
from monarch_flight.telling import say


def wanted(request):
    return request.given("report") != "false" and not request.plan


def written(folder):
    """Writes the page into the folder of a run; its path, or None where there is none, which is said."""
    try:
        from monarch_flight.report import page
        page.write([folder], folder / NAME)
        return folder / NAME
    except Refused as refusal:
        why = "; ".join(refusal.faults)
    except ModuleNotFoundError as missing:
        why = f"{missing}; it is of the packages that `scripts/install report` installs"
    except Exception as error:  # noqa: BLE001 (a page must not end a flight)
        why = f"{type(error).__name__}: {error}"
    say(f"no {NAME}: {why}")
    return None
