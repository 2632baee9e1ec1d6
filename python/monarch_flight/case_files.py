"""Case files (docs/case_files.md) in Python: read to be changed and written elsewhere."""
import hashlib
import json
import os
import pathlib
import re

import yaml

from monarch_flight import places


class CaseLoader(yaml.SafeLoader):
    """YAML 1.2: 9e-05 is a number, without a point, too."""


CaseLoader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"[-+]?[0-9]+(\.[0-9]*)?[eE][-+]?[0-9]+$"),
                                 list("-+0123456789"))


def path_of(case):
    """The file of a case given by name (config/cases) or by path."""
    shipped = places.config() / "cases" / f"{case}.yaml"
    return shipped if os.path.isfile(shipped) else pathlib.Path(case)


def shipped():
    """Names of the cases of config/cases."""
    return sorted(path.stem for path in (places.config() / "cases").glob("*.yaml"))


def anchored(node, folder):
    """A case whose relative `file` keys are joined to `folder`, so that it can be written anywhere."""
    if isinstance(node, list):
        return [anchored(one, folder) for one in node]
    if not isinstance(node, dict):
        return node
    return {key: str(folder / value) if key == "file" and isinstance(value, str) else anchored(value, folder)
            for key, value in node.items()}


def read(path):
    """The case in a file, its own files named from anywhere."""
    path = pathlib.Path(path)
    with open(path, encoding="utf-8") as file:
        return anchored(yaml.load(file, CaseLoader), path.resolve().parent)


def comments(path):
    """(what stands above each key of a file, by its path, as text() takes it; the heading, as it stands). Sections are told
    by their indents, as in every case of ours; comments behind values are not kept."""
    above, found, pending, heading, begun = [], {}, [], [], False
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        bare = line.strip()
        key = re.match(r"( *)([A-Za-z0-9_]+):( |$)", line)
        if bare.startswith("#"):
            (pending if begun else heading).append(bare)
        elif key:
            above = [(indent, name) for indent, name in above if indent < len(key[1])] + [(len(key[1]), key[2])]
            if pending:
                found["/".join(name for _, name in above)] = "\n".join(comment.lstrip("#").strip() for comment in pending)
            pending = []
        begun = begun or not bare.startswith("#")
        if not bare:
            pending = []
    return found, "".join(line + "\n" for line in heading)


def run_name(case, *options):
    """Name of a run's folder that is another one for another text of the case or other options of monarch fly."""
    path = path_of(case)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
    return "_".join([path.stem] + [option.partition(":=")[2] for option in options] + [digest])


def scalar(value):
    """A number, truth or text of a case, as YAML that reads back the same."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    plain = re.fullmatch(r"[A-Za-z0-9_./][A-Za-z0-9_./ ,()&'-]*", value) and value.strip() == value
    return value if plain else json.dumps(value, ensure_ascii=False)


def inline(node):
    """A part of a case in one line."""
    if isinstance(node, dict):
        return "{" + ", ".join(f"{key}: {inline(value)}" for key, value in node.items()) + "}"
    if isinstance(node, list):
        return "[" + ", ".join(inline(value) for value in node) + "]"
    return json.dumps(node) if isinstance(node, str) and "," in node else scalar(node)


def text(content, comments=None, above="", indent=""):
    """The file of a case; `comments`: what stands above a key, by its path (insect/wing/mass)."""
    lines = []
    for key, value in content.items():
        path = above + key
        lines += [f"{indent}# {line}" for line in (comments or {}).get(path, "").splitlines()]
        if isinstance(value, dict) and value:
            lines += [f"{indent}{key}:", text(value, comments, path + "/", indent + "  ").rstrip("\n")]
        elif isinstance(value, list) and value and isinstance(value[0], list):
            lines += [f"{indent}{key}:"] + [f"{indent}  - {inline(row)}" for row in value]
        else:
            lines.append(f"{indent}{key}: {inline(value)}")
    return "\n".join(lines) + "\n"
