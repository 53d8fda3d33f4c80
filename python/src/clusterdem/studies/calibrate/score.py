"""How far a run is from what was observed: deviations in units of their errors, summed so that no outlier rules."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...frame import Floats
from ...observables import find
from .schema import EQUAL
from .study import Calibration
from .targets import RANGE, Target, deviations

WORST = {True: float(np.log(RANGE)), False: 100.0}
"""Deviation of a number that is not there: its run took too long or failed, or there was nothing to measure."""


@dataclass(frozen=True)
class Yardstick:
    """Targets with the errors and weights that deviations are held against.

    Parameters
    ----------
    targets : tuple of Target
        Of all cases.
    errors : ndarray, shape (M,)
        Standard deviations: of the observation and of one seed's run together.
    weights : ndarray, shape (M,)
        They sum to M; each case has the share of its weight.
    """

    targets: tuple[Target, ...]
    errors: Floats
    weights: Floats

    def residuals(self, numbers: Floats) -> Floats:
        """Deviations in units of the errors; numbers of shape (M,)."""
        apart = deviations(self.targets, np.nan_to_num(numbers, nan=1.0))
        worst = np.array([WORST[find(target.quantity).relative] for target in self.targets])
        return np.where(np.isnan(numbers), worst, apart) / self.errors

    def loss(self, samples: Floats) -> float:
        """Weighted mean of soft_l1 over the targets, at the mean over seeds; samples of shape (seeds, M)."""
        return self.loss_of(self.residuals(samples.mean(axis=0)))

    def loss_of(self, residuals: Floats) -> float:
        """The same from residuals.

        soft_l1 is 2 (sqrt(1 + r^2) - 1), as in scipy.optimize.least_squares: r^2 for small r, 2 |r| for large. A
        number that no point reproduces then pulls at all others by a bounded force.
        """
        return float((self.weights * 2 * (np.sqrt(1 + residuals**2) - 1)).sum() / len(self.weights))

    def loss_part(self, samples: Floats, part: slice) -> float:
        """The loss of some of the targets alone, such as a case's; samples of shape (seeds, M)."""
        chosen = Yardstick(self.targets[part], self.errors[part], self.weights[part])
        scaled: Floats = chosen.weights * len(chosen.weights) / chosen.weights.sum()
        return Yardstick(chosen.targets, chosen.errors, scaled).loss(samples[:, part])

    def pull(self, residuals: Floats) -> Floats:
        """Weights with which least squares has the same gradient as the loss."""
        pulled: Floats = self.weights / np.sqrt(1 + residuals**2)
        return pulled


def all_targets(study: Calibration) -> tuple[Target, ...]:
    """Targets of all cases."""
    return tuple(target for case in study.cases for target in case.targets)


def all_weights(study: Calibration) -> Floats:
    """Weights of all targets, summing to their number; every case has the share of its weight."""
    shares = []
    for case in study.cases:
        own = np.array([target.weight for target in case.targets])
        shares.append(case.weight * own / own.sum())
    weights = np.concatenate(shares)
    scaled: Floats = weights * len(weights) / weights.sum()
    return scaled


def spread_of(targets: Sequence[Target], groups: Sequence[Floats]) -> Floats:
    """Standard deviation of deviations between seeds, pooled over points; each group of shape (seeds, M)."""
    squares, count = np.zeros(len(targets)), 0
    for samples in groups:
        if np.isfinite(samples).all():
            # bounds hold on one side only: their spread is that of the number itself
            free = [replace(t, kind=EQUAL) for t in targets]
            apart = np.stack([deviations(free, sample) for sample in samples])
            squares += ((apart - apart.mean(axis=0)) ** 2).sum(axis=0)
            count += len(samples) - 1
    pooled: Floats = np.sqrt(squares / max(count, 1))
    return pooled


def yardstick(study: Calibration, spread: Floats) -> Yardstick:
    """The yardstick of a study, with the spread between seeds."""
    targets = all_targets(study)
    errors = np.hypot([target.error for target in targets], spread)
    return Yardstick(targets, errors, all_weights(study))
