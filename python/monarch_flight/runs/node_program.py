"""Whether roslaunch will find the programs of one's own that a flight names, and can start them."""
import sys

import roslib.packages

from monarch_flight import places

KEYS = ("fluid_node", "guidance_node")


def fault(name):
    """What is wrong with the program, or None."""
    if roslib.packages.find_node(places.PACKAGE, name):
        return None
    files = roslib.packages.find_resource(places.PACKAGE, name)
    if files:
        return "%s is not executable; chmod +x %s" % (files[0], files[0])
    return ("no program of this name in the package; put it into %s and make it executable "
            "(chmod +x), or correct the name" % (places.share() / "examples" if places.source() else
                                                 places.prefix() / "lib" / places.PACKAGE))


def good(words):
    """Whether all that these key:=value words name can be started; says what cannot."""
    named = [(key, name) for key, mark, name in (word.partition(":=") for word in words) if key in KEYS]
    faults = [(key, name, fault(name)) for key, name in named]
    for key, name, why in faults:
        if why:
            print("fly: %s:=%s: %s" % (key, name, why), file=sys.stderr)
    return not any(why for _, _, why in faults)
