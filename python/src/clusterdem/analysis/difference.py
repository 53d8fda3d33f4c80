"""The difference of two groups of runs, with the spread between the runs of each as the yardstick."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtr

from ..errors import ArgumentError
from ..frame import Floats

ROUNDING = 1e-6
"""Share of a number below which a difference is that of the digits that dumps are written with."""


@dataclass(frozen=True)
class Difference:
    """Two groups' numbers, each of shape (M,).

    Parameters
    ----------
    first, second : ndarray
        Means over the runs of each group.
    first_spread, second_spread : ndarray
        Standard deviations between the runs of each (n − 1); NaN of one run.
    error : ndarray
        Standard error of ``second − first``; NaN where neither group has two runs.
    p_value : ndarray
        How likely two groups of one kind differ by so much or more, 0 to 1; NaN where the error is.
    """

    first: Floats
    second: Floats
    first_spread: Floats
    second_spread: Floats
    error: Floats
    p_value: Floats

    @property
    def difference(self) -> Floats:
        """The second less the first, shape (M,)."""
        return self.second - self.first


def difference_between(first: Floats, second: Floats) -> Difference:
    """Compare two groups of runs.

    Parameters
    ----------
    first, second : ndarray, shape (runs, M)
        A row of numbers of each run; the groups may have different numbers of runs.

    Returns
    -------
    Difference

    Raises
    ------
    ArgumentError
        If a group has no run, or the rows have different lengths.

    Notes
    -----
    Welch's test (Biometrika 34 (1947) 28): error² = s_1²/n_1 + s_2²/n_2, with Student's distribution of the degrees of freedom

        error⁴ / ((s_1²/n_1)²/(n_1 − 1) + (s_2²/n_2)²/(n_2 − 1))

    Where a group has a single run, the other's spread stands for both: error² = s² (1/n_1 + 1/n_2), with n − 1 degrees.

    Examples
    --------
    >>> found = difference_between(np.array([[1.0], [3.0]]), np.array([[6.0], [8.0]]))
    >>> float(found.difference[0]), round(float(found.error[0]), 6), round(float(found.p_value[0]), 4)
    (5.0, 1.414214, 0.0715)
    """
    if first.ndim != 2 or second.ndim != 2 or not len(first) or not len(second) or first.shape[1] != second.shape[1]:
        raise ArgumentError("second", f"must be rows as long as the first's, not {second.shape} beside {first.shape}")
    counts = np.array([len(first), len(second)])
    spreads = _spread(first), _spread(second)
    variance = np.square(spreads)
    if (counts > 1).all():
        parts = variance / counts[:, None]
        with np.errstate(invalid="ignore", divide="ignore"):
            freedom = parts.sum(axis=0) ** 2 / (parts**2 / (counts - 1)[:, None]).sum(axis=0)
    else:  # one of them has no spread of its own, or neither
        parts = (
            (variance[int(counts.argmax())] if counts.max() > 1 else np.nan) / counts[:, None] * np.ones(first.shape[1])
        )
        freedom = np.full(first.shape[1], counts.max() - 1.0)
    one, other = first.mean(axis=0), second.mean(axis=0)
    error = np.sqrt(parts.sum(axis=0))
    apart = np.abs(other - one)
    with np.errstate(invalid="ignore", divide="ignore"):
        p_value = 2 * stdtr(freedom, -apart / error)
    exact = error <= ROUNDING * np.abs(one)  # runs that are alike but for the digits of their dumps
    p_value = np.where(exact, np.where(apart > ROUNDING * np.abs(one), 0.0, 1.0), p_value)
    return Difference(one, other, spreads[0], spreads[1], error, p_value)


def _spread(group: Floats) -> Floats:
    """Standard deviation between runs (n − 1), shape (M,); NaN of one run."""
    return np.full(group.shape[1], np.nan) if len(group) < 2 else group.std(axis=0, ddof=1)
