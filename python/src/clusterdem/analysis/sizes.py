"""Cluster sizes: means, classes, histograms. Of no clusters every mean is NaN and every share, too."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..errors import ArgumentError
from ..frame import Floats

BINS = 32
"""Bins of a histogram whose borders follow from the data, at least."""


def mean_diameter(diameter: Floats, weights: Floats | None = None) -> float:
    """Mean diameter (m): by number, or by weights such as masses (kg)."""
    return float(np.average(diameter, weights=weights)) if len(diameter) else float("nan")


def sauter_diameter(diameter: Floats) -> float:
    """Sauter's mean diameter, Σd³/Σd² (m).

    Examples
    --------
    >>> f"{sauter_diameter(np.array([1e-4, 2e-4])):.2e}"  # (1 + 8) / (1 + 4)
    '1.80e-04'
    """
    return float((diameter**3).sum() / (diameter**2).sum()) if len(diameter) else float("nan")


def class_names(borders: Sequence[float]) -> tuple[str, ...]:
    """Names of the classes between borders (m), in µm.

    Examples
    --------
    >>> class_names((300e-6, 600e-6))
    ('<300', '300-600', '>600')
    """
    if not borders:
        return ("all",)
    words = [f"{1e6 * border:.6g}" for border in borders]
    return (f"<{words[0]}", *(f"{low}-{high}" for low, high in zip(words, words[1:])), f">{words[-1]}")


def class_shares(diameter: Floats, borders: Sequence[float], weights: Floats | None = None) -> Floats:
    """Percent of clusters in size classes.

    Parameters
    ----------
    diameter : ndarray, shape (N,)
        Diameters (m).
    borders : sequence of float, length B
        Ascending borders (m); a diameter on a border counts in the upper class.
    weights : ndarray, shape (N,), optional
        Weights, such as masses (kg); by number by default.

    Returns
    -------
    ndarray, shape (B + 1,)
        Percent, adding to 100; NaN of no clusters.

    Examples
    --------
    >>> class_shares(np.array([1e-4, 3e-4, 5e-4, 9e-4]), (3e-4, 6e-4)).tolist()
    [25.0, 50.0, 25.0]
    """
    check_borders(borders)
    which = np.searchsorted(borders, diameter, side="right")
    sums = np.bincount(which, weights, len(borders) + 1).astype(np.float64)
    return _percent(sums)


def check_borders(borders: Sequence[float]) -> None:
    """Refuse borders that do not ascend, or are no sizes."""
    if not all(low < high for low, high in zip((0.0, *borders), borders)):
        raise ArgumentError("borders", f"must be sizes above 0, ascending, not {' '.join(f'{b:g}' for b in borders)}")


def _percent(sums: Floats) -> Floats:
    total = sums.sum()
    return 100 * sums / total if total > 0 else np.full(len(sums), np.nan)


def borders_of(smallest: float, largest: float) -> tuple[float, ...]:
    """Borders (m) of four classes over a range of diameters (m), at round numbers; fewer where the range is narrow.

    Examples
    --------
    >>> [f"{border:.2g}" for border in borders_of(1.02e-3, 5.9e-3)]
    ['0.002', '0.003', '0.005']
    """
    if not 0 < smallest <= largest < np.inf:
        return ()
    for digits in (1, 2, 3):
        found = {float(f"{b:.{digits - 1}e}") for b in np.linspace(smallest, largest, 5)[1:-1]}
        if len(found) == 3:
            break
    return tuple(sorted(found))


def edges_of(smallest: float, largest: float) -> Floats:
    """Bin borders (m) that hold a range of diameters (m): from 0 on, at least :data:`BINS` of a round width.

    Examples
    --------
    >>> edges = edges_of(1.02e-3, 5.9e-3)
    >>> len(edges) - 1, f"{edges[1]:.1e}", f"{edges[-1]:.1e}"
    (60, '1.0e-04', '6.0e-03')
    """
    if not 0 < smallest <= largest < np.inf:
        return np.linspace(0.0, 1.0, 2)
    fine = largest / BINS
    power = 10.0 ** np.floor(np.log10(fine))
    width = power * max(step for step in (1, 2, 5) if step * power <= fine * (1 + 1e-9))
    edges: Floats = float(width) * np.arange(int(largest / width * (1 + 1e-9)) + 2.0)
    return edges


def histogram(diameter: Floats, mass: Floats, edges: Floats) -> tuple[Floats, Floats]:
    """Share of clusters and of mass in each bin and, at both ends, below and above them.

    Parameters
    ----------
    diameter, mass : ndarray, shape (N,)
        Diameters (m) and masses (kg).
    edges : ndarray, shape (B + 1,)
        Bin borders (m).

    Returns
    -------
    by_number, by_mass : ndarray, shape (B + 2,)
        Percent, each adding to 100; the first bin holds what is below all borders, the last what is not below any.
    """
    which = np.searchsorted(edges, diameter, side="right")
    number, weight = (np.bincount(which, w, len(edges) + 1).astype(np.float64) for w in (None, mass))
    return _percent(number), _percent(weight)
