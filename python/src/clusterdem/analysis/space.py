"""Grids in space: cells along all three axes of the box."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..errors import ArgumentError
from ..frame import Box, Floats, Frame
from .grid import MAX_CELLS


@dataclass(frozen=True)
class SpaceGrid:
    """Equal cells in a box, for :func:`clusterdem.maps_of` with the method ``nearest``.

    Parameters
    ----------
    box : Box
        The box (m).
    shape : (int, int, int)
        Cells along x, y and z.

    Raises
    ------
    ArgumentError
        If there are no cells or too many.

    Examples
    --------
    >>> grid = SpaceGrid(Box((0, 0, 0), (0.3, 0.003, 0.6)), (30, 1, 60))
    >>> grid.count, f"{grid.cell_volume:.1e} m³"
    (1800, '3.0e-07 m³')
    >>> SpaceGrid(Box((0, 0, 0), (0.3, 0.003, 0.6)), (30, 0, 60))
    Traceback (most recent call last):
    clusterdem.errors.ArgumentError: shape: needs at least one cell along x, y and z, not 30 x 0 x 60
    """

    box: Box
    shape: tuple[int, int, int]
    plane: ClassVar[str] = "xyz"

    def __post_init__(self) -> None:
        words = " x ".join(str(cells) for cells in self.shape)
        if min(self.shape) < 1:
            raise ArgumentError("shape", f"needs at least one cell along x, y and z, not {words}")
        if self.count > MAX_CELLS:
            raise ArgumentError("shape", f"{words} cells are more than {MAX_CELLS:,}")

    @property
    def count(self) -> int:
        """Cells."""
        nx, ny, nz = self.shape
        return nx * ny * nz

    @property
    def corner(self) -> tuple[float, float, float]:
        """Lower bounds of the box (m)."""
        return self.box.lo

    @property
    def spacing(self) -> tuple[float, float, float]:
        """Cell widths (m)."""
        (lx, ly, lz), (nx, ny, nz) = self.box.lengths, self.shape
        return (lx / nx, ly / ny, lz / nz)

    @property
    def cell_volume(self) -> float:
        """Volume of one cell (m³)."""
        dx, dy, dz = self.spacing
        return dx * dy * dz

    @property
    def edges(self) -> tuple[Floats, ...]:
        """Cell borders along x, y, z (m)."""
        ends = zip(self.box.lo, self.box.hi, self.shape)
        return tuple(np.linspace(low, high, cells + 1) for low, high, cells in ends)

    def places(self, frame: Frame) -> tuple[Floats, Floats, Floats]:
        """A frame's centres (m), shape (N,) each."""
        return (frame.x, frame.y, frame.z)
