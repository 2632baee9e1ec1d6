"""What was given, fitted and assumed: the comments of the shipped case and its insect, with the values of the run."""
import re

from monarch_flight import case_files, places

STATUS = re.compile(r"status:\s*([^.;(\n]*)")


def commented(text):
    """(path of the key, comment above it) for every key of a case file that has one."""
    above, parents = [], []
    for line in text.splitlines():
        words = line.strip()
        if words.startswith("#"):
            above.append(words.lstrip("# ").strip())
            continue
        key = re.match(r"( *)([A-Za-z_]\w*):", line)
        if key:
            parents = [parent for parent in parents if parent[0] < len(key[1])] + [(len(key[1]), key[2])]
            if above:
                yield "/".join(name for _, name in parents), " ".join(above)
        above = []


def value_at(case, path):
    for name in path.split("/"):
        if not isinstance(case, dict) or name not in case:
            return None
        case = case[name]
    return case


def told(value):
    """A value in a few words."""
    if isinstance(value, (dict, list)):
        text = case_files.inline(value)
        return text if len(text) <= 60 else "a series" if isinstance(value, dict) else f"{len(value)} numbers"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def kind(comment):
    """given, fitted, computed, derived or assumed."""
    word = STATUS.search(comment)
    first = re.match(r"[a-z]+", word[1].strip()) if word else None
    return first[0] if first else ""


def rows(flown):
    """(kind, key, value, comment, file) of everything that says where it is from. Empty for a case that is not shipped."""
    case = places.config() / "cases" / f"{flown.summary['case']}.yaml"
    insect = places.config() / "insects" / f"{flown.case['insect'].get('name', '')}.yaml"
    found = {}
    for path, place in ((insect, "insect/"), (case, "")):
        if path.is_file():
            for key, comment in commented(path.read_text(encoding="utf-8")):
                value = value_at(flown.case, place + key)
                if kind(comment) and value is not None:
                    found[place + key] = (kind(comment), place + key, told(value), comment, path.name)
    order = dict(given=0, fitted=1, computed=2, derived=3, assumed=4)
    return sorted(found.values(), key=lambda row: order.get(row[0], 5))


def changed(flown):
    """(key, value of the run, value of the shipped case) where the run's case differs from the shipped one of its name."""
    path = places.config() / "cases" / f"{flown.summary['case']}.yaml"
    if not path.is_file():
        return None
    shipped = case_files.read(path)
    found = []
    for key, value in leaves(shipped):
        now = value_at(flown.case, key)
        if now is not None and now != value and key not in ("insect/preset", "motion/series"):
            found.append((key, told(now), told(value)))
    return found


def leaves(node, above=""):
    for key, value in node.items():
        if isinstance(value, dict):
            yield from leaves(value, above + key + "/")
        else:
            yield above + key, value
