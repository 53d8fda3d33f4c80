"""A gas field: velocity and what else is known of the gas, on a rectilinear grid, at one time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats

Axes = tuple[Floats, Floats, Floats]

VECTORS = ("velocity", "fluctuation")
SCALARS = ("density", "viscosity", "period", "eddy_size")
NAMES = (*VECTORS, *SCALARS)
"""The arrays that the engine knows; only velocity must be there."""

UNITS = {
    "velocity": "m/s",
    "fluctuation": "m/s",
    "density": "kg/m^3",
    "viscosity": "m^2/s",
    "period": "s",
    "eddy_size": "m",
}


@dataclass(frozen=True)
class GasField:
    """The gas at one instant, values at the points of a rectilinear grid.

    Parameters
    ----------
    axes : (x, y, z), ndarrays of shape (nx,), (ny,), (nz,)
        Coordinates (m), ascending. An axis with one point means that nothing changes along it.
    arrays : mapping of str to ndarray, shape (nx, ny, nz) or (nx, ny, nz, 3)
        ``velocity`` (m/s) and, where known, ``fluctuation`` (amplitude of each component, m/s), ``density`` (kg/m³),
        ``viscosity`` (kinematic, m²/s), ``period`` and ``eddy_size`` (lifetime and size of eddies, s and m).
    time : float
        Time (s); NaN if unknown.
    path : str
        The file that it was read from, for messages.
    solid : ndarray of bool, shape (nx, ny, nz), or None
        Points within solids, where there is no gas; None if there are none.
    provenance : str
        Where it is from and how it was made, lines ``name: value``.
    """

    axes: Axes
    arrays: Mapping[str, Floats]
    time: float = math.nan
    path: str = "gas"
    solid: NDArray[np.bool_] | None = None
    provenance: str = ""

    def __getitem__(self, name: str) -> Floats:
        return self.arrays[name]

    def __contains__(self, name: object) -> bool:
        return name in self.arrays

    @property
    def shape(self) -> tuple[int, int, int]:
        """``(nx, ny, nz)``."""
        return (self.axes[0].size, self.axes[1].size, self.axes[2].size)

    @property
    def speed(self) -> Floats:
        """|u| (m/s), shape (nx, ny, nz)."""
        squares: Floats = np.sum(self["velocity"] ** 2, axis=-1)
        return np.sqrt(squares)

    def place(self, index: int) -> str:
        """Where the point of a flat index (C order of ``shape``) lies, in words."""
        at = np.unravel_index(index, self.shape)
        return "x = {:.6g}, y = {:.6g}, z = {:.6g} m".format(*(axis[k] for axis, k in zip(self.axes, at)))
