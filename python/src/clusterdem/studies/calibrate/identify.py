"""What the data tell of the parameters, and what they cannot: from the Jacobian, its scatter and its singular values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...frame import Floats
from .local import PRECISION, Neighbourhood, weighted
from .parameters import Parameter, reals
from .score import Yardstick

PRIOR = PRECISION**-0.5
"""Standard deviation of a place in a range that nothing is known of."""

DETERMINED = 0.5
"""A parameter counts as determined if the data leave less than this share of :data:`PRIOR`."""

TWINS = 0.8
"""Parameters whose errors correlate more than this cannot be told apart."""

FITS = 4.0
"""Mean square residual per degree of freedom above which nothing fits: deviations of twice their errors, on average."""

COMPONENT = 0.3
"""Components of a direction that are named."""


@dataclass(frozen=True)
class Direction:
    """One combination of parameters.

    Parameters
    ----------
    singular : float
        Its singular value: residuals in units of their errors per range of the combination.
    noise : float
        The singular value that the seeds' scatter alone would make of it; taken off already.
    components : ndarray, shape (P,)
        Along the parameters, in units of their ranges; of length 1.
    known : bool
        Whether the data say more of it than its range does.
    """

    singular: float
    noise: float
    components: Floats
    known: bool

    @property
    def hidden(self) -> bool:
        """Whether the seeds' scatter is as large as what would be told: more seeds or a larger domain may tell."""
        return not self.known and self.noise > self.singular


@dataclass(frozen=True)
class Identified:
    """What the data tell.

    Parameters
    ----------
    names : tuple of str
        The numbers among the parameters.
    deviation : ndarray, shape (P,)
        Standard deviation of each place in its range, from the curvature and the misfit that remains.
    alone : ndarray, shape (P,)
        The same if all others were known.
    scatter : ndarray, shape (P,)
        How far the fit moves with the seeds: standard error over them.
    correlation : ndarray, shape (P, P)
        Of the errors.
    directions : tuple of Direction
        From the best known combination to the least.
    misfit : float
        Mean square residual per degree of freedom; above 1 it widens the deviations.
    """

    names: tuple[str, ...]
    deviation: Floats
    alone: Floats
    scatter: Floats
    correlation: Floats
    directions: tuple[Direction, ...]
    misfit: float

    @property
    def determined(self) -> list[bool]:
        """Which parameters the data determine: by curvature and misfit, and whatever the seeds."""
        return [bool(d < DETERMINED * PRIOR) for d in np.hypot(self.deviation, self.scatter)]

    @property
    def twins(self) -> list[tuple[str, str, float]]:
        """Pairs that the data cannot tell apart, with the correlation of their errors."""
        found = []
        for i, first in enumerate(self.names):
            for j in range(i + 1, len(self.names)):
                if abs(self.correlation[i, j]) > TWINS:
                    found.append((first, self.names[j], float(self.correlation[i, j])))
        return found


def identify(near: Neighbourhood, yardstick: Yardstick, parameters: Sequence[Parameter]) -> Identified:
    """Linear analysis about a point: information is that of the data plus that of the ranges."""
    jacobian, residuals = weighted(near, yardstick)
    seeds, count = len(near.residuals), jacobian.shape[1]
    misfit = max(1.0, float(residuals @ residuals) / max(1, len(residuals) - count))
    each = np.array([weighted(near, yardstick, [seed])[0] for seed in range(seeds)]) - jacobian
    noise = np.einsum("smp,smq->pq", each, each) / (seeds * (seeds - 1))  # scatter looks like sensitivity: taken off
    values, vectors = np.linalg.eigh(jacobian.T @ jacobian - noise)
    values = np.maximum(values, 0.0)
    directions = tuple(
        Direction(float(np.sqrt(v)), float(np.sqrt(row @ noise @ row)), row, bool(v > misfit * PRECISION))
        for v, row in zip(values[::-1], vectors.T[::-1])
    )
    information = (vectors * values) @ vectors.T / misfit + PRECISION * np.eye(count)
    covariance = np.linalg.inv(information)
    deviation = np.sqrt(np.diag(covariance))
    moves = np.array(
        [covariance @ jacobian.T @ (weighted(near, yardstick, [seed])[1] - residuals) / misfit for seed in range(seeds)]
    )
    return Identified(
        tuple(real.name for real in reals(parameters)),
        deviation,
        1 / np.sqrt(np.diag(information)),
        moves.std(axis=0, ddof=1) / np.sqrt(seeds),
        covariance / np.outer(deviation, deviation),
        directions,
        misfit,
    )


def in_words(found: Identified) -> list[str]:
    """What the data tell, one sentence each."""
    said = []
    names = np.array(found.names)
    known = [name for name, yes in zip(names, found.determined) if yes]
    unknown = [name for name, yes in zip(names, found.determined) if not yes]
    if found.misfit > FITS:
        said.append(
            f"Nothing fits: at the best point the mean square deviation is {found.misfit:.3g} times what the errors allow. "
            "The values are those that are least far off; no parameter is determined by data that the model does not reproduce."
        )
    elif known:
        said.append(f"The data determine {', '.join(known)}.")
    if unknown:
        said.append(
            f"They do not determine {', '.join(unknown)}: more than half of what its range leaves open stays open."
        )
    for first, second, value in found.twins:
        said.append(f"{first} and {second} cannot be told apart (correlation of their errors {value:+.2f}).")
    told = sum(direction.known for direction in found.directions)
    said.append(f"Of {len(found.directions)} independent combinations of parameters the data tell {told}.")
    for direction in found.directions:
        if not direction.known:
            why = ", hidden by the seeds' scatter: more seeds or a larger domain may tell" if direction.hidden else ""
            said.append(f"Not told: {combination(direction, found.names)}{why}.")
    return said


def combination(direction: Direction, names: Sequence[str]) -> str:
    """A direction's large components as text."""
    order = np.argsort(-np.abs(direction.components))
    parts = [f"{direction.components[i]:+.2f} {names[i]}" for i in order if abs(direction.components[i]) > COMPONENT]
    return " ".join(parts)
