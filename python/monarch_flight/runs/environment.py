"""The environment in which the nodes of a flight are started."""
import os
import subprocess
import sys

from monarch_flight import places

ROS_OWN = ("ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP")  # the person's, not the setup script's


def has_sourced(prefix):
    """Whether this shell has the setup.bash of that place behind it, or of a workspace on top of it."""
    sourced_ones = filter(None, os.environ.get("CMAKE_PREFIX_PATH", "").split(":"))
    return os.path.realpath(prefix) in map(os.path.realpath, sourced_ones) and "ROS_PACKAGE_PATH" in os.environ


def sourced():
    """That of this process, after the setup.bash of the build or the installation in use. Where that is done it is not
    done again: it would take workspaces on top of it away. A Debian package has none, and needs none."""
    script = places.prefix() / "setup.bash"
    base = dict(os.environ, PATH="/usr/bin:" + os.environ.get("PATH", ""))
    if has_sourced(places.prefix()) or not script.is_file():
        return base
    told = subprocess.run(["bash", "-c", 'source "$1" >/dev/null && env -0', "bash", str(script)], check=True,
                          env=base, stdout=subprocess.PIPE).stdout
    found = dict(item.split("=", 1) for item in os.fsdecode(told).split("\0") if "=" in item)
    for name in ROS_OWN:
        found.pop(name, None)
        if os.environ.get(name):
            found[name] = os.environ[name]
    return found


def of_flight(base):
    """BLAS leaves threads to the flow solver; lines that come in order; and a decimal point in every program, whatever the language: rviz
    would take the person's for the numbers of the URDF. Colours of rosconsole are for a terminal."""
    plain = {} if sys.stdout.isatty() else {"NO_COLOR": "1"}
    return dict(base, PWD=os.getcwd(), LC_ALL="C.UTF-8", PYTHONUNBUFFERED="1",
                OPENBLAS_NUM_THREADS="1", **plain)


def of_processes(base):
    """For MPI on one machine: waiting processes give their core away, containers run as root, and after Ctrl-C the last
    checkpoint is still made."""
    return dict(base, OMPI_MCA_mpi_yield_when_idle="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_odls_base_sigkill_timeout="10")
