#!/usr/bin/python3
"""Runs a command with a ROS master of its own on a free port, and ends both within a time limit.

usage: with_master.py [--limit SECONDS] COMMAND [ARGUMENT ...]
The exit code is that of the command; 124 when the limit ended it.
"""
import argparse
import ctypes
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import xmlrpc.client


def die_with_parent():
    """In a child: killed when this program ends, however it ends."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


def free_port():
    with socket.socket() as s:
        s.bind(("localhost", 0))
        return s.getsockname()[1]


def end(process):
    """Ends the process and all its children."""
    for sign in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, sign)
        except ProcessLookupError:
            return
        try:
            process.wait(3)
        except subprocess.TimeoutExpired:
            pass


def start_master(environment, uri, port):
    """A master that answers; another port may be tried when it does not."""
    log = open(os.path.join(environment["ROS_LOG_DIR"], "master.log"), "w")
    master = subprocess.Popen(
        ["/usr/bin/python3", "/usr/bin/rosmaster", "--core", "-p", str(port)],
        env=environment, stdout=log, stderr=log, start_new_session=True,
        preexec_fn=die_with_parent)
    deadline = time.time() + 20
    while time.time() < deadline and master.poll() is None:
        try:
            xmlrpc.client.ServerProxy(uri).getPid("/with_master")
            return master
        except OSError:
            time.sleep(0.05)
    end(master)
    sys.exit("with_master: no master on port %d: see %s" % (port, log.name))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with tempfile.TemporaryDirectory(prefix="monarch_test_") as folder:
        port = free_port()
        uri = "http://localhost:%d" % port
        environment = dict(os.environ, ROS_MASTER_URI=uri, ROS_HOSTNAME="localhost",
                           ROS_LOG_DIR=folder, ROS_HOME=folder)
        environment["PATH"] = "/usr/bin:" + environment.get("PATH", "")
        environment.pop("ROS_IP", None)
        environment.pop("ROS_NAMESPACE", None)
        master = start_master(environment, uri, port)
        command = subprocess.Popen(arguments.command, env=environment, start_new_session=True,
                                   preexec_fn=die_with_parent)
        try:
            return command.wait(arguments.limit)
        except subprocess.TimeoutExpired:
            print("with_master: not done after %g s" % arguments.limit, file=sys.stderr)
            return 124
        finally:
            end(command)
            end(master)


if __name__ == "__main__":
    sys.exit(main())
