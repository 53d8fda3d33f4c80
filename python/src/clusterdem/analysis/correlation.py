"""Cluster–cluster pair correlation."""

from __future__ import annotations

import warnings

import numpy as np
from MDAnalysis.analysis.rdf import InterRDF

from ..frame import Floats, Frame
from ..io.universe import LENGTH, to_universe


def pair_correlation(frame: Frame, reach: float = 4e-3, bins: int = 40) -> tuple[Floats, Floats]:
    """Cluster–cluster g(r) by MDAnalysis' ``InterRDF`` with the periodic box.

    Parameters
    ----------
    frame : Frame
        The clusters; where all centres share one y, g is normalised in that plane, else in space.
    reach : float
        Largest distance (m).
    bins : int
        Number of bins.

    Returns
    -------
    r, g : ndarray, shape (bins,)
        Middle of each bin (m), and g: 1 is chance. Beside walls that are not periodic g falls below it.
    """
    count = len(frame)
    universe = to_universe(frame)
    lx, ly, lz = frame.box.lengths
    planar = "y" not in frame or float(np.ptp(frame["y"])) < 1e-9
    reach = min(reach, 0.49 * min(lx, lz) if planar else 0.49 * min(lx, ly, lz))
    sides = np.array([lx, ly, lz])
    if planar:
        sides[1] = 4 * reach  # no images across the slab
    for axis in range(3):
        if not frame.box.periodic[axis]:
            sides[axis] += 2 * reach
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        universe.dimensions = [*(LENGTH * sides), 90.0, 90.0, 90.0]
        rdf = InterRDF(universe.atoms, universe.atoms, bins, (0.0, LENGTH * reach), norm="none").run()
    edges = np.asarray(rdf.results.edges) / LENGTH
    pairs = np.asarray(rdf.results.count, dtype=np.float64)
    pairs[0] -= count  # each cluster with itself
    shell = np.pi * np.diff(edges**2) / (lx * lz) if planar else 4 / 3 * np.pi * np.diff(edges**3) / (lx * ly * lz)
    return (edges[:-1] + edges[1:]) / 2, pairs / (max(count * (count - 1), 1) * shell)
