"""How unevenly the solids lie: cell statistics against chance, and profiles across the width."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats, Frame
from .grid import Grid, cell_of


@dataclass(frozen=True)
class Uniformity:
    """Statistics of the cell fractions of one frame.

    Parameters
    ----------
    largest, smallest, mean, deviation : float
        Of the solids fraction over cells.
    poisson : float
        The deviation that the same clusters would show if each lay anywhere by chance.
    dispersion : float
        Index of dispersion by mass, (deviation / poisson)²: 1 is chance, above it clustering, below it order.
    number_dispersion : float
        Variance over mean of the number of clusters per cell.
    dense_share : float
        Share of the mass in cells above twice the mean fraction.
    """

    largest: float
    smallest: float
    mean: float
    deviation: float
    poisson: float
    dispersion: float
    number_dispersion: float
    dense_share: float


def measure(fraction: Floats, mass: Floats, x: Floats, z: Floats, grid: Grid) -> Uniformity:
    """Cell statistics of a frame.

    Parameters
    ----------
    fraction : ndarray, shape (nx, nz)
        Solids fraction.
    mass, x, z : ndarray, shape (N,)
        Masses (kg) and centres (m).
    grid : Grid
        The grid.

    Returns
    -------
    Uniformity

    Notes
    -----
    Clusters thrown at random on M cells give a cell's mass the variance sum(m²) (1 − 1/M) / M, whence the
    Poisson expectation; merging few large clusters out of many small ones thus counts as size, not as clustering.
    """
    cells = grid.nx * grid.nz
    mean, deviation = float(fraction.mean()), float(fraction.std())
    chance = np.sqrt((mass**2).sum() * (1 - 1 / cells) / cells) * mean * cells / mass.sum()
    number = np.bincount(cell_of(grid, x, z), minlength=cells)
    dispersion = (deviation / chance) ** 2 if chance > 0 else np.nan
    return Uniformity(
        largest=float(fraction.max()),
        smallest=float(fraction.min()),
        mean=mean,
        deviation=deviation,
        poisson=float(chance),
        dispersion=float(dispersion),
        number_dispersion=float(number.var() / (number.mean() * (1 - 1 / cells))) if cells > 1 else float("nan"),
        dense_share=float(fraction[fraction > 2 * mean].sum() / fraction.sum()),
    )


@dataclass(frozen=True)
class Profile:
    """A lateral profile.

    Parameters
    ----------
    edges : ndarray, shape (B + 1,)
        Borders of the strips (m).
    fraction : ndarray, shape (B,)
        True solids fraction.
    velocity : ndarray, shape (B,), or None
        Mass-weighted mean of v_z (m/s).
    diameter : ndarray, shape (B,)
        Mean diameter by number (m); NaN where no cluster is.
    count : ndarray, shape (B,)
        Clusters.
    """

    edges: Floats
    fraction: Floats
    velocity: Floats | None
    diameter: Floats
    count: Floats


def _sums(where: NDArray[np.int64], values: Floats, bins: int) -> Floats:
    return np.bincount(where, values, bins).astype(np.float64, copy=False)


def _profile(place: Floats, edges: Floats, volume: float, frame: Frame, rho_p: float) -> Profile:
    bins = len(edges) - 1
    where = np.clip(np.searchsorted(edges, place, side="right") - 1, 0, bins - 1)
    count = np.bincount(where, minlength=bins).astype(np.float64)
    mass = _sums(where, frame.mass, bins)

    def mean(total: Floats, weight: Floats) -> Floats:
        out: Floats = np.divide(total, weight, out=np.full(bins, np.nan), where=weight > 0)
        return out

    velocity = mean(_sums(where, frame.mass * frame["vz"], bins), mass) if "vz" in frame else None
    diameter = mean(_sums(where, frame.diameter, bins), count)
    return Profile(edges, mass / (rho_p * volume), velocity, diameter, count)


def lateral(frame: Frame, bins: int = 30, rho_p: float = 2000.0) -> Profile:
    """Profile across the width x, averaged over y and z."""
    lx, ly, lz = frame.box.lengths
    edges = np.linspace(frame.box.lo[0], frame.box.hi[0], bins + 1)
    return _profile(frame.x, edges, lx * ly * lz / bins, frame, rho_p)


def strips(frame: Frame, count: int = 6, rho_p: float = 2000.0) -> Profile:
    """Profile from the centre (0) to the wall (half the width), both halves together, in equal strips."""
    lx, ly, lz = frame.box.lengths
    distance = np.abs(frame.x - (frame.box.lo[0] + lx / 2))
    return _profile(distance, np.linspace(0.0, lx / 2, count + 1), lx * ly * lz / count, frame, rho_p)
