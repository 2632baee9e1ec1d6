"""Calls compiled programs of the package that read their key:=value themselves."""
import pathlib
import subprocess
import sys

from monarch_flight import preparing, telling


def called(program, words):
    """Exit code."""
    environment = preparing.one_threaded()
    try:
        code = subprocess.run([str(program), *words], env=environment, check=False).returncode
    except OSError as error:
        sys.exit(f"monarch: {program} cannot be started: {error.strerror}; build the package again")
    name = pathlib.Path(program).name
    return telling.passed_on(code, "the program " + name, name)


def called_with_case(program, words):
    """The first word may be the name of a case."""
    if words and ":=" not in words[0]:
        words = ["case:=" + words[0], *words[1:]]
    return called(program, words)
