"""Cost at equal error of two codes that each ran a case on several grids (docs/performance.md, error against cost)."""
import numpy as np

ORDERS = (0.5, 3.0)   # an order counts as observed within these
ASSUMED = (1.0, 2.0)  # orders to try where none is observed


def order_of(spacings, values):
    """Order of convergence that three runs show, or None where they do not converge. Values may be histories: then it is
    the share of the second change in the first one that counts."""
    first, second = (np.ravel(np.subtract(values[i], values[i + 1])) for i in (0, 1))
    square = second @ second
    if square == 0:
        return None
    ratio = first @ second / square
    h = np.asarray(spacings, dtype=float)

    def shown(p):
        return (h[0] ** p - h[1] ** p) / (h[1] ** p - h[2] ** p)

    low, high = 0.05, 8.0
    if not shown(low) < ratio < shown(high):
        return None
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if shown(middle) > ratio else (middle, high)
    return low


def observed(order):
    return order is not None and ORDERS[0] <= order <= ORDERS[1]


def limit(spacings, values, assumed=None):
    """(limit for spacing 0, order that the runs show or None) by Richardson from the three finest runs; runs stand from
    coarse to fine. Where no order is observed, with the order `assumed`; by default 1 for runs that do not converge, and the
    nearer end of ORDERS for those that show an order beyond them."""
    h, f = np.asarray(spacings[-3:], dtype=float), [np.asarray(value, dtype=float) for value in values[-3:]]
    order = order_of(h, f)
    if observed(order) or assumed is None:
        p = 1.0 if order is None else float(np.clip(order, *ORDERS))
    else:
        p = assumed
    share = h[2] ** p / (h[1] ** p - h[2] ** p)
    return f[2] + share * (f[2] - f[1]), order


def size(value):
    """Root of the mean square of a history, magnitude of a number."""
    return float(np.sqrt(np.mean(np.square(value))))


def errors(values, reference, scale=None):
    """Of each run: how far it is from the reference, by a scale, else by the reference's size."""
    return [size(np.subtract(value, reference)) / (scale or size(reference)) for value in values]


def lasting(errors_of_runs):
    """The largest error of each run and all finer ones: so a run that is right by chance, because its error changes the
    sign there, gains nothing."""
    return [max(errors_of_runs[i:]) for i in range(len(errors_of_runs))]


def cost_at(error, costs, errors_of_runs):
    """Cost of a given error between runs (coarse to fine), straight lines in logarithms; None beyond them."""
    kept = lasting(errors_of_runs)
    if not kept[-1] <= error <= kept[0]:
        return None
    for i in range(len(kept) - 1):
        if kept[i] >= error >= kept[i + 1]:
            if kept[i] == kept[i + 1]:
                return costs[i]
            part = np.log(kept[i] / error) / np.log(kept[i] / kept[i + 1])
            return float(np.exp(np.log(costs[i]) + part * np.log(costs[i + 1] / costs[i])))
    return costs[-1]


def ratios(theirs, ours):
    """[(error, their cost by ours, bound)] at the error of each of their runs that lasts: `theirs` and `ours` are (costs,
    errors). Bound: '>=' where even our coarsest run has less error (it may cost less than that), '<=' where our finest one
    has more, '' between."""
    found = []
    for cost, error in zip(theirs[0], lasting(theirs[1])):
        equal, kept = cost_at(error, *ours), lasting(ours[1])
        if equal is not None:
            found.append((error, cost / equal, ""))
        elif error > kept[0]:
            found.append((error, cost / ours[0][0], ">="))
        else:
            found.append((error, cost / ours[0][-1], "<="))
    return found
