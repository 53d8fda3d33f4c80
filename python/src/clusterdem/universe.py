"""A frame as an MDAnalysis Universe, and an MDAnalysis analysis on it."""

from __future__ import annotations

import warnings

import MDAnalysis
import numpy as np
from MDAnalysis.analysis.rdf import InterRDF
from MDAnalysis.core.topologyattrs import AtomAttr, Radii

from .frame import Floats, Frame

LENGTH = 1e6
"""MDAnalysis lengths per metre: positions, box and radii are in micrometres, which its float32 holds to 0.06 µm."""


class ParticleCounts(AtomAttr):  # type: ignore[misc]
    """Primary particles in each cluster."""

    attrname, singular, dtype = "particle_counts", "particle_count", np.int64


def to_universe(frame: Frame) -> MDAnalysis.Universe:
    """Make a Universe of a frame.

    Parameters
    ----------
    frame : Frame
        The clusters.

    Returns
    -------
    MDAnalysis.Universe
        Positions, box and ``radii`` in µm, ``masses`` in kg, ``ids``; ``particle_counts`` where the dump has a
        column n and ``velocities`` (µm/s) where it has velocities. ``trajectory.ts.data`` holds step and time (s).
    """
    count = len(frame)
    velocities = all(f"v{axis}" in frame for axis in "xyz")
    universe = MDAnalysis.Universe.empty(count, trajectory=True, velocities=velocities)
    universe.add_TopologyAttr("masses", frame.mass)
    universe.add_TopologyAttr(Radii(LENGTH * frame.diameter / 2))
    universe.add_TopologyAttr("ids", frame["id"].astype(np.int64) if "id" in frame else np.arange(1, count + 1))
    if "n" in frame:
        universe.add_TopologyAttr(ParticleCounts(np.rint(frame["n"]).astype(np.int64)))
    low = np.array(frame.box.lo)
    y = frame["y"] if "y" in frame else np.full(count, (frame.box.lo[1] + frame.box.hi[1]) / 2)
    universe.atoms.positions = LENGTH * (np.stack([frame.x, y, frame.z], axis=1) - low)
    if velocities:
        universe.atoms.velocities = LENGTH * np.stack([frame["vx"], frame["vy"], frame["vz"]], axis=1)
    universe.dimensions = [*(LENGTH * length for length in frame.box.lengths), 90.0, 90.0, 90.0]
    universe.trajectory.ts.data.update(step=frame.step, time=frame.time)
    return universe


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
