"""Grids over one face of the box: depositing clusters on them and the maps that follow.

The volume of a cell runs through the whole depth of the box.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError, InputError
from ..frame import Box, Floats, Frame
from .cells import Cells
from .overlap import overlap_weights

MAX_CELLS = 10_000_000


@dataclass(frozen=True)
class Grid:
    """Equal cells over a face of a box.

    Parameters
    ----------
    box : Box
        The box (m); cells run over its whole depth.
    nx, nz : int
        Cells along the first and the second axis of the plane.
    plane : str
        The axes, first the one across: ``xz``, ``xy``, ``yz`` and so on.

    Raises
    ------
    ArgumentError
        If there are no cells or too many, or the plane is not two of x, y, z.

    Examples
    --------
    >>> grid = Grid(Box((0, 0, 0), (0.3, 0.003, 0.6)), 30, 30)
    >>> grid.shape, [round(side, 3) for side in grid.spacing], f"{grid.cell_volume:.1e} m³"
    ((30, 30), [0.01, 0.02], '6.0e-07 m³')
    >>> Grid(Box((0, 0, 0), (0.3, 0.003, 0.6)), 30, 30, "xx")
    Traceback (most recent call last):
    clusterdem.errors.ArgumentError: plane: must be two of x, y, z, such as xz, not xx
    """

    box: Box
    nx: int
    nz: int
    plane: str = "xz"

    def __post_init__(self) -> None:
        if self.nx < 1 or self.nz < 1:
            raise ArgumentError("shape", f"needs at least one cell along {' and '.join(self.plane)}")
        if self.nx * self.nz > MAX_CELLS:
            raise ArgumentError("shape", f"{self.nx} x {self.nz} cells are more than {MAX_CELLS:,}")
        if len(self.plane) != 2 or len(set(self.plane)) != 2 or not set(self.plane) <= set("xyz"):
            raise ArgumentError("plane", f"must be two of x, y, z, such as xz, not {self.plane}")

    @property
    def axes(self) -> tuple[int, int]:
        """Numbers of the two axes, 0 to 2."""
        return ("xyz".index(self.plane[0]), "xyz".index(self.plane[1]))

    @property
    def shape(self) -> tuple[int, int]:
        """``(nx, nz)``, the shape of every map."""
        return (self.nx, self.nz)

    @property
    def count(self) -> int:
        """Cells."""
        return self.nx * self.nz

    @property
    def corner(self) -> tuple[float, float]:
        """Lower bounds of the box along the two axes (m)."""
        return (self.box.lo[self.axes[0]], self.box.lo[self.axes[1]])

    @property
    def sides(self) -> tuple[float, float]:
        """Lengths of the box along the two axes (m)."""
        return (self.box.lengths[self.axes[0]], self.box.lengths[self.axes[1]])

    @property
    def periodic(self) -> tuple[bool, bool]:
        """Whether the box repeats along the two axes."""
        return (self.box.periodic[self.axes[0]], self.box.periodic[self.axes[1]])

    @property
    def depth(self) -> float:
        """Length of the box across the plane (m)."""
        return self.box.lengths[3 - sum(self.axes)]

    @property
    def spacing(self) -> tuple[float, float]:
        """Cell widths (m)."""
        return (self.sides[0] / self.nx, self.sides[1] / self.nz)

    @property
    def cell_volume(self) -> float:
        """Volume of one cell (m³)."""
        return self.spacing[0] * self.spacing[1] * self.depth

    @property
    def edges(self) -> tuple[Floats, Floats]:
        """Cell borders along the two axes (m), shapes (nx + 1,) and (nz + 1,)."""
        (u, v), (width, height) = self.corner, self.sides
        return (np.linspace(u, u + width, self.nx + 1), np.linspace(v, v + height, self.nz + 1))

    def places(self, frame: Frame) -> tuple[Floats, Floats]:
        """A frame's centres along the two axes (m), shape (N,) each."""
        return (frame[self.plane[0]], frame[self.plane[1]])


