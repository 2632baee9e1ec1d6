"""What a least-squares fit knows about its unknowns, and what not."""
import dataclasses

import numpy as np

DETERMINED = 0.1  # standard deviation, in shares of the range, below which a combination counts as determined


@dataclasses.dataclass
class Confidence:
    """All in shares of the unknowns' ranges."""
    independent: float  # residuals that count as independent of each other
    covariance: np.ndarray
    singular_values: np.ndarray  # change of the weighted angles [deg, rms] for a range's length along each combination
    combinations: np.ndarray  # rows: the direction of each of them

    @property
    def deviations(self):
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlation(self):
        return self.covariance / np.outer(self.deviations, self.deviations)

    @property
    def combination_deviations(self):
        """Standard deviation along each combination."""
        return np.sqrt(np.maximum(0.0, np.einsum("ij,jk,ik->i", self.combinations, self.covariance, self.combinations)))

    @property
    def determined(self):
        return self.combination_deviations < DETERMINED


def correlation_time(residuals):
    """Sum of the autocorrelation over all lags [samples], >= 1, up to its first zero: so many neighbours tell the same."""
    r = np.asarray(residuals) - np.mean(residuals)
    power = float(r @ r)
    total = 1.0
    for lag in range(1, len(r)):
        rho = float(r[:-lag] @ r[lag:]) / power if power > 0.0 else 0.0
        if rho <= 0.0:
            break
        total += 2.0 * rho
    return total


def confidence(jacobian, residuals, independent):
    """Of N `residuals` r (flown less measured) with derivatives `jacobian` J by the p unknowns, as if r were noise of
    which n = `independent` are independent, at least p + 1: covariance = |r|^2 / (N (n - p)) (J^T J / N)^-1, for n = N the
    usual one."""
    J, r = np.asarray(jacobian, float), np.asarray(residuals, float)
    N, p = J.shape
    n = max(p + 1.0, float(independent))
    _, values, combinations = np.linalg.svd(J / np.sqrt(N), full_matrices=False)
    told = np.maximum(values, 1e-9 * max(values[0], 1e-300))  # what is not seen at all is very uncertain, not infinitely
    covariance = float(r @ r) / (N * (n - p)) * (combinations.T / told ** 2) @ combinations
    return Confidence(n, covariance, values, combinations)
