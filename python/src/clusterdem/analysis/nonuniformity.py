"""How unevenly the solids lie: cell statistics against chance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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
    cells = grid.count
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
