"""A frame as an MDAnalysis Universe."""

from __future__ import annotations

import MDAnalysis
import numpy as np
from MDAnalysis.core.topologyattrs import AtomAttr, Radii

from ..frame import Frame

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
