"""Where things lie: in a source tree with a build of its own, in a catkin workspace, or installed."""
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = "monarch_flight"


def source():
    """The source tree, or None where the package is installed."""
    root = HERE.parent.parent
    return root if (root / "package.xml").is_file() and (root / "scripts").is_dir() else None


def share():
    """The folder of config, launch, rviz and urdf."""
    if source() is not None:
        return source()
    for folder in HERE.parents:
        if (folder / "share" / PACKAGE / "config").is_dir():
            return folder / "share" / PACKAGE
    raise SystemExit(f"monarch: no configuration beside {HERE}; install the package again")


def config():
    return share() / "config"


def own_build():
    """The folder in which scripts/build compiles, where its programs are those to use; None elsewhere."""
    if source() is None:
        return None
    build = pathlib.Path(os.environ.get("MONARCH_BUILD") or source() / "build").absolute()
    if not os.environ.get("MONARCH_BUILD"):
        sourced = sourced_prefix()
        if sourced is not None and sourced.resolve() != (build / "devel").resolve():
            return None
    return build


def sourced_prefix():
    """The workspace, built from this source tree, whose setup.bash this shell has sourced, or None."""
    for folder in filter(None, os.environ.get("CMAKE_PREFIX_PATH", "").split(":")):
        if os.access(os.path.join(folder, "lib", PACKAGE, "coordinator"), os.X_OK) and built_from_here(folder):
            return pathlib.Path(folder)
    return None


def built_from_here(folder):
    """Whether the sources of a devel space, which catkin notes in a file, hold this tree."""
    try:
        noted = pathlib.Path(folder, ".catkin").read_text(encoding="utf-8").split(";")
    except OSError:
        return False
    return any(source().is_relative_to(pathlib.Path(place).resolve()) for place in filter(None, noted))


def prefix():
    """What holds lib/monarch_flight and setup.bash: a devel or an install space."""
    if own_build() is not None:
        return own_build() / "devel"
    if source() is None:
        return share().parent.parent
    return sourced_prefix()


def program(name):
    """A compiled program of the package."""
    return prefix() / "lib" / PACKAGE / name


def monarch():
    """The words that call monarch from a program."""
    here = source() / "scripts/monarch" if source() is not None else share().parent.parent / "bin/monarch"
    return [sys.executable, str(here)]


def flights():
    """Where runs are put that nobody named a folder for."""
    return (source() if own_build() is not None else pathlib.Path.cwd()) / "flights"


def person_path(path):
    """An absolute path of what a person typed, links not followed."""
    return pathlib.Path(os.path.abspath(path))
