"""The solver's end of the lockstep protocol (docs/protocol.md) in Python: a node of one's own in
place of the fluid, flight or wing node, or one that leads the wingbeat.

  from monarch_flight.solver_node import SolverNode
  sys.exit(SolverNode("fluid", MyFluid()).serve())

A solver is an object with
  start(case, request)         the resolved case (a dict) and the START request; returns a reply
  iterate(request)             returns a reply: a function of the committed state and the request
  commit(request)              keeps what was answered to the last iterate; returns a reply
A reply is a ParticipantReply whose key, protocol, wall_s and seal are filled in here. An exception
becomes the reply's error, and the coordinator tells the person.

Guidance is asked once a step, with the committed level n in the request and the time of n+1 in
request.t. It is an object with
  start(case, request)         may return the PrescribedLevel of level 0; None: the case's own
and one of
  command(request)             returns a WingbeatCommand, a dict of its fields, or None: as before
  prescribe(request)           returns the PrescribedLevel of level n+1

A fluid knows right wings alone. Started as node `fluid_left` (wings:=independent) it is told the left
wing as its mirror image, as if that were a right wing; insect/wing of the case is then that wing.

Both may have save() -> bytes and restore(bytes): what one step leaves to the next, for checkpoints.
Guidance may have commit(request), and `lost`, true once it has given up.
"""
import hashlib
import hmac
import os
import threading
import time

import rospy
import yaml
from monarch_flight.mirror import FluidOfWing
from monarch_flight.msg import (CouplingKey, Hello, ParticipantReply, ParticipantRequest,
                                WingbeatCommand)
from monarch_flight.solver_start import FAILED, Coordinator, NoFlight, begin, end_quietly, one_line
from monarch_flight.solver_token import SEAL, seal_of, serialized, token_of_run
from std_msgs.msg import String


def order(key):
    """Requests of a run come in this order."""
    return key.reset, key.step, key.phase, key.iteration


class GuidanceSolver:
    """Guidance as a solver. A checkpoint of the committed level may come when the next one is
    prescribed already, so the memory of the committed level is kept."""

    def __init__(self, guidance):
        self.guidance = guidance
        self.memory = bytes()

    def start(self, case, request):
        level = self.guidance.start(case, request)
        return self.committed(request, prescribed=[] if level is None else [level])

    def iterate(self, request):
        reply = ParticipantReply(interface=request.interface)
        if hasattr(self.guidance, "prescribe"):
            reply.prescribed = [self.guidance.prescribe(request)]
        else:
            command = self.guidance.command(request)
            if isinstance(command, dict):
                command = WingbeatCommand(**command)
            reply.command = [] if command is None else [command]
        reply.lost = bool(getattr(self.guidance, "lost", False))
        return reply

    def commit(self, request):
        getattr(self.guidance, "commit", lambda request: None)(request)
        return self.committed(request)

    def committed(self, request, **answer):
        self.memory = getattr(self.guidance, "save", bytes)()
        return ParticipantReply(interface=request.interface, **answer)

    def save(self):
        return self.memory

    def restore(self, memory):
        getattr(self.guidance, "restore", lambda memory: None)(memory)
        self.memory = memory


