"""What is made from config/keys.yaml: arguments and parameters of launch/flight.launch, and the table of
docs/parameters.md."""
import posixpath
import re
from xml.sax.saxutils import quoteattr

MADE = "made from config/keys.yaml by: monarch keys write:=true"


def launch_arguments(table):
    """The <arg> lines; an argument stands behind those that its default names."""
    wanted = table.of("launch")
    later = {name for name, key in wanted.items() if "arg('" in key.launch or "$(arg " in key.launch}
    names = [name for name in wanted if name not in later] + [name for name in wanted if name in later]
    return "".join(f"  <arg name={quoteattr(name)} default={attribute(wanted[name].launch)}\n"
                   f"       doc={attribute(launch_doc(wanted[name]))}/>\n" for name in names)


def attribute(text):
    """Quoted for XML, with the double quotes of the file's other attributes."""
    return '"' + quoteattr(text, {'"': "&quot;"})[1:-1] + '"'


def launch_doc(key):
    return f"{key.words}; {key.allowed}" if key.allowed else key.words


def launch_parameters(table):
    """The <param> lines, below /monarch_flight."""
    return "".join(parameter(key) for key in table.of("launch").of("server").values())


def parameter(key):
    """One of them, and instead of it another one where the argument is not given."""
    given = f'    <param name="{key.name}" value="$(arg {key.name})" type="str"'
    if not key.unset:
        return given + "/>\n"
    missing = f"\"$(eval arg('{key.name}') in ('', 'auto'))\"/>\n"
    return (f"{given} unless={missing}"
            f'    <param name="{key.name}" value={attribute(key.unset)} type="str"\n           if={missing}')


def launch_model(table):
    """The <param> of robot_description. Its program is told all that stands in for a place of the case, so that a fault of
    that is told once, before a node is started; roslaunch then ends with 1."""
    told = [name for name, key in table.of("launch").of("program").items() if key.override or name in ("case", "resume")]
    words = ['"$(arg insect_model)"', *(f'"{name}:=$(arg {name})"' for name in told)]
    lines = [" ".join(words[at:at + 4]) for at in range(0, len(words), 4)]
    return '  <param name="robot_description"\n         command=\'' + ("\n" + " " * 18).join(lines) + "'/>\n"


def value(key):
    """Unit and range, for the manual."""
    words = {"choice": ", ".join(f"`{choice}`" for choice in key.choices), "truth": "`true`, `false`",
             "program": "name of a program", "package": "name of a package", "machine": "name of a machine",
             "path": "path", "command": "command", "case": "name or path"}
    if key.type in words:
        return words[key.type] + (f", `{key.plugin}`" if key.plugin else "")
    bound = f"> {key.above:g}" if key.type == "number" else (
        f">= {key.from_}" if key.to is None else f"{key.from_} to {key.to}")
    return f"{key.unit}, {bound}" if key.unit else bound


def manual_row(key):
    text = key.doc
    if key.default is not None:
        default = key.default.replace("[", "<").replace("]", ">")
        text += f"; default {default if ' ' in default else f'`{default}`'}"
    if key.see:
        name = posixpath.basename(key.see)  # the table stands in the same folder
        text += f" ([{name}]({name}))"
    only = {(True, False): " (only `monarch fly`)", (False, True): " (only the launch files)"}
    return f"| `{key.name}` | {value(key)} | {text}{only.get(('fly' in key.of, 'launch' in key.of), '')} |\n"


def manual(table):
    """The table of every key that a person may give."""
    rows = "".join(manual_row(key) for key in table.values() if {"fly", "launch"} & set(key.of))
    return "| key | unit, range | meaning |\n|---|---|---|\n" + rows


BLOCKS = (("launch/flight.launch", "arguments", launch_arguments),
          ("launch/flight.launch", "parameters", launch_parameters),
          ("launch/flight.launch", "model", launch_model),
          ("docs/parameters.md", "keys", manual))


def pattern(block):
    """What stands between the two marks of a block."""
    return re.compile(rf"(<!-- {block}, {re.escape(MADE)} -->\n).*?(^ *<!-- end of {block} -->)",
                      re.DOTALL | re.MULTILINE)


def renewed(text, file, table):
    """The text of a file with its blocks as the table has them."""
    for name, block, make in BLOCKS:
        if name == file:
            text, count = pattern(block).subn(lambda found, make=make: found[1] + make(table) + found[2], text)
            if count != 1:
                raise ValueError(f"{file}: the marks of the block '{block}' are missing or stand twice")
    return text


def files():
    return sorted({name for name, _, _ in BLOCKS})
