"""The token of a run and its seals (docs/protocol.md), as a solver of one's own (solver_node) needs them."""
import fcntl
import hashlib
import hmac
import io
import os
import time

import rospy

from monarch_flight.solver_start import Coordinator, NoFlight

SEAL = 32  # bytes at the end of every message

OF_ONE_RUN = b"of one run: "  # what a coordinator has made begins with it, and is locked while it lives


def token_path():
    """Where the run's token is; empty where it has none."""
    path = rospy.get_param("token_file", "")
    return os.path.join(rospy.get_param("directory", ""), path) if path not in ("", "auto") else ""


def token_in(path):
    """What the file holds; nothing where there is none, or one that a run which was killed has left."""
    try:
        with open(path, "rb") as f:
            facts = os.fstat(f.fileno())
            if facts.st_uid != os.geteuid() or facts.st_mode & 0o077:
                raise NoFlight("token_file = %s: must be yours alone (chmod 600)" % path)
            token = f.read().rstrip()
            return b"" if token.startswith(OF_ONE_RUN) and not held(f) else token
    except FileNotFoundError:
        return b""


def held(file):
    try:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    fcntl.flock(file, fcntl.LOCK_UN)
    return False


def token_of_run(limit=30):
    """What the file of the parameter token_file holds; the coordinator makes it in the beginning."""
    path = token_path()
    token = token_in(path) if path else b""
    coordinator, end = Coordinator(), time.monotonic() + limit
    while path and not token:
        if time.monotonic() > end or rospy.is_shutdown():
            raise NoFlight("token_file = %s: there is no such file after %g s: is the coordinator running?" % (path, limit))
        coordinator.refuse()
        time.sleep(0.02)
        token = token_in(path)
    return token


def seal_of(token, topic, data):
    """Of a serialized message, whose own seal is left out."""
    return hmac.new(token, topic.encode() + b"\0" + data[:-SEAL], hashlib.sha256).digest()


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
