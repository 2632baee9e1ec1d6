"""monarch <command>: finds the command, reads its arguments, runs it."""
import argparse
import importlib
import os
import signal
import sys

from monarch_flight import keys, places, preparing, telling

COMMANDS = {
    "fly": "flies a case, prints its summary",
    "plan": "tells what a run means before it is flown",
    "summary": "prints the summary of a run",
    "report": "writes a page of a run, or of several beside each other",
    "screenshot": "takes a picture of a recorded flight",
    "film": "makes a film of a recorded flight",
    "figures": "draws the paper's figures from recorded runs",
    "render-field": "renders the flow of a run",
    "sweep": "flies a case over a parameter of the insect",
    "trim": "finds a periodic flight, fits, or designs a controller",
    "identify": "finds parameters of a case from a measured angle",
    "settle": "tells whether a led flight has settled, and stores its periodic flight",
    "inverse-dynamics": "the torques that a flown motion needs, and the nearest spring",
    "neighbours": "what the other wing and the body would change in a flight",
    "study-control": "studies how well a controller holds",
    "compare-coupling": "flies with every strategy of the coupling",
    "reduce-vicon": "reduces a measured flight to angles",
    "verify": "compares the package with something known",
    "bench": "measures speed, also beside peers",
    "hostile": "hostile messages on every topic of a flight",
    "soak": "a long flight under watch",
    "break-it": "breaks flights in every way",
    "check": "installs, builds, runs every test",
    "build": "compiles into build/",
    "install": "installs Debian packages that are missing",
    "clean-machine": "proves the two commands on a bare Debian",
    "api": "makes the pages of the C++ interface",
    "keys": "tells the keys of a run; renews what is made from their table",
}


MODULES = "monarch_flight.command."
SCRIPTS = {"build": "build", "install": "install", "clean-machine": "clean_machine"}  # bash: for a bare machine


class Parser(argparse.ArgumentParser):
    def __init__(self, **options):
        super().__init__(formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message):
        keyed = message.startswith("unrecognized arguments: --") and "key:=value" in (self.epilog or "")
        super().error(message + ("; a key is written key:=value, without --" if keyed else ""))


def overview():
    width = max(map(len, COMMANDS)) + 2
    return ("usage: monarch <command> [arguments]     monarch <command> --help says more\n\ncommands:\n"
            + "".join(f"  {name.ljust(width)}{what}\n" for name, what in COMMANDS.items()))


def module_of(name):
    """The module of a command."""
    return importlib.import_module(MODULES + name.replace("-", "_"))


def parsed(module, name, words):
    """The arguments. Words behind -- are for another program, and all of them where the module passes them on."""
    mark = words.index("--") if "--" in words else len(words)
    own, others = words[:mark], words[mark + 1:]
    parser = Parser(prog=telling.called_as(name), description=module.__doc__)
    module.add_arguments(parser)
    if getattr(module, "PASSES_ON", False):
        arguments = parser.parse_args([word for word in words if word in ("-h", "--help")])
        others = words
    else:
        arguments = parser.parse_intermixed_args(own)
        if others and not getattr(module, "TAKES_OTHERS", False):
            parser.error("nothing may stand behind --")
    arguments.others = others
    return arguments


def refused(name, refusal):
    for fault in refusal.faults:
        print(f"{name}: {fault}", file=sys.stderr)
    if type(refusal) is keys.Refused:  # its words, not what they name
        print(f"{name}: {telling.called_as(name)} --help says what is allowed", file=sys.stderr)
    return 2


def interrupted(*_):
    raise KeyboardInterrupt


def answer(after):
    """To Ctrl-C, SIGTERM and the end of the terminal; what is ignored (nohup) stays so."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, after)


def main(words):
    """Exit code."""
    name = words[0].replace("_", "-") if words else "monarch"
    try:
        answer(interrupted)
        return called(name, words)
    except KeyboardInterrupt:
        flown = " before the first step: nothing was flown" if name == "fly" else ""
        telling.say("stopped by hand" + flown, name)
        return telling.STOPPED
    finally:
        answer(signal.SIG_DFL)  # the interpreter is about to leave


def called(name, words):
    """Exit code of the command that the words name."""
    if not words or words[0] in ("-h", "--help"):
        print(overview(), end="")
        return 0 if words else 2
    if name not in COMMANDS:
        print(f"monarch: no command '{name}'{keys.nearest(name, COMMANDS)}\n\n{overview()}", end="", file=sys.stderr)
        return 2
    if name in SCRIPTS:
        script = preparing.source_only(name) / "scripts" / SCRIPTS[name]
        os.execv(script, [str(script), *words[1:]])
    try:
        module = module_of(name)
        return module.run(parsed(module, name, words[1:])) or 0
    except keys.Refused as refusal:
        return refused(name, refusal)
    except ModuleNotFoundError as missing:
        needs = " ".join(getattr(sys.modules.get(MODULES + name.replace("-", "_")), "SECTIONS", ("fly",)))
        print(f"{name}: {missing}; run {places.share()}/scripts/install {needs}" if places.source()
              else f"{name}: {missing}", file=sys.stderr)
        return telling.FAILED
    except BrokenPipeError:  # whoever read the output has heard enough, as head
        sys.stdout = open(os.devnull, "w", encoding="utf-8")
        return telling.FAILED
    except OSError as error:  # what the system refuses: a name that is too long, a folder that cannot be read
        telling.say(str(error), name)
        return telling.FAILED