class SolverNode:
    """Serves one run, then ends. `role`: fluid, flight, wing or guidance."""

    def __init__(self, role, solver):
        self.role = role
        self.solver = GuidanceSolver(solver) if role == "guidance" else solver
        self.lock = threading.Lock()  # each connection has a thread of its own
        self.greeting = self.cache = self.kept = self.case = None
        self.case_known, self.over = threading.Event(), threading.Event()
        self.refused = 0
        with one_line(role, KeyboardInterrupt):
            begin(role)
        if role == "fluid":  # which wing's, the node's name says
            left = rospy.get_name().endswith("/fluid_left")
            self.role = "fluid_left" if left else role
            self.solver = FluidOfWing(solver, left)
        self.place = rospy.resolve_name(self.role) + "/"
        self.checkpoints, self.token = None, b""
        with one_line(self.role, KeyboardInterrupt):
            self.token = token_of_run()
        self.replies = rospy.Publisher(self.place + "reply", ParticipantReply, queue_size=8,
                                       tcp_nodelay=True)
        self.hello = rospy.Publisher(self.place + "hello", Hello, latch=True, queue_size=8)
        rospy.Subscriber("case", String, self.on_case)
        self.listen("coordinator_hello", Hello, self.on_hello)
        self.listen("request", ParticipantRequest, self.on_request)

    def listen(self, name, kind, callback):
        """What carries the seal of the run's token is parsed and handed on."""
        topic = self.place + name

        def check(raw):
            data = raw._buff
            with self.lock:
                if not hmac.compare_digest(seal_of(self.token, topic, data), data[-SEAL:]):
                    self.refused += 1
                    return
                message = kind()
                message.deserialize(data)
                callback(message)

        rospy.Subscriber(topic, rospy.AnyMsg, check, tcp_nodelay=True)

    def send(self, publisher, name, message):
        message.seal = bytes(SEAL)
        message.seal = seal_of(self.token, self.place + name, serialized(message))
        publisher.publish(message)

    def on_case(self, message):
        self.case = message.data
        self.case_known.set()

    def on_hello(self, greeting):
        if self.cache is not None:
            return  # a sign of life in a paused run
        self.greeting = greeting
        # This node can serve any case, so it repeats the hash; at START it checks the text by it.
        self.send(self.hello, "hello", Hello(
            protocol=ParticipantRequest.PROTOCOL, run=greeting.run, role=self.role,
            node=rospy.get_name(), case_name=greeting.case_name,
            case_sha256=greeting.case_sha256))

    def on_request(self, request):
        key = request.key
        if (request.protocol != ParticipantRequest.PROTOCOL or self.greeting is None
                or key.run != self.greeting.run):
            self.refused += 1
        elif key.phase == CouplingKey.ABORT:
            self.answer(request, ParticipantReply())
            self.over.set()
        elif key.phase == CouplingKey.CHECKPOINT:  # may come within the next step
            if self.kept is None or order(self.kept.key) != order(key):
                reply = self.compute(request)
                if reply.error:  # asked again, it is tried again
                    self.answer(request, reply)
                    return
                self.kept = reply
            self.answer(request, self.kept)
        elif self.cache is None or order(key) > order(self.cache.key):
            begin = time.monotonic()
            reply = self.compute(request)
            reply.wall_s = time.monotonic() - begin
            self.answer(request, reply)
            if not reply.error:
                self.cache = reply
        elif order(key) == order(self.cache.key):
            self.send(self.replies, "reply", self.cache)  # asked again: the same answer
        else:
            self.refused += 1  # late

    def answer(self, request, reply):
        reply.protocol, reply.key = ParticipantRequest.PROTOCOL, request.key
        self.send(self.replies, "reply", reply)

    def compute(self, request):
        try:
            name, reply = self.asked(request)
            if not isinstance(reply, ParticipantReply):
                raise TypeError("%s() of the solver must return a ParticipantReply, this is %s" % (
                    name, type(reply).__name__))
            return reply
        except Exception as e:  # whatever it is, the person hears of it from the coordinator
            return ParticipantReply(interface=request.interface, error="%s, step %d: %s: %s" % (
                self.role, request.key.step, type(e).__name__, e))

    def asked(self, request):
        """(method of the solver, its answer)."""
        if request.key.phase == CouplingKey.START:
            self.checkpoints = request.checkpoints
            return "start", self.solver.start(self.resolved_case(), request)
        if request.key.phase == CouplingKey.ITERATE:
            return "iterate", self.solver.iterate(request)
        if request.key.phase == CouplingKey.COMMIT:
            return "commit", self.solver.commit(request)
        return "keep", self.keep(request)

    def keep(self, request):
        """CHECKPOINT and RESTORE, by `save` and `restore` (bytes) of a solver that has a state. The
        folder is that of the sealed START."""
        key, restoring = request.key, request.key.phase == CouplingKey.RESTORE
        folder = "step_%010d%s" % (key.step, "" if restoring else ".active")
        path = os.path.join(self.checkpoints, folder,
                            self.role + ".state")
        if restoring:
            with open(path, "rb") as f:
                getattr(self.solver, "restore", lambda state: None)(f.read())
        else:
            with open(path, "wb") as f:
                f.write(getattr(self.solver, "save", bytes)())
                f.flush()
                os.fsync(f.fileno())
        return ParticipantReply(interface=request.interface)

    def resolved_case(self):
        """The coordinator publishes it, latched, before it asks for anything."""
        if not self.case_known.wait(30):
            raise RuntimeError("no case on %s within 30 s" % rospy.resolve_name("case"))
        if hashlib.sha256(self.case.encode()).hexdigest() != self.greeting.case_sha256:
            raise RuntimeError("the text on %s is not the case of the run" % rospy.resolve_name("case"))
        return yaml.load(self.case, getattr(yaml, "CSafeLoader", yaml.SafeLoader))

    def serve(self):
        """Returns an exit code when the run is over: 1 when the coordinator was lost, 130 when
        stopped by hand. Ends the program with 2 when the coordinator has refused the run."""
        try:
            with one_line(self.role):
                return self.wait_for_the_end()
        except KeyboardInterrupt:  # the coordinator, interrupted too, makes its last checkpoint
            self.let_coordinator_leave(10)
            return 130
        finally:  # roslaunch interrupts what is still there; the interpreter is about to leave
            end_quietly()

    def wait_for_the_end(self, limit=60.0):
        coordinator, end = Coordinator(), time.monotonic() + limit
        while not self.over.wait(0.2) and not rospy.is_shutdown():
            if self.replies.get_num_connections() > 0:
                continue
            if self.cache is not None:
                raise NoFlight("the coordinator is lost", FAILED)
            coordinator.refuse()
            if time.monotonic() > end:
                raise NoFlight("no coordinator appeared within %g s: is it running, in the same namespace of this "
                               "master, with the same token?" % limit, FAILED)
        self.let_coordinator_leave(60)
        return 0

    def let_coordinator_leave(self, limit):
        """It closes its files first."""
        begin = time.monotonic()
        while self.replies.get_num_connections() and time.monotonic() - begin < limit:
            time.sleep(0.05)
