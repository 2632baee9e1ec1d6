"""Where the time of a step goes in a flight over topics, step by step, from its bag."""
import collections

import rosbag

StepTimes = collections.namedtuple("StepTimes", "sub_iterations exchange coupling total")


def step_times(folder):
    """StepTimes [s] of every step with sub-iterations, of a run's folder."""
    times = []
    with rosbag.Bag(folder + "/flight.bag") as bag:
        for _, state, _ in bag.read_messages(topics=["/monarch_flight/state"]):
            if state.sub_iterations < 2:  # prescribed
                continue
            fluid, flight, wing, guidance, fluid_left = state.wall_s  # both fluids compute at the same time
            total = max(fluid, fluid_left) + flight + wing + guidance + state.exchange_s + state.coupling_s
            times.append(StepTimes(state.sub_iterations, state.exchange_s, state.coupling_s, total))
    return times
