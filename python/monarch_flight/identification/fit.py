"""The search: least squares over flights, stage by stage."""
import dataclasses

import numpy as np
from scipy.optimize import least_squares

from monarch_flight.identification.confidence import correlation_time
from monarch_flight.identification.flights import Failed

TOLERANCE = 1e-4  # relative change of the sum of squares, and of the unknowns in shares of their ranges, at the end


class NoWay(Exception):
    """The search cannot go on; says why, and what to do."""


@dataclasses.dataclass
class Comparison:
    """Flown and measured angle over the compared flaps [deg]."""
    angle: str
    weight: float
    t: np.ndarray
    phase: np.ndarray  # flaps from the start of the motion
    flown: np.ndarray
    measured: np.ndarray
    repeats: float  # rms change of the flown angle from the flap before the last one to the last one; NaN of one flap

    @property
    def residuals(self):
        return self.flown - self.measured

    @property
    def rms(self):
        return float(np.sqrt(np.mean(self.residuals ** 2)))

    def fundamental(self):
        """Ratio of the fundamentals' amplitudes, how far the flown one is ahead [deg]."""
        a, b = (np.mean(angle * np.exp(-2j * np.pi * self.phase)) for angle in (self.flown, self.measured))
        return float(abs(a / b)), float(np.degrees(np.angle(a / b)))


@dataclasses.dataclass
class Comparisons:
    """Of every angle."""
    angles: list

    @property
    def residuals(self):
        """Of all angles, each times its weight [deg]."""
        return np.concatenate([one.weight * one.residuals for one in self.angles])

    @property
    def rms(self):
        return float(np.sqrt(np.mean(self.residuals ** 2)))

    @property
    def independent(self):
        """Residuals that count as independent of each other, of each angle by itself."""
        return sum(len(one.t) / correlation_time(one.residuals) for one in self.angles)


@dataclasses.dataclass
class Found:
    """Where a stage ended."""
    stage: object
    shares: np.ndarray
    values: list
    comparisons: Comparisons
    jacobian: np.ndarray  # of the residuals [deg] by the shares
    active: np.ndarray  # -1, 1: the unknown stands at the low or high end of its range
    ended: bool  # False: stopped behind the most points


class Search:
    """Flights of one stage as a function of the unknowns' shares of their ranges."""

    def __init__(self, study, stage, flights, tell):
        self.study, self.stage, self.flights, self.tell = study, stage, flights, tell
        self.points = 0

    def values(self, shares):
        return [unknown.value(float(share)) for unknown, share in zip(self.study.unknowns, shares)]

    def compared(self, case, flight):
        t, angles = flight
        steps, frequency = int(case["time"]["steps_per_flap"]), float(case["motion"]["frequency"])
        rows = np.concatenate([np.arange((flap - 1) * steps + 1, flap * steps + 1) for flap in self.study.flaps])
        rows = rows[rows < len(t)]

        def of(measured):
            angle = angles[measured.angle]
            last = angle[-steps:] - angle[-2 * steps:-steps] if len(angle) > 2 * steps else np.array([np.nan])
            return Comparison(measured.angle, measured.weight, t[rows], rows / steps, angle[rows], measured.at(t[rows], frequency),
                              float(np.sqrt(np.mean(last ** 2))))
        return Comparisons([of(measured) for measured in self.study.measured])

    def flown(self, points):
        """For each point its Comparisons or the Failed."""
        cases = [self.study.flown(self.stage, self.values(shares)) for shares in points]
        return [flight if isinstance(flight, Failed) else self.compared(case, flight)
                for case, flight in zip(cases, self.flights.all(cases))]

    def residuals(self, shares):
        """Of one point; infinite where the flight fails, which makes the search take a shorter step."""
        [result] = self.flown([shares])
        self.points += 1
        words = ", ".join(f"{unknown.short} {value:.5g}" for unknown, value in zip(self.study.unknowns, self.values(shares)))
        if isinstance(result, Failed):
            self.tell(f"  point {self.points}: {words}: the flight failed ({result}); a shorter step is taken")
            return np.full_like(self.start.residuals, np.inf)
        each = ", ".join(f"{one.angle} {one.rms:.3f}" for one in result.angles)
        self.tell(f"  point {self.points}: {words}: rms {result.rms:.3f} deg" + (f" ({each})" if len(result.angles) > 1 else ""))
        return result.residuals / np.sqrt(len(result.residuals))

    def beside(self, shares):
        """Signs of the differences, into the range, and a point and its neighbours."""
        signs = np.where(np.asarray(shares) + self.study.difference < 1.0, 1.0, -1.0)
        return signs, [shares, *(shares + sign * self.study.difference * row for sign, row in zip(signs, np.eye(len(shares))))]

    def jacobian(self, shares):
        """By differences, side by side; where such a flight fails, to the other side."""
        step, n = self.study.difference, len(shares)
        signs, points = self.beside(shares)
        results = self.flown(points)
        base, columns = results[0], results[1:]
        for i in [i for i, column in enumerate(columns) if isinstance(column, Failed)]:
            signs[i] = -signs[i]
            [columns[i]] = self.flown([shares + signs[i] * step * np.eye(n)[i]])
            if isinstance(columns[i], Failed):
                raise NoWay(f"beside {self.study.unknowns[i].key} = {self.values(shares)[i]:.6g} the flights fail on both sides "
                            f"({columns[i]}); narrow its range, or take more steps a flap")
        return np.column_stack([(column.residuals - base.residuals) / (sign * step) for column, sign in zip(columns, signs)]) \
            / np.sqrt(len(base.residuals))

    def begin(self, shares):
        """The first point, side by side with those of its differences; it must fly and be covered by what was measured."""
        self.start = self.flown(self.beside(shares)[1])[0]
        if isinstance(self.start, Failed):
            raise NoWay(f"the flight of the start values failed: {self.start}; change unknown/*/start, or take more steps a flap")
        for one, measured in zip(self.start.angles, self.study.measured):
            if not np.isfinite(one.measured).all():
                raise NoWay(f"{measured.source} does not cover {one.t[0]:.6g} to {one.t[-1]:.6g} s, the flaps compared; "
                            "compare others, or give repeats: true where it is one flap")

    def run(self, shares, most):
        """From `shares` to the least sum of squares."""
        shares = np.clip(shares, 1e-6, 1 - 1e-6)
        self.begin(shares)
        fit = least_squares(self.residuals, shares, self.jacobian, bounds=(0.0, 1.0), method="trf", max_nfev=most,
                            ftol=TOLERANCE, xtol=TOLERANCE, gtol=None)
        [best] = self.flown([fit.x])
        return Found(self.stage, fit.x, self.values(fit.x), best, fit.jac * np.sqrt(len(best.residuals)), at_ends(fit), fit.status > 0)


def at_ends(fit):
    """Unknowns that the search has run against the end of their range."""
    return np.where(fit.x < 1e-3, -1, np.where(fit.x > 1 - 1e-3, 1, 0))


def search(study, flights, most, tell):
    """Found, of every stage."""
    shares = np.array([unknown.share(unknown.start) for unknown in study.unknowns])
    found = []
    for n, stage in enumerate(study.stages, 1):
        tell(f"{stage.name} ({n} of {len(study.stages)})")
        found.append(Search(study, stage, flights, tell).run(shares, most))
        shares = found[-1].shares
    return found
