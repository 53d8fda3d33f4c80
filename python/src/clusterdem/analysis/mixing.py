"""How well two kinds of clusters are mixed: Lacey's index over sampling cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError


@dataclass(frozen=True)
class Lacey:
    """Lacey's mixing index of one frame.

    Parameters
    ----------
    share : float
        Share of the clusters that are of the kind, p; NaN without clusters.
    cells : int
        Sampling cells that hold a cluster.
    per_cell : float
        Clusters per such cell, n.
    variance : float
        Of the share between the cells, σ².
    segregated, random : float
        What it is where no cell holds both kinds, σ_0², and where every cluster lies by chance, σ_R².
    index : float
        0 where segregated, 1 where mixed by chance, above 1 where mixed more evenly than that; NaN where there is one
        kind, or one cluster per cell.
    """

    share: float
    cells: int
    per_cell: float
    variance: float
    segregated: float
    random: float
    index: float


def lacey(of_kind: NDArray[np.bool_], cell: NDArray[np.int64]) -> Lacey:
    """Lacey's mixing index by number of clusters.

    Parameters
    ----------
    of_kind : ndarray of bool, shape (N,)
        Whether each cluster is of the one kind, or of the other.
    cell : ndarray of int, shape (N,)
        The sampling cell of each, 0 or more, as :func:`clusterdem.analysis.grid.cell_of` gives it.

    Returns
    -------
    Lacey

    Raises
    ------
    ArgumentError
        If the two have different lengths.

    Notes
    -----
    Lacey, J. Appl. Chem. 4 (1954) 257: M = (σ_0² − σ²) / (σ_0² − σ_R²) with σ_0² = p (1 − p) and σ_R² = p (1 − p) / n for
    samples of n clusters. Cells hold different numbers n_i here, so each counts by its number, σ² = Σ n_i (p_i − p)² / Σ n_i, and
    n is the mean over occupied cells: clusters by chance then have σ² = σ_R² but for a part in n and in the number of cells.

    Examples
    --------
    >>> kinds = np.array([True] * 4 + [False] * 4)
    >>> lacey(kinds, np.repeat([0, 1], 4)).index, lacey(kinds, np.arange(8) % 2).index
    (0.0, 1.3333333333333333)
    """
    if len(of_kind) != len(cell):
        raise ArgumentError("of_kind", f"must say it of each cluster: {len(of_kind)} for {len(cell)}")
    nan = float("nan")
    if not len(cell):
        return Lacey(nan, 0, nan, nan, nan, nan, nan)
    every = np.bincount(cell)
    mine = np.bincount(cell, of_kind, len(every))
    occupied = every > 0
    number, part = every[occupied], mine[occupied] / every[occupied]
    p = float(np.mean(of_kind))
    per_cell = len(cell) / len(number)
    variance = float((number * (part - p) ** 2).sum()) / len(cell)
    segregated = p * (1 - p)
    random = segregated / per_cell
    index = (segregated - variance) / (segregated - random) if segregated > random else nan
    return Lacey(p, len(number), per_cell, variance, segregated, random, index)
