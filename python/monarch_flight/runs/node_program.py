"""Whether roslaunch will find the programs of one's own that a flight names, and can start them."""
import sys

import roslib.packages
import rospkg

from monarch_flight import places
from monarch_flight.runs import node_keys


def no_package(package):
    """Why it cannot be used, or None."""
    try:
        rospkg.RosPack().get_path(package)
    except rospkg.ResourceNotFound:
        return ("there is no such package; correct the name, or build it and source the setup.bash of its "
                "workspace before")
    return None


def fault(package, name):
    """What is wrong with the program, or None."""
    if roslib.packages.find_node(package, name):
        return None
    files = roslib.packages.find_resource(package, name)
    if files:
        return "%s is not executable; chmod +x %s" % (files[0], files[0])
    if package != places.PACKAGE:
        return "no program of this name in package %s; build it, or correct the name" % package
    return ("no program of this name in the package; put it into %s and make it executable "
            "(chmod +x), or correct the name" % (places.share() / "examples" if places.source() else
                                                 places.prefix() / "lib" / places.PACKAGE))


def faults(values):
    """Of the keys that name programs and their packages."""
    for role in node_keys.ROLES:
        package, name = f"{role}_pkg", f"{role}_node"
        if package not in values and name not in values:
            continue
        why = no_package(values[package]) if package in values else None
        if why:
            yield package, values[package], why
            continue
        program = values.get(name, role)
        why = fault(values.get(package, places.PACKAGE), program)
        if why:
            yield name, program, why


def good(words):
    """Whether all that these key:=value words name can be started; says what cannot."""
    given = {key: name for key, _, name in (word.partition(":=") for word in words)}
    found = list(faults(given))
    for key, name, why in found:
        print("fly: %s:=%s: %s" % (key, name, why), file=sys.stderr)
    return not found
