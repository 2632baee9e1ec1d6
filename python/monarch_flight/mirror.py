"""The left wing as a right one: what a fluid that knows right wings alone is asked for the left wing (docs/protocol.md)."""
import copy


def overlaid(base, top):
    """Keys of `top` on those of `base`, at every depth."""
    if not (isinstance(base, dict) and isinstance(top, dict)):
        return top
    return {**base, **{key: overlaid(base.get(key), value) for key, value in top.items()}}


def case_of_wing(case, left):
    """The case in which insect/wing has the keys of that wing alone, where it has any."""
    insect = dict(case["insect"])
    own = insect.get("left_wing" if left else "right_wing")
    if own:
        insect["wing"] = overlaid(insect["wing"], own)
    return dict(case, insect=insect)


def mirrored(request):
    """The request in a mirror, the body's plane of symmetry: the left wing is the right one."""
    request = copy.deepcopy(request)
    for holder in (request.interface, request.prescribed):
        mirror_body(holder.body)
    swap(request.interface, "theta_right", "theta_left")
    swap(request.prescribed, "right_wing", "left_wing")
    swap(request, "right_loads", "left_loads")
    for vector in (request.prescribed.wind, request.prescribed.wind_change):
        vector.y = -vector.y
    return request


def mirror_body(body):
    for vector in (body.position, body.velocity, body.acceleration):
        vector.y = -vector.y
    for turn in (body.orientation, body.angular_velocity, body.angular_acceleration):
        turn.x, turn.z = -turn.x, -turn.z


def swap(holder, right, left):
    a, b = getattr(holder, right), getattr(holder, left)
    setattr(holder, right, b)
    setattr(holder, left, a)


class FluidOfWing:
    """A fluid for right wings as that of either wing."""

    def __init__(self, fluid, left):
        self.fluid, self.left = fluid, left

    def __getattr__(self, name):  # save and restore, where the fluid has them
        return getattr(self.fluid, name)

    def start(self, case, request):
        return self.answered(self.fluid.start(case_of_wing(case, self.left), self.seen(request)), request)

    def iterate(self, request):
        return self.answered(self.fluid.iterate(self.seen(request)), request)

    def commit(self, request):
        return self.answered(self.fluid.commit(self.seen(request)), request)

    def seen(self, request):
        return mirrored(request) if self.left else request

    def answered(self, reply, request):
        reply.interface = request.interface
        return reply
