"""What every grid tells of its cells, whether they lie over a face of the box or in space."""

from __future__ import annotations

from typing import Protocol

from ..frame import Box, Floats, Frame


class Cells(Protocol):
    """Equal cells that fill a box; see :class:`clusterdem.Grid` and :class:`clusterdem.SpaceGrid`."""

    @property
    def box(self) -> Box:
        """The box (m)."""

    @property
    def plane(self) -> str:
        """The axes along which cells stand, such as ``xz`` or ``xyz``."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along these axes, the shape of every map."""

    @property
    def corner(self) -> tuple[float, ...]:
        """Lower bounds of the box along these axes (m)."""

    @property
    def spacing(self) -> tuple[float, ...]:
        """Cell widths (m)."""

    @property
    def count(self) -> int:
        """Cells."""

    @property
    def cell_volume(self) -> float:
        """Volume of one cell (m³)."""

    @property
    def edges(self) -> tuple[Floats, ...]:
        """Cell borders along these axes (m)."""

    def places(self, frame: Frame) -> tuple[Floats, ...]:
        """A frame's centres along these axes (m), shape (N,) each."""
