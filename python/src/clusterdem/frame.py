"""One frame of a run: the box and the clusters in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import MDAnalysis

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Box:
    """An orthogonal box.

    Parameters
    ----------
    lo, hi : tuple of float
        Lower and upper bounds along x, y, z (m).
    periodic : tuple of bool
        Whether the box repeats along x, y, z.
    """

    lo: tuple[float, float, float]
    hi: tuple[float, float, float]
    periodic: tuple[bool, bool, bool] = (True, True, True)

    @property
    def lengths(self) -> tuple[float, float, float]:
        """Edge lengths along x, y, z (m)."""
        return (self.hi[0] - self.lo[0], self.hi[1] - self.lo[1], self.hi[2] - self.lo[2])

    def same_as(self, other: Box) -> bool:
        """Whether two boxes agree to 1e-9 of their size, with the same periodicity."""
        close = all(
            math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9 * length)
            for mine, theirs in ((self.lo, other.lo), (self.hi, other.hi))
            for a, b, length in zip(mine, theirs, self.lengths)
        )
        return close and self.periodic == other.periodic


@dataclass(frozen=True)
class Frame:
    """The clusters at one instant.

    Parameters
    ----------
    step : int
        Timestep number.
    time : float
        Physical time (s); NaN if the dump does not tell.
    box : Box
        The box (m).
    columns : mapping of str to ndarray, shape (N,), float64
        Every per-cluster column by its name in SI units; ``x``, ``y``, ``z`` lie in the box,
        ``mass`` (kg) and ``diameter`` (m) are always there.
    path : str
        The file it was read from.
    line : int
        The line where the frame begins; ``first_row`` is the line of its first cluster.
    """

    step: int
    time: float
    box: Box
    columns: Mapping[str, Floats]
    path: str = ""
    line: int = 1
    first_row: int = field(default=1, compare=False)

    def __len__(self) -> int:
        return len(self.columns["mass"])

    def __getitem__(self, name: str) -> Floats:
        return self.columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    @property
    def x(self) -> Floats:
        """Centre's x (m), shape (N,)."""
        return self.columns["x"]

    @property
    def z(self) -> Floats:
        """Centre's z (m), shape (N,)."""
        return self.columns["z"]

    @property
    def mass(self) -> Floats:
        """Mass (kg), shape (N,)."""
        return self.columns["mass"]

    @property
    def diameter(self) -> Floats:
        """Equivalent diameter (m), shape (N,)."""
        return self.columns["diameter"]

    @property
    def label(self) -> str:
        """``t = … s`` where the time is known, ``step …`` where not."""
        return f"step {self.step}" if math.isnan(self.time) else f"t = {self.time:.4g} s"

    def to_universe(self) -> MDAnalysis.Universe:
        """The frame as an MDAnalysis Universe; see :func:`clusterdem.universe.to_universe`."""
        from .io.universe import to_universe

        return to_universe(self)
