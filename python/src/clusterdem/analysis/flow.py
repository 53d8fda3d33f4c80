"""Mass flow of solids through a plane: from momentum beside it, and from clusters that crossed it between two frames."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ArgumentError, InputError
from ..frame import Box, Floats, Frame


@dataclass(frozen=True)
class Section:
    """A plane across an axis of a box, through which solids flow.

    Parameters
    ----------
    axis : str
        The axis that it stands across: x, y or z; *up* is towards its larger values.
    place : float
        Where along it (m).

    Raises
    ------
    ArgumentError
        If the axis is none.
    """

    axis: str
    place: float

    def __post_init__(self) -> None:
        if self.axis not in ("x", "y", "z"):
            raise ArgumentError("axis", f"must be x, y or z, not {self.axis}")

    def side(self, box: Box) -> tuple[float, float, bool]:
        """Lower bound and length of the box along the axis (m), and whether it repeats.

        Raises
        ------
        ArgumentError
            If the plane lies outside.
        """
        number = "xyz".index(self.axis)
        low, high = box.lo[number], box.hi[number]
        if not low <= self.place <= high:
            raise ArgumentError(
                "at", f"must lie in the box, {self.axis} = {low:g} to {high:g} m, not at {self.place:g} m"
            )
        return low, box.lengths[number], box.periodic[number]


@dataclass(frozen=True)
class MassFlow:
    """Mass flow through a plane (kg/s): ``up`` 0 or more, ``down`` 0 or less."""

    up: float
    down: float

    @property
    def net(self) -> float:
        """Both together (kg/s)."""
        return self.up + self.down


@dataclass(frozen=True)
class Crossings:
    """What crossed a plane between two frames.

    Parameters
    ----------
    flow : MassFlow
        The mass over the time between them.
    clusters_up, clusters_down : int
        Clusters that crossed.
    unmatched : float
        Share of the earlier frame's mass whose IDs the later one has no more, or 0: merged, or left through a face.
    """

    flow: MassFlow
    clusters_up: int
    clusters_down: int
    unmatched: float


def slab_flow(frame: Frame, section: Section, thickness: float) -> MassFlow:
    """Mass flow at one instant, ∫ ρ u dA, from the momentum in a slab about a plane.

    Parameters
    ----------
    frame : Frame
        The clusters, with the velocity along the plane's axis.
    section : Section
        The middle of the slab.
    thickness : float
        How thick it is (m), h; a thin one follows the flow, a thick one has more clusters to average over.

    Returns
    -------
    MassFlow
        Σ m v / h over the clusters whose centres lie in the slab, those that go up and those that go down.

    Raises
    ------
    ArgumentError
        If the slab is no slab of the box.
    InputError
        If the velocity is not there.
    """
    low, length, repeats = section.side(frame.box)
    if not 0 < thickness <= length:
        raise ArgumentError("slab", f"must be above 0 and at most the box' {length:g} m, not {thickness:g} m")
    room = min(section.place - low, low + length - section.place)
    if not repeats and thickness / 2 > room + 1e-9 * length:
        rule = f"of {thickness:g} m about {section.place:g} m must lie in the box, {low:g} to {low + length:g} m along {section.axis}"
        raise ArgumentError("slab", rule)
    if f"v{section.axis}" not in frame:
        raise InputError(frame.path or "frame", f"no column v{section.axis}, from which the flow follows", frame.line)
    apart = frame[section.axis] - section.place
    if repeats:
        apart -= length * np.floor(apart / length + 0.5)
    inside = (apart >= -thickness / 2) & (apart < thickness / 2)
    momentum = (frame.mass * frame[f"v{section.axis}"])[inside]
    return MassFlow(float(momentum[momentum > 0].sum()) / thickness, float(momentum[momentum < 0].sum()) / thickness)


def crossings(before: Frame, after: Frame, section: Section) -> Crossings:
    """What crossed a plane between two frames, by clusters that have the same ID in both.

    Parameters
    ----------
    before, after : Frame
        Two frames of one box with the column ``id``.
    section : Section
        The plane.

    Returns
    -------
    Crossings

    Raises
    ------
    ArgumentError
        If the plane lies outside of the box, or the second frame is not later.
    InputError
        If there are no IDs.

    Notes
    -----
    Along an axis that repeats a cluster has gone the shorter way, so that frames must be closer than the time in which one goes
    half the box; :func:`farthest` tells. A breakup leaves the ID to the first piece, a merge to the cluster with the
    lower one (fix cluster/breakmerge). The other pieces and the merged partner have nothing to be compared with, and are
    mostly beside those that keep the ID: so that their mass is not lost, the larger mass of the two frames counts. Where pieces end on
    both sides of the plane, or clusters merge across it, that is too much.
    """
    low, length, repeats = section.side(before.box)
    interval = after.time - before.time
    if not interval > 0:
        raise ArgumentError("time", f"must be known and rise, not go from {before.time:g} s to {after.time:g} s")
    for frame in (before, after):
        if "id" not in frame:
            raise InputError(frame.path or "frame", "no column id, by which clusters are known again", frame.line)
    _, mine, its = np.intersect1d(before["id"], after["id"], return_indices=True)
    was, now = before[section.axis][mine] - section.place, after[section.axis][its] - section.place
    if repeats:
        now = was + (now - was) - length * np.round((now - was) / length)
        passed = np.floor(now / length) - np.floor(was / length)
    else:
        passed = (now >= 0).astype(float) - (was >= 0)
    mass = passed * np.maximum(before.mass[mine], after.mass[its])
    total = float(before.mass.sum())
    return Crossings(
        MassFlow(float(mass[mass > 0].sum()) / interval, float(mass[mass < 0].sum()) / interval),
        int((passed > 0).sum()),
        int((passed < 0).sum()),
        max(1 - float(before.mass[mine].sum()) / total, 0.0) if total else 0.0,
    )


def farthest(before: Frame, after: Frame, section: Section) -> float:
    """How far the fastest cluster of two frames goes between them, over the length of the box; 0 without velocities."""
    speeds: list[Floats] = [
        np.abs(frame[f"v{section.axis}"]) for frame in (before, after) if f"v{section.axis}" in frame
    ]
    fastest = max((float(speed.max(initial=0.0)) for speed in speeds), default=0.0)
    return fastest * (after.time - before.time) / section.side(before.box)[1]