def grid_of_cells(box: Box, cell: tuple[float, float], plane: str = "xz") -> Grid:
    """A grid whose cells are as near to ``cell`` (m) as fits the box a whole number of times."""
    whole = Grid(box, 1, 1, plane)
    nx, nz = (max(1, round(side / length)) for side, length in zip(whole.sides, cell))
    return Grid(box, nx, nz, plane)


def cell_of(grid: Cells, *places: Floats) -> NDArray[np.int64]:
    """Flat index of the cell that holds each point, shape (N,); coordinates along the grid's axes, shape (N,) each.

    A point on a cell's lower border belongs to it; beyond the box the outermost cell takes it.
    """
    flat = np.zeros(len(places[0]), np.int64)
    for x, low, width, cells in zip(places, grid.corner, grid.spacing, grid.shape):
        flat = flat * cells + np.clip(np.floor((x - low) / width), 0, cells - 1).astype(np.int64)
    return flat


def check_resolution(frame: Frame, grid: Cells) -> None:
    """Refuse cells narrower than the smallest cluster: their fractions would say nothing."""
    narrowest = min(grid.spacing)
    smallest = float(frame.diameter.min(initial=np.inf))
    if narrowest < smallest < np.inf:
        rule = (
            f"a grid of {' x '.join(str(cells) for cells in grid.shape)} has cells of {narrowest:.3g} m, "
            f"narrower than the smallest cluster ({smallest:.3g} m): use fewer cells"
        )
        raise InputError(frame.path, rule, frame.line)


@dataclass(frozen=True)
class Deposit:
    """Which share of which cluster lies in which cell.

    Parameters
    ----------
    grid : Grid or SpaceGrid
        The grid.
    cell : ndarray of int, shape (M,)
        Flat cell index of each share.
    cluster : ndarray of int, shape (M,), or None
        The cluster that each share belongs to; None if it is ``arange(N)``.
    weight : ndarray, shape (M,), or None
        The share, 0 to 1; None if all are 1. The weights of one cluster sum to 1.
    """

    grid: Cells
    cell: NDArray[np.int64]
    cluster: NDArray[np.int64] | None = None
    weight: Floats | None = None

    def of(self, values: Floats) -> Floats:
        """A per-cluster quantity for each share, shape (M,)."""
        return values if self.cluster is None else values[self.cluster]

    def total(self, values: Floats | None = None) -> Floats:
        """Sum of a per-cluster quantity in each cell.

        Parameters
        ----------
        values : ndarray, shape (N,), optional
            The quantity; 1 per cluster by default.

        Returns
        -------
        ndarray, of the grid's shape
        """
        return self.sum(None if values is None else self.of(values))

    def sum(self, shares: Floats | None) -> Floats:
        """Sum in each cell of a quantity of each share, shape (M,), times its weight; 1 by default."""
        if self.weight is not None:
            shares = self.weight if shares is None else shares * self.weight
        return np.bincount(self.cell, shares, self.grid.count).astype(np.float64, copy=False).reshape(self.grid.shape)


def deposit(grid: Grid, u: Floats, v: Floats, diameter: Floats | None = None, method: str = "nearest") -> Deposit:
    """Assign clusters to cells.

    Parameters
    ----------
    grid : Grid
        The grid.
    u, v : ndarray, shape (N,)
        Centres along the two axes of its plane (m).
    diameter : ndarray, shape (N,), optional
        Diameters (m); needed for ``overlap``.
    method : {"nearest", "overlap"}
        The whole cluster to the cell of its centre, or to each cell the part of the sphere's volume that lies in it.

    Returns
    -------
    Deposit

    Raises
    ------
    ArgumentError
        If the method is another, or there are no diameters for ``overlap``.
    """
    if method == "nearest":
        return Deposit(grid, cell_of(grid, u, v))
    if method != "overlap":
        raise ArgumentError("method", f"must be nearest or overlap, not {method}")
    if diameter is None:
        raise ArgumentError("diameter", "is needed for the method overlap")
    low_u, low_v = grid.corner
    ix, iz, cluster, weight = overlap_weights(
        u - low_u, v - low_v, diameter / 2, grid.spacing, grid.shape, grid.periodic
    )
    return Deposit(grid, ix * grid.nz + iz, cluster, weight)


