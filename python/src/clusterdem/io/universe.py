"""Frames as MDAnalysis Universes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import MDAnalysis
import numpy as np
from MDAnalysis.coordinates.memory import MemoryReader
from MDAnalysis.core.topologyattrs import AtomAttr, Radii

from ..errors import ArgumentError
from ..frame import Floats, Frame

LENGTH = 1e6
"""MDAnalysis lengths per metre: positions, box and radii are in micrometres, which its float32 holds to 0.06 µm."""


class ParticleCounts(AtomAttr):  # type: ignore[misc]
    """Primary particles in each cluster."""

    attrname, singular, dtype = "particle_counts", "particle_count", np.int64


class _Frames(MemoryReader):  # type: ignore[misc]
    """Frames in memory, each with its own step, time and origin in ``ts.data``."""

    format = "CLUSTERDEM"

    def __init__(self, places: Any, heads: Sequence[Frame], origins: Sequence[Floats], **options: Any) -> None:
        self._heads, self._origins = heads, origins
        super().__init__(places, **options)

    def _read_next_timestep(self, ts: Any = None) -> Any:
        ts = super()._read_next_timestep(ts)
        head = self._heads[ts.frame]
        ts.data.update(step=head.step, time=head.time, origin=self._origins[ts.frame])
        return ts


def to_universe(frame: Frame, shift: bool = True) -> MDAnalysis.Universe:
    """Make a Universe of a frame.

    Parameters
    ----------
    frame : Frame
        The clusters.
    shift : bool
        Whether positions count from the box's lower corner, as MDAnalysis' own boxes do, or are those of the frame.

    Returns
    -------
    MDAnalysis.Universe
        Positions, box and ``radii`` in µm, ``masses`` in kg, ``ids``, ``types``; ``particle_counts`` where the dump has
        a column n and ``velocities`` (µm/s) where it has velocities. ``trajectory.ts.data`` holds step, time (s) and
        origin (µm): what was taken off the positions, (0, 0, 0) if nothing was.
    """
    return run_universe([frame], shift)


def run_universe(frames: Sequence[Frame], shift: bool = True) -> MDAnalysis.Universe:
    """Make one Universe of all frames of a run, whose clusters must be the same ones in all.

    Parameters
    ----------
    frames : sequence of Frame
        The frames; where clusters break or merge take :func:`to_universe` frame by frame.
    shift : bool
        As in :func:`to_universe`.

    Returns
    -------
    MDAnalysis.Universe
        In order of ids; names and units as in :func:`to_universe`, radii and masses those of the first frame.

    Raises
    ------
    ArgumentError
        If there is no frame, or the number of clusters or their ids change.
    """
    if not frames:
        raise ArgumentError("frames", "there are none")
    first = frames[0]
    order = [_order(frame) for frame in frames]
    ids = _ids(first)[order[0]]
    for frame, rows in zip(frames, order):
        if len(frame) != len(first) or not np.array_equal(_ids(frame)[rows], ids):
            rule = f"clusters change between step {first.step} and step {frame.step}: take a Universe of each frame"
            raise ArgumentError("frames", rule)
    velocities = all(f"v{axis}" in frame for frame in frames for axis in "xyz")
    universe = MDAnalysis.Universe.empty(len(first), trajectory=len(first) > 0, velocities=velocities)
    _add_attributes(universe, first, order[0], ids)
    if not len(first):
        return universe
    origins = [LENGTH * np.array(frame.box.lo) * shift for frame in frames]
    positions = [LENGTH * _columns(frame, "x", "y", "z")[rows] for frame, rows in zip(frames, order)]
    moving = (
        [LENGTH * _columns(frame, "vx", "vy", "vz")[rows] for frame, rows in zip(frames, order)] if velocities else None
    )
    universe.load_new(
        np.stack([p - o for p, o in zip(positions, origins)]).astype(np.float32),
        format=_Frames,
        heads=[frame.head for frame in frames],
        origins=origins,
        velocities=None if moving is None else np.stack(moving).astype(np.float32),
        dimensions=np.array([[*(LENGTH * side for side in frame.box.lengths), 90.0, 90.0, 90.0] for frame in frames]),
    )
    return universe


def _ids(frame: Frame) -> Floats:
    return frame["id"] if "id" in frame else np.arange(1.0, len(frame) + 1)


def _order(frame: Frame) -> np.ndarray:
    return np.argsort(_ids(frame), kind="stable")


def _columns(frame: Frame, *names: str) -> Floats:
    return np.stack([frame[name] for name in names], axis=1)


def _add_attributes(universe: MDAnalysis.Universe, frame: Frame, rows: np.ndarray, ids: Floats) -> None:
    universe.add_TopologyAttr("masses", frame.mass[rows])
    universe.add_TopologyAttr(Radii(LENGTH * frame.diameter[rows] / 2))
    universe.add_TopologyAttr("ids", ids.astype(np.int64))
    types = np.rint(frame["type"][rows]).astype(int).astype(str) if "type" in frame else np.full(len(rows), "1")
    universe.add_TopologyAttr("types", types.astype(object))
    if "n" in frame:
        universe.add_TopologyAttr(ParticleCounts(np.rint(frame["n"][rows]).astype(np.int64)))
