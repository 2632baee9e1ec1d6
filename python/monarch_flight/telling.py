"""Words to the person, where there still is one."""
import os
import signal
import sys

FAILED, STOPPED = 1, 130  # exit codes


def say(text, who="fly"):
    """On stderr; a closed terminal takes nothing, and that is no fault."""
    try:
        print(f"{who}: {text}", file=sys.stderr, flush=True)
    except OSError:
        sys.stdout = sys.stderr = open(os.devnull, "w", encoding="utf-8")


def called_as(name):
    """How the person calls the command, for advice: scripts/fly says who it is, and scripts/monarch is seen."""
    monarch = sys.argv[0] if sys.argv[0] in ("scripts/monarch", "./scripts/monarch", "./monarch") else "monarch"
    own = os.environ.get("MONARCH_CALLED_AS") if name == "fly" else None
    return own or f"{monarch} {name}"


def signal_of(code):
    """Name of the signal that ended a program, by its exit code as subprocess or a shell (128 + number) has it; empty
    where it ended by itself."""
    if 0 <= code <= 128:
        return ""
    number = -code if code < 0 else code - 128
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def passed_on(code, what, who):
    """Exit code of a command, from that of the program which does its work: where a signal ended that one, this is said,
    and the command has failed."""
    name = signal_of(code)
    if not name:
        return code
    if name == "SIGINT":
        return STOPPED
    say(f"{what} died ({name})", who)
    return FAILED
