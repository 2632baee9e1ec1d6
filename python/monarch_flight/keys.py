"""Keys of the form key:=value: what is allowed, parsing, help. Those of a run stand in config/keys.yaml."""
import dataclasses
import difflib
import functools
import re
import textwrap

PLUGIN = r"[A-Za-z][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)+"
NUMBER = r"([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?"


class Refused(Exception):
    """Input that is not accepted; every fault at once. The command ends with exit code 2."""

    def __init__(self, *faults):
        super().__init__("\n".join(faults))
        self.faults = list(faults)


@dataclasses.dataclass(frozen=True)
class Key:
    """One key; the fields are explained in config/keys.yaml."""
    name: str
    type: str
    doc: str
    choices: tuple = ()
    plugin: str = ""
    above: float = None
    from_: int = 0
    to: int = None
    unit: str = ""
    default: str = None
    of: tuple = ()
    override: str = ""
    launch: str = "auto"
    unset: str = ""
    see: str = ""

    @property
    def allowed(self):
        """What a value must be, in words; empty where anything goes."""
        if self.type == "choice":
            return either(self.choices) + (f", or a plugin, as {self.plugin}" if self.plugin else "")
        if self.type == "truth":
            return "true or false"
        if self.type == "number":
            return "a number" + ("" if self.above is None else f" > {self.above:g}")
        if self.type == "count":
            bounds = f" >= {self.from_}" if self.to is None else f" from {self.from_} to {self.to}"
            return "a whole number" + (" > 0" if self.to is None and self.from_ == 1 else bounds)
        return f"the name of a {self.type}" if self.type in ("program", "package", "machine") else ""

    @property
    def known(self):
        """The values that have a name."""
        return ("true", "false") if self.type == "truth" else self.choices

    @property
    def words(self):
        """Unit and meaning, plain."""
        return (f"[{self.unit}] " if self.unit else "") + self.doc.replace("`", "")

    def accepts(self, value):
        if self.type == "choice":
            return value in self.choices or bool(self.plugin and re.fullmatch(PLUGIN, value))
        if self.type == "truth":
            return value in ("true", "false")
        if self.type == "number":
            signed = r"\+?" + NUMBER if self.above is not None and self.above >= 0 else "[-+]?" + NUMBER
            return bool(re.fullmatch(signed, value)) and abs(float(value)) < float("inf") and (
                self.above is None or float(value) > self.above)
        if self.type == "count":
            return bool(re.fullmatch("[0-9]{1,18}", value)) and self.from_ <= int(value) and (
                self.to is None or int(value) <= self.to)
        if self.type in ("program", "machine"):
            return bool(re.fullmatch(r"[A-Za-z0-9_.-]+", value))
        if self.type == "package":
            return bool(re.fullmatch(r"[A-Za-z][A-Za-z0-9_-]*", value))
        return bool(value)


def either(names):
    """a, b or c."""
    names = list(names)
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " or " + names[-1]


def nearest(word, names):
    """'; did you mean ...?', or nothing where no name is near."""
    found = difflib.get_close_matches(word, list(names), 1, 0.6)
    return f"; did you mean '{found[0]}'?" if found else ""


class Table(dict):
    """Keys by name."""

    def __init__(self, keys):
        super().__init__((key.name, key) for key in keys)

    def of(self, taker):
        return Table(key for key in self.values() if taker in key.of)

    def read(self, words, plain=False):
        """(values by key, words that are no key:=value, faults). `plain`: whether there may be such words."""
        values, others, faults = {}, [], []
        for word in words:
            name, mark, value = word.partition(":=")
            if plain and not mark:
                others.append(word)
            elif not mark or not re.fullmatch("[a-z_]+", name):
                meant = re.fullmatch("(--)?([a-z_]+)=(.+)", word)
                faults.append(f"'{word}' is not of the form key:=value"
                              + (f"; did you mean {meant[2]}:={meant[3]}?" if meant else ""))
            elif name not in self:
                faults.append(f"unknown key '{name}'" + self.instead(name))
            elif name in values:
                faults.append(f"key '{name}' is given twice; give it once")
            else:
                values[name] = value
                if not value:
                    faults.append(f"key '{name}' has no value; give one or leave the key out")
                elif not self[name].accepts(value):
                    key = self[name]
                    faults.append(f"{name}:={value}: must be {key.allowed}" + nearest(value.lower(), key.known))
        return values, others, faults

    def instead(self, name):
        """What to give for a key that is not in the table."""
        other = run_keys().get(name)
        if other is not None and "launch" in other.of:
            return f"; it is one of the launch files: roslaunch monarch_flight flight.launch {name}:=..."
        return nearest(name, self) or f"; known are {', '.join(self)}"

    def help(self):
        """The keys, a paragraph each."""
        width = max(map(len, self)) + 2
        return "keys (key:=value):\n" + "\n".join(paragraph(key, width) for key in self.values())


def paragraph(key, width):
    parts = [key.words]
    parts += [key.allowed] if key.allowed else []
    if key.type == "case":
        from monarch_flight import case_files
        parts += ["shipped are " + " ".join(case_files.shipped())]
    parts += [f"default {key.default}"] if key.default is not None else []
    return textwrap.fill("; ".join(parts), 118, initial_indent="  " + key.name.ljust(width), break_on_hyphens=False,
                         subsequent_indent=" " * (width + 2), break_long_words=False)


def key_from(name, fields):
    """A key as config/keys.yaml has it."""
    fields = {"from_" if field == "from" else field: value for field, value in fields.items()}
    if "default" in fields:
        default = fields["default"]
        fields["default"] = str(default).lower() if isinstance(default, bool) else str(default)
    for field in ("choices", "of"):
        fields[field] = tuple(fields.get(field, ()))
    return Key(name, **fields)


@functools.lru_cache(None)
def run_keys():
    """All keys of config/keys.yaml."""
    import yaml  # not on every machine that asks for help

    from monarch_flight import places
    with open(places.config() / "keys.yaml", encoding="utf-8") as file:
        return Table(key_from(name, fields) for name, fields in yaml.safe_load(file).items())
