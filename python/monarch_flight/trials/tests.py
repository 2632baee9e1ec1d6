"""Runs the tests and the linters (monarch check)."""
import json
import os
import pathlib
import re
import subprocess
import sys

from monarch_flight import preparing

# Whole flights, processes of MPI, and tests that count or limit memory are for the usual build.
UNSANITIZED = ["-LE", "flight|python", "-E", "parallel|allocation|lost_memory|fluid_hung|fluid_blas"]
UNITY = re.compile(r"/Unity/unity_\d+_\w+\.\w+$")
SUMMARY = re.compile(r"^.* tests passed, (\d+) tests failed out of (\d+)$", re.MULTILINE)


def build_folder(root):
    return pathlib.Path(os.environ.get("MONARCH_BUILD") or root / "build").absolute()


def system_path():
    return "/usr/bin:" + os.environ.get("PATH", "")


def apart(command):
    """A command of compile_commands.json as one a source: those that are compiled together (MONARCH_UNITY) stand as #include
    in a file that cmake makes."""
    if not UNITY.search(command["file"]):
        return [command]
    text = pathlib.Path(command["file"]).read_text(encoding="utf-8")
    return [dict(command, file=file, command=command["command"].replace(command["file"], file))
            for file in re.findall(r'^#include "(.+)"$', text, re.MULTILINE)]


def sources(build, folder):
    """What is compiled of a folder; how, stands in lint/compile_commands.json of the build then."""
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    commands = [one for command in commands for one in apart(command)]
    (build / "lint").mkdir(exist_ok=True)
    (build / "lint/compile_commands.json").write_text(json.dumps(commands), encoding="utf-8")
    return sorted({one["file"] for one in commands if one["file"].startswith(str(folder) + "/")})


def lint(root, folder):
    """Exit code."""
    build = build_folder(root)
    os.environ.update(MONARCH_BUILD=str(build), PATH=system_path())
    preparing.installed("fly", "lint")
    preparing.built()
    found = sources(build, root / folder)
    if not found:
        sys.exit(f"lint: nothing below {folder} is compiled")
    # GCC's names of warnings are not all clang's.
    tidy = ["xargs", "-0", "-n", "1", "-P", str(os.cpu_count()), "clang-tidy", "--quiet", "-p", str(build / "lint"),
            "--warnings-as-errors=*", "--extra-arg=-Wno-unknown-warning-option"]
    preparing.must(tidy, input="\0".join(found).encode(), cwd=root)
    if folder == "src":
        preparing.must(["catkin_lint", "-W1", "."], cwd=root)
        scripts = [path for path in [*(root / "scripts").iterdir(), root / ".ci/run"] if path.is_file()
                   and path.read_bytes().startswith(b"#!/bin/bash")]
        preparing.must(["shellcheck", *sorted(scripts)], cwd=root)
    print("lint: nothing found")
    return 0


def sanitized(root, sanitizers):
    """The build's arguments; the environment is made ready."""
    # Leaks at the end are those of ROS and MPI; libraries without instrumentation look like races.
    os.environ.update(MONARCH_BUILD=f"{build_folder(root)}-{sanitizers.replace(',', '-')}",
                      ASAN_OPTIONS="detect_leaks=0", UBSAN_OPTIONS="print_stacktrace=1",
                      TSAN_OPTIONS=f"suppressions={root}/scripts/thread_sanitizer.txt second_deadlock_stack=1")
    return ["-DMONARCH_SANITIZERS=" + sanitizers]


def tested(root, sanitizers, arguments):
    """Exit code."""
    options = []
    if sanitizers:
        options, arguments = sanitized(root, sanitizers), UNSANITIZED + arguments
    build = build_folder(root)
    os.environ["MONARCH_BUILD"] = str(build)  # this tree's, whatever this shell has sourced
    preparing.installed("fly", "check", "report")
    preparing.built("--tests", *options)
    environment = dict(preparing.one_threaded(), PATH=system_path())
    # One more than cores: many tests wait for nodes most of their time.
    command = ["ctest", "-j", str((os.cpu_count() or 1) + 1), "--output-on-failure", "--no-tests=error", *arguments]
    ctest = subprocess.Popen(command, cwd=build, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True, errors="replace")
    found = None
    for line in ctest.stdout:
        sys.stdout.write(line)
        sys.stdout.flush()
        found = SUMMARY.match(line) or found
    code = ctest.wait()
    if found is None:
        print("check: ctest gave no result", file=sys.stderr)
        return 1
    failed, total = map(int, found.groups())
    print(f"{total - failed} passed, {failed} failed")
    return code
