"""ROS masters: is there one, is a flight running on it, who listens, which port is free."""
import http.client
import os
import random
import socket
import xml.parsers.expat
import xmlrpc.client

ROLES = ("coordinator", "fluid", "fluid_left", "flight", "wing", "guidance")


def space():
    """Namespace of a run that is launched from here."""
    return "/".join(["", *filter(None, os.environ.get("ROS_NAMESPACE", "").split("/")), "monarch_flight"])


class Impatient(xmlrpc.client.Transport):
    """HTTP with a time limit: a dead host must not hold up the command."""

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = 3.0
        return connection


def ask(uri, method, *arguments):
    """The value that an XML-RPC server answers with, or None where it does not answer."""
    try:
        with xmlrpc.client.ServerProxy(uri, transport=Impatient()) as proxy:
            code, _, value = getattr(proxy, method)("/fly", *arguments)
        return value if code == 1 else None
    except (OSError, ValueError, http.client.HTTPException, xmlrpc.client.Error, xml.parsers.expat.ExpatError):
        return None


def answers(uri):
    return ask(uri, "getUri") is not None


def nodes_in_use(uri):
    """Those of our nodes that are registered and alive."""
    names = [f"{space()}/{role}" for role in ROLES]
    addresses = {name: ask(uri, "lookupNode", name) for name in names}
    return [name for name, at in addresses.items() if at and ask(at, "getPid") is not None]


def listens(uri, node, topic):
    _, subscribers, _ = ask(uri, "getSystemState") or ([], [], [])
    return any(name == topic and node in nodes for name, nodes in subscribers)


def free_port():
    """Below the ports that the system gives to connections, one of which might take it meanwhile."""
    while True:
        port = random.randint(15000, 31999)
        with socket.socket() as s:
            try:
                s.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port


def busy(uri):
    """Why no flight can begin on a master, or None."""
    running = nodes_in_use(uri)
    return ("a flight is running on %s already (%s): wait for its end, stop it, or unset ROS_MASTER_URI"
            % (uri, ", ".join(running)) if running else None)