def deposit_frame(frame: Frame, grid: Cells, method: str = "nearest") -> Deposit:
    """Assign a frame's clusters to the cells of any grid, as :func:`deposit` does.

    Raises
    ------
    ArgumentError
        If the method is ``overlap`` and the grid one in space.
    """
    if isinstance(grid, Grid):
        return deposit(grid, *grid.places(frame), frame.diameter, method)
    if method != "nearest":
        raise ArgumentError("method", f"must be nearest for cells in space, not {method}")
    return Deposit(grid, cell_of(grid, *grid.places(frame)))


Maps = dict[str, Floats]


def solids_fraction(frame: Frame, grid: Cells, method: str = "nearest") -> Floats:
    """Solids volume fraction of each cell, of the grid's shape; see :attr:`clusterdem.Frame.solids` for what it rests on."""
    return deposit_frame(frame, grid, method).total(frame.solids) / grid.cell_volume


WEIGHTS = {
    "velocity_x": "mass",
    "velocity_y": "mass",
    "velocity_z": "mass",
    "temperature": "mass",
    "mean_diameter": "number_density",
}
"""What the means among the maps are weighted by, for averages over time."""


def _ratio(a: Floats, b: Floats) -> Floats:
    return np.divide(a, b, out=np.full_like(a, np.nan), where=b > 0)


def maps_of(frame: Frame, grid: Cells, method: str = "nearest", fractions: bool = True) -> Maps:
    """All maps of a frame.

    Parameters
    ----------
    frame : Frame
        The clusters.
    grid : Grid or SpaceGrid
        The grid.
    method : str
        As in :func:`deposit_frame`.
    fractions : bool
        Whether the solids fraction is among them, which needs to know the primary particles.

    Returns
    -------
    dict of str to ndarray, of the grid's shape
        ``mass`` (kg), ``fraction``, ``number_density`` (1/m³), ``mean_diameter`` (m, by number) and, where velocities
        are known, the mass-weighted ``velocity_x``, ``velocity_z`` (m/s, named after the grid's D axes) and
        ``temperature``, the granular temperature of the motion along these, <(v − <v>)²>/D (m²/s²) about the cell's
        own mean: of n clusters of one mass it is (n − 1)/n of what more of them would show. Means are NaN in empty
        cells, the temperature in cells with one cluster.

    Raises
    ------
    ArgumentError
        If the density of the primary particles is needed and not known, or the method is not one for the grid.

    Examples
    --------
    >>> columns = {"x": [0.005, 0.105], "z": [0.01, 0.01], "mass": [4.19e-7] * 2, "diameter": [9.28e-4] * 2}
    >>> frame = Frame(0, 0.0, Box((0, 0, 0), (0.3, 0.003, 0.6)), {k: np.array(v) for k, v in columns.items()})
    >>> maps = maps_of(frame.with_density(2000), Grid(frame.box, 30, 30))
    >>> maps["fraction"].shape, f"{maps['fraction'].max():.3e}", f"{maps['number_density'].max():.2e} 1/m³"
    ((30, 30), '3.492e-04', '1.67e+06 1/m³')
    """
    shares = deposit_frame(frame, grid, method)
    mass, count = shares.total(frame.mass), shares.total()
    maps: Maps = {"mass": mass}
    if fractions:
        maps["fraction"] = shares.total(frame.solids) / grid.cell_volume
    maps["number_density"] = count / grid.cell_volume
    maps["mean_diameter"] = _ratio(shares.total(frame.diameter), count)
    if all(f"v{axis}" in frame for axis in grid.plane):
        several = np.bincount(shares.cell, minlength=grid.count).reshape(grid.shape) > 1
        temperature = np.zeros(grid.shape)
        own_mass = shares.of(frame.mass)
        for axis in grid.plane:
            velocity = frame[f"v{axis}"]
            mean = _ratio(shares.total(frame.mass * velocity), mass)
            apart = shares.of(velocity) - np.nan_to_num(mean).ravel()[shares.cell]
            temperature += _ratio(shares.sum(own_mass * apart**2), mass) / len(grid.plane)
            maps[f"velocity_{axis}"] = mean
        maps["temperature"] = np.where(several, temperature, np.nan)
    return maps
