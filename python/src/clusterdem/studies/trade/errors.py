"""Errors against the reference, with the spread between seeds as the yardstick.

Every observable of a run is a row of numbers, x; distances are relative sums of absolute differences,
|a - b| = sum_i |a_i - b_i| / sum_i |r_i|, with r the mean of the reference over seeds. For one number that is the
plain relative difference, for a map twice the share of the solids that lies in another cell.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...frame import Floats
from ...times import same_times
from .observe import Observed

CONFIDENCE = 2.0
"""Standard errors within which the error of a setting is taken to lie."""


@dataclass(frozen=True)
class Error:
    """An observable of a setting against the reference.

    Parameters
    ----------
    value : float
        Distance of the means over seeds.
    uncertainty : float
        Standard error of that distance, by leaving out one seed at a time (jackknife).
    spread : float
        What one seed of the reference differs from their mean: the standard deviation between seeds.
    """

    value: float
    uncertainty: float
    spread: float

    @property
    def inside(self) -> bool:
        """Whether a single run could not show it."""
        return self.value <= self.spread

    def within(self, tolerance: float) -> bool | None:
        """Whether the error is within a tolerance, beyond it, or (None) cannot be told with these seeds.

        The spread of single seeds plays no part: more seeds make the standard error as small as is needed.
        """
        if self.value + CONFIDENCE * self.uncertainty <= tolerance:
            return True
        return False if self.value - CONFIDENCE * self.uncertainty > tolerance else None


def distance(a: Floats, b: Floats, reference: Floats) -> float:
    """Sum of absolute differences over the sum of absolute values of the reference; what neither has is no difference."""
    nothing = np.isnan(a) & np.isnan(b)
    if (np.isnan(a) ^ np.isnan(b)).any():
        return float("inf")
    difference, size = float(np.abs(a - b)[~nothing].sum()), float(np.nansum(np.abs(reference)))
    if difference == 0.0:
        return 0.0
    return difference / size if size > 0 else float("inf")


def spread_between(samples: Floats) -> float:
    """Standard deviation between seeds, samples of shape (seeds, M)."""
    mean = samples.mean(axis=0)
    squares = sum(distance(sample, mean, mean) ** 2 for sample in samples)
    return float(np.sqrt(squares / (len(samples) - 1)))


def error_between(samples: Floats, reference: Floats, spread: float) -> Error:
    """The error of a setting; both arrays of shape (seeds, M), the same seeds in the same order."""

    def of(chosen: np.ndarray) -> float:
        mean = reference[chosen].mean(axis=0)
        return distance(samples[chosen].mean(axis=0), mean, mean)

    seeds = np.arange(len(samples))
    if len(seeds) < 2:
        return Error(of(seeds), float("nan"), spread)
    left_out = np.array([of(seeds[seeds != seed]) for seed in seeds])
    variance = (len(seeds) - 1) / len(seeds) * ((left_out - left_out.mean()) ** 2).sum()
    return Error(of(seeds), float(np.sqrt(variance)), spread)


def comparable(a: Observed, b: Observed, name: str) -> bool:
    """Whether two runs have the same numbers to compare: the same times (:mod:`clusterdem.times`), and as many cells."""
    return same_times(a.times, b.times) and a.values[name].shape == b.values[name].shape


def errors_of(
    setting: Mapping[int, Observed], reference: Mapping[int, Observed], names: tuple[str, ...]
) -> dict[str, Error | None]:
    """Errors by observable; None where the two cannot be compared, or the seeds of the reference with each other.

    Parameters
    ----------
    setting, reference : mapping of int to Observed
        Runs by seed. The spread is that of all seeds of the reference, the error that of the seeds in common.
    names : tuple of str
        The observables.
    """
    errors: dict[str, Error | None] = {}
    common = [seed for seed in reference if seed in setting]
    for name in names:
        errors[name] = None
        first = next(iter(reference.values()))
        if not all(comparable(first, other, name) for other in reference.values()):
            continue
        if common and all(comparable(setting[seed], reference[seed], name) for seed in common):
            every = np.stack([run.values[name].ravel() for run in reference.values()])
            mine = np.stack([setting[seed].values[name].ravel() for seed in common])
            theirs = np.stack([reference[seed].values[name].ravel() for seed in common])
            errors[name] = error_between(mine, theirs, spread_between(every))
    return errors
