"""Pressure on the wings, from the facets of the solver's grid in flight.bag to the points of the outline."""
import os

import numpy as np

SIDES = ("right_wing", "left_wing")
PER_FLAP, MOST = 40, 2000  # pictures
FIELDS = ("x", "y", "z", "dx", "dy", "p_upper", "p_lower", "jump")


def weights(points, facets):
    """Shares (points, facets) of the facets in the pressure at each point: normal curves as wide as a facet. Beyond the facets
    at the rim, where the outline is finer than the grid, the nearest one holds."""
    x, y, dx, dy = (facets[name].astype(float) for name in ("x", "y", "dx", "dy"))
    far = ((points[:, None, 0] - x) / dx) ** 2 + ((points[:, None, 1] - y) / dy) ** 2
    share = np.exp(-(far - far.min(axis=1, keepdims=True)))
    return share / share.sum(axis=1, keepdims=True)


def clouds(bag, side):
    """(seconds of flight, facets) of each picture of a wing, whatever the namespace of the run."""
    kind = np.dtype([(name, "<f4") for name in FIELDS])
    of_side = lambda topic, *_: topic.endswith(f"/{side}/pressure")  # noqa: E731
    for _, message, _ in bag.read_messages(connection_filter=of_side):
        if [field.name for field in message.fields] == list(FIELDS):
            yield message.header.stamp.to_sec() - 1.0, np.frombuffer(message.data, kind)


def pictures(flown, model):
    """{"t": times [s], side: pressures (pictures, 2, points) [Pa], dorsal then ventral} or None where the run recorded none."""
    path = flown.folder / "flight.bag"
    if not os.path.isfile(path):
        return None
    import rosbag  # takes its time

    found, times = {}, []
    try:
        with rosbag.Bag(str(path)) as bag:
            for side in SIDES[:2 if flown.independent else 1]:
                times, found[side] = of_wing(clouds(bag, side), model.wings[side].reshape(-1, 2))
    except rosbag.bag.ROSBagException:
        return None  # the bag of a run that was lost
    count = min(map(len, found.values()), default=0)
    if not count:
        return None
    flaps = max((times[-1] - times[0]) * flown.scale, 1e-9)
    every = max(1, round(count / min(MOST, PER_FLAP * flaps))) if flown.frequency else max(1, count // 400)
    return dict(t=np.array(times[:count:every]), **{side: np.array(values[:count:every]) for side, values in found.items()})


def of_wing(facets_of_time, points):
    times, values, share = [], [], None
    for t, facets in facets_of_time:
        share = weights(points, facets) if share is None or share.shape[1] != len(facets) else share
        times.append(t)
        values.append([share @ facets["p_upper"], share @ facets["p_lower"]])
    return times, values


def limit(coefficients):
    """End of the colour scale, the same to both sides: what 99 of 100 points stay below, a round number."""
    return rounded_up(max(1e-3, *(float(np.percentile(np.abs(values), 99)) for values in coefficients)))


def rounded_up(value):
    """To 1, 1.5, 2, 3, 5 or 7 times a power of ten, as src/viz/colours.cpp: the end of a colour scale."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * next(step for step in (1, 1.5, 2, 3, 5, 7, 10) if step * power >= value * 0.999))
