"""Calls compiled programs of the package that read their key:=value themselves."""
import subprocess

from monarch_flight import preparing


def called(program, words):
    """Exit code."""
    return subprocess.run([str(program), *words], env=preparing.one_threaded(), check=False).returncode


def called_with_case(program, words):
    """The first word may be the name of a case."""
    if words and ":=" not in words[0]:
        words = ["case:=" + words[0], *words[1:]]
    return called(program, words)
