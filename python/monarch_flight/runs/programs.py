"""Calls compiled programs of the package that read their key:=value themselves."""
import subprocess

from monarch_flight import places, preparing


def called(program, words):
    """Exit code."""
    environment = preparing.one_threaded(MONARCH_CONFIG=str(places.config()))
    return subprocess.run([str(program), *words], env=environment, check=False).returncode


def called_with_case(program, words):
    """The first word may be the name of a case."""
    if words and ":=" not in words[0]:
        words = ["case:=" + words[0], *words[1:]]
    return called(program, words)
