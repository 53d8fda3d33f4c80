"""The x–z grid: depositing clusters on it and the maps that follow.

Solids volume is mass over the density of the primary particles; a cell's volume is dx · dz · slab thickness.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError, InputError
from ..frame import Box, Floats, Frame
from .overlap import overlap_weights

RHO_P = 2000.0
"""Density of the primary particles (kg/m³), the paper's table 1."""

PAPER_SCALE = 10.0
"""The paper's printed fractions over the true ones: it counts as if the slab were 0.3 mm thick."""

MAX_CELLS = 10_000_000


@dataclass(frozen=True)
class Grid:
    """Equal cells over the x–z face of a box.

    Parameters
    ----------
    box : Box
        The box (m); cells run over its whole thickness in y.
    nx, nz : int
        Cells along x and z.
    """

    box: Box
    nx: int
    nz: int

    def __post_init__(self) -> None:
        if self.nx < 1 or self.nz < 1:
            raise ArgumentError("shape", "needs at least one cell along x and z")
        if self.nx * self.nz > MAX_CELLS:
            raise ArgumentError("shape", f"{self.nx} x {self.nz} cells are more than {MAX_CELLS:,}")

    @property
    def shape(self) -> tuple[int, int]:
        """``(nx, nz)``, the shape of every map."""
        return (self.nx, self.nz)

    @property
    def spacing(self) -> tuple[float, float]:
        """Cell widths dx, dz (m)."""
        return (self.box.lengths[0] / self.nx, self.box.lengths[2] / self.nz)

    @property
    def cell_volume(self) -> float:
        """Volume of one cell (m³)."""
        dx, dz = self.spacing
        return dx * dz * self.box.lengths[1]

    @property
    def x_edges(self) -> Floats:
        """Cell borders along x (m), shape (nx + 1,)."""
        return np.linspace(self.box.lo[0], self.box.hi[0], self.nx + 1)

    @property
    def z_edges(self) -> Floats:
        """Cell borders along z (m), shape (nz + 1,)."""
        return np.linspace(self.box.lo[2], self.box.hi[2], self.nz + 1)


def cell_of(grid: Grid, x: Floats, z: Floats) -> NDArray[np.int64]:
    """Flat index of the cell that holds each point, shape (N,).

    A point on a cell's lower border belongs to it; beyond the box the last cell takes it.
    """
    dx, dz = grid.spacing
    ix = np.clip(((x - grid.box.lo[0]) / dx).astype(np.int64), 0, grid.nx - 1)
    iz = np.clip(((z - grid.box.lo[2]) / dz).astype(np.int64), 0, grid.nz - 1)
    return ix * grid.nz + iz


def check_resolution(frame: Frame, grid: Grid) -> None:
    """Refuse cells narrower than the smallest cluster: their fractions would say nothing."""
    smallest, narrowest = float(frame.diameter.min()), min(grid.spacing)
    if narrowest < smallest:
        rule = (
            f"a grid of {grid.nx} x {grid.nz} has cells of {narrowest:.3g} m, "
            f"narrower than the smallest cluster ({smallest:.3g} m): use fewer cells"
        )
        raise InputError(frame.path, rule, frame.line)


@dataclass(frozen=True)
class Deposit:
    """Which share of which cluster lies in which cell.

    Parameters
    ----------
    grid : Grid
        The grid.
    cell : ndarray of int, shape (M,)
        Flat cell index of each share.
    cluster : ndarray of int, shape (M,), or None
        The cluster that each share belongs to; None if it is ``arange(N)``.
    weight : ndarray, shape (M,), or None
        The share, 0 to 1; None if all are 1. The weights of one cluster sum to 1.
    """

    grid: Grid
    cell: NDArray[np.int64]
    cluster: NDArray[np.int64] | None = None
    weight: Floats | None = None

    def total(self, values: Floats | None = None) -> Floats:
        """Sum of a per-cluster quantity in each cell.

        Parameters
        ----------
        values : ndarray, shape (N,), optional
            The quantity; 1 per cluster by default.

        Returns
        -------
        ndarray, shape (nx, nz)
        """
        shares = values if self.cluster is None or values is None else values[self.cluster]
        if self.weight is not None:
            shares = self.weight if shares is None else shares * self.weight
        cells = self.grid.nx * self.grid.nz
        return np.bincount(self.cell, shares, cells).astype(np.float64, copy=False).reshape(self.grid.shape)


