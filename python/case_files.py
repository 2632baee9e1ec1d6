"""Case files (docs/case_files.md) in Python: read to be changed and written elsewhere."""
import hashlib
import pathlib
import re

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent


class CaseLoader(yaml.SafeLoader):
    """YAML 1.2: 9e-05 is a number, without a point, too."""


CaseLoader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"[-+]?[0-9]+(\.[0-9]*)?[eE][-+]?[0-9]+$"), list("-+0123456789"))


def path_of(case):
    """The file of a case given by name (config/cases) or by path."""
    shipped = ROOT / "config/cases" / f"{case}.yaml"
    return shipped if shipped.is_file() else pathlib.Path(case)


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


def run_name(case, *options):
    """Name of a run's folder that is another one for another text of the case or other options of scripts/fly."""
    path = path_of(case)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
    return "_".join([path.stem] + [option.partition(":=")[2] for option in options] + [digest])
