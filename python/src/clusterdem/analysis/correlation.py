"""Cluster–cluster pair correlation."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..errors import ArgumentError
from ..frame import Floats, Frame

DIAMETERS, DISTANCES = 4.0, 2.0
"""How far g(r) looks by default: so many of the largest diameters, and so many mean distances of neighbours, at least."""


def reach_of(frame: Frame, plane: str = "xz") -> float:
    """How far g(r) of a frame looks by default (m), whatever the size of its clusters; less than half the box."""
    if not len(frame):
        return 0.0
    axes, volume, _ = _space(frame, plane)
    distance = (volume / len(frame)) ** (1 / len(axes))
    return float(max(DIAMETERS * frame.diameter.max(), DISTANCES * distance))


def _space(frame: Frame, plane: str) -> tuple[list[int], float, bool]:
    """Axes that count, their area or volume (m² or m³), and whether all centres lie in one plane."""
    axes = ["xyz".index(axis) for axis in plane]
    depth = 3 - sum(axes)
    planar = "xyz"[depth] not in frame or float(np.ptp(frame["xyz"[depth]])) < 1e-6 * frame.box.lengths[depth]
    axes = axes if planar else [0, 1, 2]
    return axes, float(np.prod([frame.box.lengths[axis] for axis in axes])), planar


def pair_correlation(
    frame: Frame, reach: float | None = None, bins: int = 40, plane: str = "xz"
) -> tuple[Floats, Floats]:
    """Cluster–cluster g(r), across the sides that repeat.

    Parameters
    ----------
    frame : Frame
        The clusters; where all centres lie in one plane g is normalised in it, else in space.
    reach : float, optional
        Largest distance (m); by default :func:`reach_of`. Never more than half the box.
    bins : int
        Number of bins.
    plane : str
        The plane in which they may lie.

    Returns
    -------
    r, g : ndarray, shape (bins,)
        Middle of each bin (m), and g: 1 is chance; NaN with fewer than two clusters. Beside walls that are not periodic
        g falls below it.

    Raises
    ------
    ArgumentError
        If the reach or the number of bins is not above 0.
    """
    if bins < 1 or (reach is not None and not 0 < reach < np.inf):
        raise ArgumentError("rmax", "must be a distance above 0 (m), with one bin or more")
    count = len(frame)
    if count < 2:
        edges = np.linspace(0.0, reach or 1.0, bins + 1)
        return (edges[:-1] + edges[1:]) / 2, np.full(bins, np.nan)
    axes, volume, _ = _space(frame, plane)
    sides = [frame.box.lengths[axis] for axis in axes]
    edges = np.linspace(0.0, min(reach or reach_of(frame, plane), 0.49 * min(sides)), bins + 1)
    places = np.stack([frame["xyz"[axis]] - frame.box.lo[axis] for axis in axes], axis=1)
    repeats = [side if frame.box.periodic[axis] else 0.0 for axis, side in zip(axes, sides)]
    for column, side in enumerate(repeats):
        if side:
            places[:, column] %= side
            places[places[:, column] >= side, column] = 0.0
    tree = cKDTree(places, boxsize=repeats)
    pairs = np.diff(tree.count_neighbors(tree, edges)).astype(np.float64)  # the first edge, 0, holds each with itself
    shell = np.pi * np.diff(edges**2) if len(axes) == 2 else 4 / 3 * np.pi * np.diff(edges**3)
    return (edges[:-1] + edges[1:]) / 2, pairs / (count * (count - 1) * shell / volume)
