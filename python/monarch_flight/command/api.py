"""Makes the pages of the C++ interface from the public headers, by doxygen. A wrong comment in a header ends it."""
import os
import subprocess

from monarch_flight import keys, places, preparing, telling
from monarch_flight.keys import Key, Table

SECTIONS = ("api",)
KEYS = Table([Key("out", "path", "folder of the pages; what it holds of an earlier call is written anew",
                  default="build_api")])


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="key:=value")
    parser.epilog = KEYS.help()


def rooms(include):
    """Puts every header into the group of its folder; the groups are those of docs/api/main.dox."""
    headers = sorted(path.relative_to(include) for path in include.glob("*/*/*.h"))
    return "".join(f"/** @file {path}\n@ingroup room_{path.parent.name} */\n" for path in headers)


def run(arguments):
    values, _, faults = KEYS.read(arguments.words)
    root = preparing.source_only("api")
    out = places.person_path(values["out"]) if "out" in values else root / "build_api"
    if out.exists() and (not out.is_dir() or any(out.iterdir()) and not (out / "html" / "doxygen.css").is_file()):
        faults.append(f"out:={out}: holds something else than such pages; name a new folder")
    if faults:
        raise keys.Refused(*faults)
    preparing.installed(*SECTIONS)
    out.mkdir(parents=True, exist_ok=True)
    (out / "rooms.dox").write_text(rooms(root / "include"), encoding="utf-8")
    settings = ((root / "docs/api/Doxyfile").read_text(encoding="utf-8")
                + f'INPUT += "{out}/rooms.dox"\nOUTPUT_DIRECTORY = "{out}"\n')
    try:
        done = subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=root, check=False)
    except FileNotFoundError:
        telling.say("doxygen is not installed; run scripts/install api", "api")
        return telling.FAILED
    if done.returncode:
        telling.say("the comments of the headers have faults (above)", "api")
        return telling.FAILED
    print(f"api: {os.path.join(out, 'html', 'index.html')}")
    return 0
