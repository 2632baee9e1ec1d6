"""In a source tree with a build of its own: installs what a command needs, and builds."""
import os
import subprocess
import sys

from monarch_flight import places, telling


def installed(*sections):
    """Sections of scripts/packages.txt. Elsewhere than in such a source tree nothing is installed."""
    if places.own_build() is not None:
        must([places.source() / "scripts/install", *sections])


def tried(section):
    """The same for what a command can do without; whoever needs it then says that it is missing."""
    if places.own_build() is None:
        return
    try:
        subprocess.run([str(places.source() / "scripts/install"), section], check=False)
    except OSError:
        pass


def built(*arguments):
    if places.own_build() is not None:
        must([places.source() / "scripts/build", *arguments])
    elif places.prefix() is None:
        sys.exit("monarch: no build of monarch_flight is in this shell; source the setup.bash of its workspace")


def ready(*sections):
    installed(*sections)
    built()


def must(command, **options):
    """Runs a command that tells itself what is wrong; ends with its exit code then."""
    words = [str(word) for word in command]
    try:
        code = subprocess.run(words, check=False, **options).returncode
    except OSError as error:
        sys.exit(f"monarch: {words[0]} cannot be started: {error.strerror}")
    if code:
        sys.exit(telling.passed_on(code, words[0], "monarch"))


def source_only(command):
    """The source tree, which this command needs."""
    if places.source() is None:
        sys.exit(f"monarch {command}: works in the source tree only; clone it, and call scripts/monarch {command}")
    return places.source()


def core_built(name, what):
    """The program `name` of the core, compiled without ROS into build_verify/."""
    root = source_only(what)
    build = os.environ.get("MONARCH_VERIFY_BUILD") or root / "build_verify"
    os.makedirs(build, exist_ok=True)
    log = os.path.join(build, "build.log")
    print(f"{what}: compiling into {build}", flush=True)
    with open(log, "w", encoding="utf-8") as file:
        for command in (["cmake", "-S", root, "-B", build, "-DMONARCH_ROS=OFF", "-DMONARCH_TESTS=OFF",
                         "-DMONARCH_NATIVE=ON"],
                        ["cmake", "--build", build, "--target", "monarch_" + name, "-j", str(os.cpu_count())]):
            if subprocess.run([str(word) for word in command], stdout=file, stderr=file, check=False).returncode:
                with open(log, encoding="utf-8", errors="replace") as told:
                    sys.stderr.writelines(told.readlines()[-40:])
                sys.exit(f"{what}: it does not compile; the reason is above, the whole log in {log}")
    return os.path.join(build, "devel/lib", places.PACKAGE, name)


def one_threaded(**more):
    """Environment in which BLAS and OpenMP take one thread."""
    return dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", **more)
