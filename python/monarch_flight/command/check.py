"""Installs what is missing, builds, runs every test, prints the output of those that fail; the last line is "N
passed, N failed". The exit code is 0 only if every test passed.

monarch check [sanitizers:=LIST] [ctest's arguments]     e.g. monarch check -R pressure (everything is compiled first)
monarch check lint:=true | lint:=FOLDER"""
from monarch_flight import keys, preparing
from monarch_flight.keys import Key, Table

PASSES_ON = True  # to ctest
LISTS = ("address", "undefined", "address,undefined", "thread")
KEYS = Table([
    Key("sanitizers", "choice", "the tests of core and nodes in a build of their own with these sanitizers of GCC "
        "(half an hour and more); a finding is a failure", choices=LISTS),
    Key("lint", "path", "true: clang-tidy on all of src/ and include/ (half an hour), catkin_lint, shellcheck; nothing "
        "is tested. A folder below src: clang-tidy on what lies there alone")])


def add_arguments(parser):
    parser.epilog = KEYS.help()


def run(arguments):
    own = [word for word in arguments.others if ":=" in word]
    others = [word for word in arguments.others if ":=" not in word]
    values, _, faults = KEYS.read(own)
    root = preparing.source_only("check")
    if "lint" in values:
        if others or len(values) > 1:
            faults.append("lint:= stands alone; give no other argument")
        folder = "src" if values["lint"] == "true" else values["lint"].rstrip("/")
        if folder.split("/")[0] != "src" or not (root / folder).is_dir():
            faults.append(f"lint:={values['lint']}: must be true or a folder below src")
    if faults:
        raise keys.Refused(*faults)
    from monarch_flight.trials import tests
    return tests.lint(root, folder) if "lint" in values else tests.tested(root, values.get("sanitizers"), others)