def deposit(grid: Grid, x: Floats, z: Floats, diameter: Floats | None = None, method: str = "nearest") -> Deposit:
    """Assign clusters to cells.

    Parameters
    ----------
    grid : Grid
        The grid.
    x, z : ndarray, shape (N,)
        Centres (m), inside the box.
    diameter : ndarray, shape (N,), optional
        Diameters (m); needed for ``overlap``.
    method : {"nearest", "overlap"}
        The whole cluster to the cell of its centre, or to each cell the part of the sphere's volume that lies in it.

    Returns
    -------
    Deposit
    """
    cell = cell_of(grid, x, z)
    if method == "nearest":
        return Deposit(grid, cell)
    if method != "overlap":
        raise ArgumentError("method", f"must be nearest or overlap, not {method}")
    if diameter is None:
        raise ValueError("overlap needs the diameters")
    box = grid.box
    ix, iz, cluster, weight = overlap_weights(
        x - box.lo[0], z - box.lo[2], diameter / 2, grid.spacing, grid.shape, (box.periodic[0], box.periodic[2])
    )
    return Deposit(grid, ix * grid.nz + iz, cluster, weight)


Maps = dict[str, Floats]


def solids_fraction(mass: Floats, grid: Grid, rho_p: float = RHO_P) -> Floats:
    """True solids volume fraction from the mass in each cell (kg), shape (nx, nz)."""
    return mass / (rho_p * grid.cell_volume)


def _ratio(a: Floats, b: Floats) -> Floats:
    return np.divide(a, b, out=np.full_like(a, np.nan), where=b > 0)


def maps_of(frame: Frame, grid: Grid, method: str = "nearest", rho_p: float = RHO_P) -> Maps:
    """All maps of a frame.

    Parameters
    ----------
    frame : Frame
        The clusters.
    grid : Grid
        The grid.
    method : str
        As in :func:`deposit`.
    rho_p : float
        Density of the primary particles (kg/m³).

    Returns
    -------
    dict of str to ndarray, shape (nx, nz)
        ``mass`` (kg), ``fraction`` (true), ``fraction_paper`` (the paper's scale), ``number_density`` (1/m³),
        ``mean_diameter`` (m, by number) and, where velocities are known, the mass-weighted ``velocity_x``,
        ``velocity_z`` (m/s) and ``temperature``, the granular temperature of the motion in the plane,
        <(v − <v>)²>/2 (m²/s²). Means are NaN in empty cells, the temperature in cells with one cluster.
    """
    shares = deposit(grid, frame.x, frame.z, frame.diameter, method)
    mass, count = shares.total(frame.mass), shares.total()
    fraction = solids_fraction(mass, grid, rho_p)
    maps: Maps = {
        "mass": mass,
        "fraction": fraction,
        "fraction_paper": PAPER_SCALE * fraction,
        "number_density": count / grid.cell_volume,
        "mean_diameter": _ratio(shares.total(frame.diameter), count),
    }
    if "vx" in frame and "vz" in frame:
        several = np.bincount(shares.cell, minlength=grid.nx * grid.nz).reshape(grid.shape) > 1
        temperature = np.zeros(grid.shape)
        for axis in "xz":
            velocity = frame[f"v{axis}"]
            mean = _ratio(shares.total(frame.mass * velocity), mass)
            per_cluster = np.nan_to_num(mean).ravel()[shares.cell]
            own = velocity if shares.cluster is None else velocity[shares.cluster]
            shared_mass = frame.mass if shares.cluster is None else frame.mass[shares.cluster]
            if shares.weight is not None:
                shared_mass = shared_mass * shares.weight
            square: Floats = np.bincount(shares.cell, shared_mass * (own - per_cluster) ** 2, grid.nx * grid.nz).astype(
                np.float64, copy=False
            )
            temperature += _ratio(square.reshape(grid.shape), mass) / 2
            maps[f"velocity_{axis}"] = mean
        maps["temperature"] = np.where(several, temperature, np.nan)
    return maps
