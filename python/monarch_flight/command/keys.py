"""Tells the keys of a run as config/keys.yaml has them. In the source tree, write:=true renews what is made from
that table, and check:=true tells whether it is up to date (exit code 0)."""
from monarch_flight import key_texts, keys, preparing

OWN = keys.Table([keys.Key("write", "truth", "renew the blocks in launch/flight.launch and docs/parameters.md"),
                  keys.Key("check", "truth", "tell which of them are stale")])


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="key:=value")
    parser.epilog = OWN.help()


def stale(root):
    """(path, what it should hold) of every file that is not up to date."""
    for name in key_texts.files():
        path = root / name
        text = path.read_text(encoding="utf-8")
        wanted = key_texts.renewed(text, name, keys.run_keys())
        if wanted != text:
            yield path, wanted


def run(arguments):
    values, _, faults = OWN.read(arguments.words)
    if faults:
        raise keys.Refused(*faults)
    if not values:
        print(keys.run_keys().help())
        return 0
    found = list(stale(preparing.source_only("keys")))
    write = values.get("write") == "true"
    for path, wanted in found:
        if write:
            path.write_text(wanted, encoding="utf-8")
        print(f"keys: {path}: " + ("renewed" if write else "stale; monarch keys write:=true renews it"))
    return 1 if found and not write else 0
