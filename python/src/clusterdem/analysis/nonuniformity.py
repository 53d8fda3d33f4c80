"""How unevenly the solids lie: cell statistics against chance, and profiles across the width."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..frame import Floats, Frame
from .grid import Grid, cell_of
from .overlap import mean_square_share


@dataclass(frozen=True)
class Uniformity:
    """Statistics of the cell fractions of one frame; NaN of a frame without clusters, but for the extremes: 0.

    Parameters
    ----------
    largest, smallest, mean, deviation : float
        Of the solids fraction over cells.
    poisson : float
        The deviation that the same clusters would show if each lay anywhere by chance.
    dispersion : float
        Index of dispersion by volume of solids, (deviation / poisson)²: 1 is chance, above it clustering, below it order.
    number_dispersion : float
        Variance over mean of the number of clusters per cell.
    dense_share : float
        Share of the solids in cells above twice the mean fraction.
    """

    largest: float
    smallest: float
    mean: float
    deviation: float
    poisson: float
    dispersion: float
    number_dispersion: float
    dense_share: float


def measure(fraction: Floats, frame: Frame, grid: Grid, method: str = "nearest") -> Uniformity:
    """Cell statistics of a frame.

    Parameters
    ----------
    fraction : ndarray, shape (nx, nz)
        Solids fraction.
    frame : Frame
        The clusters.
    grid : Grid
        The grid.
    method : str
        How they were deposited, as in :func:`clusterdem.deposit`.

    Returns
    -------
    Uniformity

    Notes
    -----
    A cluster of solids volume V thrown at random on M cells gives a cell the variance V² (E[s] − 1/M) / M, where s is
    the sum over cells of the squares of its shares: 1 where all of it goes to one cell, less where it is spread over
    several (:func:`clusterdem.analysis.overlap.mean_square_share`). The sum over clusters is the Poisson expectation;
    merging few large clusters out of many small ones thus counts as size, not as clustering.
    """
    if not len(frame):
        unknown = float("nan")
        return Uniformity(0.0, 0.0, 0.0, 0.0, unknown, unknown, unknown, unknown)
    cells = grid.nx * grid.nz
    squares = np.ones(len(frame))
    if method == "overlap":
        squares = mean_square_share(frame.diameter / 2, grid.spacing, grid.shape, grid.periodic)
    mean, deviation = float(fraction.mean()), float(fraction.std())
    variance = float((frame.solids**2 * (squares - 1 / cells)).sum()) / cells
    chance = np.sqrt(max(variance, 0.0)) / grid.cell_volume
    number = np.bincount(cell_of(grid, *grid.places(frame)), minlength=cells)
    several = cells > 1 and chance > 0
    return Uniformity(
        largest=float(fraction.max()),
        smallest=float(fraction.min()),
        mean=mean,
        deviation=deviation,
        poisson=float(chance),
        dispersion=float((deviation / chance) ** 2) if several else float("nan"),
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
    fraction : ndarray, shape (B,), or None
        Solids fraction, where it was asked for.
    velocity : ndarray, shape (B,), or None
        Mass-weighted mean velocity along the plane's second axis (m/s).
    diameter : ndarray, shape (B,)
        Mean diameter by number (m); NaN where no cluster is.
    count : ndarray, shape (B,)
        Clusters.
    plane : str
        The axis across, and the one of the velocity.
    """

    edges: Floats
    fraction: Floats | None
    velocity: Floats | None
    diameter: Floats
    count: Floats
    plane: str = "xz"


def _sums(where: NDArray[np.int64], values: Floats, bins: int) -> Floats:
    return np.bincount(where, values, bins).astype(np.float64, copy=False)


def _profile(place: Floats, edges: Floats, frame: Frame, plane: str, fractions: bool) -> Profile:
    bins = len(edges) - 1
    where = np.clip(np.searchsorted(edges, place, side="right") - 1, 0, bins - 1)
    count = np.bincount(where, minlength=bins).astype(np.float64)
    mass = _sums(where, frame.mass, bins)

    def mean(total: Floats, weight: Floats) -> Floats:
        out: Floats = np.divide(total, weight, out=np.full(bins, np.nan), where=weight > 0)
        return out

    along = f"v{plane[1]}"
    velocity = mean(_sums(where, frame.mass * frame[along], bins), mass) if along in frame else None
    diameter = mean(_sums(where, frame.diameter, bins), count)
    fraction = _sums(where, frame.solids, bins) / (float(np.prod(frame.box.lengths)) / bins) if fractions else None
    return Profile(edges, fraction, velocity, diameter, count, plane)


def lateral(frame: Frame, bins: int = 30, plane: str = "xz", fractions: bool = True) -> Profile:
    """Profile across the width, the plane's first axis, averaged over the two others."""
    _check_bins(bins)
    axis = "xyz".index(plane[0])
    return _profile(
        frame[plane[0]], np.linspace(frame.box.lo[axis], frame.box.hi[axis], bins + 1), frame, plane, fractions
    )


def strips(frame: Frame, count: int = 6, plane: str = "xz", fractions: bool = True) -> Profile:
    """Profile from the centre (0) to the wall (half the width), both halves together, in equal strips."""
    _check_bins(count)
    axis = "xyz".index(plane[0])
    half = frame.box.lengths[axis] / 2
    distance = np.abs(frame[plane[0]] - (frame.box.lo[axis] + half))
    return _profile(distance, np.linspace(0.0, half, count + 1), frame, plane, fractions)


def _check_bins(bins: int) -> None:
    if bins < 1:
        raise ArgumentError("bins", f"must be 1 or more, not {bins}")
