"""In a source tree with a build of its own: installs what a command needs, and builds."""
import os
import secrets
import subprocess
import sys
import time

from monarch_flight import places, telling
from monarch_flight.runs import watched

AGAIN = 24 * 3600.0  # s, until what could not be installed, and is not needed, is tried once more


def installed(*sections):
    """Sections of scripts/packages.txt. Elsewhere than in such a source tree nothing is installed."""
    if places.own_build() is not None:
        must([places.source() / "scripts/install", *sections], ends=False)  # half a package is worse than a late one


def tried(section):
    """The same for what a command can do without; whoever needs it then says that it is missing. In vain, as without a
    network: not again on the same day."""
    build = places.own_build()
    if build is None:
        return
    vain = build / f".no_{section}"
    try:
        if 0.0 <= time.time() - vain.stat().st_mtime < AGAIN:
            return
    except OSError:
        pass  # there is no such file
    script = str(places.source() / "scripts/install")
    try:
        if subprocess.run([script, section], check=False).returncode == 0:
            vain.unlink(missing_ok=True)
            return
        vain.touch()
        telling.say(f"going on without; {script} {section} tries again, and this command after a day", "install")
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


def ended(command, ends=True, **options):
    """Exit code of a command. When this program is stopped meanwhile, all that the command has started ends, too: a compiler
    hears nothing of a SIGTERM to whoever asked for it. Not where `ends` is false."""
    mark, data = secrets.token_hex(8), options.pop("input", None)
    options["env"] = dict(options.get("env") or os.environ, **{watched.MARK: mark})
    with subprocess.Popen([str(word) for word in command], stdin=None if data is None else subprocess.PIPE, **options) as process:
        try:
            process.communicate(data)
        except BaseException:
            process.terminate()
            if ends:
                watched.end_all(mark)
            raise
    return process.returncode


def must(command, **options):
    """Runs a command that tells itself what is wrong; ends with its exit code then."""
    words = [str(word) for word in command]
    try:
        code = ended(words, **options)
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
    print(f"{what}: compiling into {build}, minutes the first time; log: {log}", flush=True)
    with open(log, "w", encoding="utf-8") as file:
        for command in (["cmake", "-S", root, "-B", build, "-DMONARCH_ROS=OFF", "-DMONARCH_TESTS=OFF",
                         "-DMONARCH_NATIVE=ON"],
                        ["cmake", "--build", build, "--target", "monarch_" + name, "-j", str(os.cpu_count())]):
            if ended(command, stdout=file, stderr=file):
                with open(log, encoding="utf-8", errors="replace") as told:
                    sys.stderr.writelines(told.readlines()[-40:])
                sys.exit(f"{what}: it does not compile; the reason is above, the whole log in {log}")
    return os.path.join(build, "devel/lib", places.PACKAGE, name)


def one_threaded(**more):
    """Environment in which BLAS and OpenMP take one thread."""
    return dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", **more)
