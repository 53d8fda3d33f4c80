"""One frame of a run: the box and the clusters in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .primary import ASSUMED, Primary, check_heavier, primary_of_columns

if TYPE_CHECKING:
    import MDAnalysis
    import pandas
    import polars

Floats = NDArray[np.float64]
Words = NDArray[np.str_]

WHOLE = ("id", "type", "n", "mol")
"""Columns of whole numbers."""


@dataclass(frozen=True)
class Box:
    """An orthogonal box.

    Parameters
    ----------
    lo, hi : tuple of float
        Lower and upper bounds along x, y, z (m).
    periodic : tuple of bool
        Whether the box repeats along x, y, z.

    Examples
    --------
    >>> Box((0.0, 0.0, -0.1), (0.3, 0.003, 0.5)).lengths
    (0.3, 0.003, 0.6)
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
    """The clusters at one instant; there may be none.

    Parameters
    ----------
    step : int
        Timestep number.
    time : float
        Physical time (s); NaN if nothing tells.
    box : Box
        The box (m).
    columns : mapping of str to ndarray, shape (N,), float64
        Every numeric column by its name in SI units; ``x`` and ``z`` (m), ``mass`` (kg) and ``diameter`` (m) are always
        there. Along a periodic side positions lie in the box, along another they stay as they are.
    path : str
        The file it was read from.
    line : int
        The line where the frame begins; ``first_row`` is the line of its first cluster.
    texts : mapping of str to ndarray, shape (N,), str
        Columns of words, such as ``element``.
    primary : Primary, optional
        The primary particles, where they are given or the run's log tells them.
    run : mapping of str to float
        Numbers of the whole run at this step (:meth:`clusterdem.Run.numbers_at`), where they have been looked up.

    Examples
    --------
    >>> columns = {"x": [0.1], "z": [0.2], "mass": [1e-6], "diameter": [9.28e-4]}
    >>> frame = Frame(10, 0.5, Box((0, 0, 0), (0.3, 0.003, 0.6)), {k: np.array(v) for k, v in columns.items()})
    >>> len(frame), frame.label, float(frame["x"][0])
    (1, 't = 0.5 s', 0.1)
    >>> f"{frame.with_density(2500.0).solids[0]:.1e} m³"
    '4.0e-10 m³'
    """

    step: int
    time: float
    box: Box
    columns: Mapping[str, Floats]
    path: str = ""
    line: int = 1
    first_row: int = field(default=1, compare=False)
    texts: Mapping[str, Words] = field(default_factory=dict)
    primary: Primary | None = None
    run: Mapping[str, float] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.columns["mass"])

    def __getitem__(self, name: str) -> Floats:
        if name not in self.columns:
            raise KeyError(f"no column {name!r} was read; there are {', '.join(self.columns)}")
        return self.columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    @property
    def x(self) -> Floats:
        """Centre's x (m), shape (N,)."""
        return self["x"]

    @property
    def y(self) -> Floats:
        """Centre's y (m), shape (N,)."""
        return self["y"]

    @property
    def z(self) -> Floats:
        """Centre's z (m), shape (N,)."""
        return self["z"]

    @property
    def mass(self) -> Floats:
        """Mass (kg), shape (N,)."""
        return self["mass"]

    @property
    def diameter(self) -> Floats:
        """Equivalent diameter (m), shape (N,)."""
        return self["diameter"]

    @property
    def label(self) -> str:
        """``t = … s`` where the time is known, ``step …`` where not."""
        return f"step {self.step}" if math.isnan(self.time) else f"t = {self.time:.4g} s"

    @property
    def head(self) -> Frame:
        """The frame without its clusters: step, time, box and where it stands."""
        nothing = {name: np.empty(0) for name in ("mass", "diameter")}
        return replace(self, columns=nothing, texts={})

    def with_density(self, density: float) -> Frame:
        """The same frame with primary particles of a given density (kg/m³)."""
        return replace(self, primary=Primary.of_density(density))

    @property
    def particles(self) -> Primary:
        """The primary particles: those of the run, else those that the columns tell, else the assumed ones."""
        if self.primary is not None:
            return self.primary
        found = primary_of_columns(self.mass, self.diameter, self.columns.get("n"))
        return found or Primary.of_density(ASSUMED, "assumed")

    @property
    def solids(self) -> Floats:
        """Volume of the solids in each cluster (m³), shape (N,).

        Raises
        ------
        ArgumentError
            If a cluster would hold more solids than its own volume: the density of the particles is not known then.
        """
        primary = self.particles
        volume = primary.solids(self.mass, self.columns.get("n"), self.columns.get("type"))
        check_heavier(primary, volume, self.diameter)
        return volume

    def _table(self) -> dict[str, NDArray[Any]]:
        table: dict[str, NDArray[Any]] = {
            "step": np.full(len(self), self.step, np.int64),
            "time": np.full(len(self), self.time),
        }
        for name, values in self.columns.items():
            table[name] = np.rint(values).astype(np.int64) if name in WHOLE else values
        return table | dict(self.texts)

    def to_polars(self) -> polars.DataFrame:
        """A polars table: step, time and every column; whole numbers as integers, the rest in SI units."""
        import polars

        return polars.DataFrame(self._table())

    def to_pandas(self) -> pandas.DataFrame:
        """The same as a pandas table (pandas must be installed)."""
        import pandas

        return pandas.DataFrame(self._table())

    def to_universe(self, shift: bool = True) -> MDAnalysis.Universe:
        """The frame as an MDAnalysis Universe; see :func:`clusterdem.io.universe.to_universe`."""
        from .io.universe import to_universe

        return to_universe(self, shift)
