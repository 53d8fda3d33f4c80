"""Cluster sizes: means, the paper's four classes, a fine histogram."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..frame import Floats

CLASS_EDGES = (300e-6, 600e-6, 900e-6)
"""Borders of the paper's size classes (m); a diameter on a border counts in the upper class."""

CLASS_NAMES = ("<300", "300-600", "600-900", ">900")
"""The paper's size classes (µm)."""


@dataclass(frozen=True)
class Sizes:
    """Size statistics of one frame (m, kg).

    Parameters
    ----------
    count : int
        Clusters.
    mass : float
        Total mass (kg).
    mean : float
        Mean diameter by number (m); ``mass_mean`` by mass, ``sauter`` is sum d³ / sum d².
    smallest, largest : float
        Extreme diameters (m).
    classes : tuple of float
        Share of clusters in the paper's four classes (percent by number).
    mass_classes : tuple of float
        The same by mass.
    """

    count: int
    mass: float
    mean: float
    mass_mean: float
    sauter: float
    smallest: float
    largest: float
    classes: tuple[float, ...]
    mass_classes: tuple[float, ...]


def class_shares(diameter: Floats, weights: Floats | None = None) -> tuple[float, ...]:
    """Percent of clusters in the paper's four classes.

    Parameters
    ----------
    diameter : ndarray, shape (N,)
        Diameters (m).
    weights : ndarray, shape (N,), optional
        Weights, such as masses (kg); by number by default.

    Returns
    -------
    tuple of four floats
        Percent, adding to 100.
    """
    which = np.searchsorted(CLASS_EDGES, diameter, side="right")
    sums = np.bincount(which, weights, len(CLASS_EDGES) + 1).astype(np.float64)
    return tuple(float(share) for share in 100 * sums / sums.sum())


def size_summary(diameter: Floats, mass: Floats) -> Sizes:
    """Size statistics.

    Parameters
    ----------
    diameter, mass : ndarray, shape (N,)
        Diameters (m) and masses (kg).

    Returns
    -------
    Sizes
    """
    return Sizes(
        count=len(diameter),
        mass=float(mass.sum()),
        mean=float(diameter.mean()),
        mass_mean=float(np.average(diameter, weights=mass)),
        sauter=float((diameter**3).sum() / (diameter**2).sum()),
        smallest=float(diameter.min()),
        largest=float(diameter.max()),
        classes=class_shares(diameter),
        mass_classes=class_shares(diameter, mass),
    )


def fine_edges(width: float = 50e-6, top: float = 1600e-6) -> Floats:
    """Borders of the fine histogram (m): bins of 50 µm from 0 to 1600 µm by default."""
    return np.linspace(0.0, top, round(top / width) + 1)


def histogram(diameter: Floats, mass: Floats, edges: Floats) -> tuple[Floats, Floats]:
    """Share of clusters and of mass in each bin; what lies beyond the last border counts in the last bin.

    Parameters
    ----------
    diameter, mass : ndarray, shape (N,)
        Diameters (m) and masses (kg).
    edges : ndarray, shape (B + 1,)
        Bin borders (m).

    Returns
    -------
    by_number, by_mass : ndarray, shape (B,)
        Percent.
    """
    inside = np.clip(diameter, edges[0], edges[-1])
    number = np.histogram(inside, edges)[0].astype(np.float64)
    weight = np.histogram(inside, edges, weights=mass)[0]
    return 100 * number / number.sum(), 100 * weight / weight.sum()
