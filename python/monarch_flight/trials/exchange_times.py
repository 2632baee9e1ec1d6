"""Where the time of a step goes in a flight over topics, step by step, from its bag."""
import collections

import rosbag

from monarch_flight.runs import recorded

StepTimes = collections.namedtuple("StepTimes", "sub_iterations exchange coupling total")


def step_times(folder):
    """StepTimes [s] of every step with sub-iterations, of a run's folder."""
    times = []
    with rosbag.Bag(folder + "/flight.bag") as bag:
        for state in recorded.states(bag):
            if state.sub_iterations < 2:  # prescribed
                continue
            roles = state.computing
            computing = max(roles.fluid, roles.fluid_left) + roles.flight + roles.wing + roles.guidance
            total = computing + state.exchange_s + state.coupling_s
            times.append(StepTimes(state.sub_iterations, state.exchange_s, state.coupling_s, total))
    return times
