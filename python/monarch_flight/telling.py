"""Words to the person, where there still is one."""
import os
import sys


def say(text, who="fly"):
    """On stderr; a closed terminal takes nothing, and that is no fault."""
    try:
        print(f"{who}: {text}", file=sys.stderr, flush=True)
    except OSError:
        sys.stdout = sys.stderr = open(os.devnull, "w", encoding="utf-8")
