"""Connected groups: clusters that touch each other, or lie no farther apart than a gap."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..errors import ArgumentError
from ..frame import Floats, Frame

Integers = NDArray[np.int64]

SLACK = 1e-9
"""Share of the distance within which two clusters touch that is rounding."""


@dataclass(frozen=True)
class Groups:
    """The connected groups of one frame, a cluster by itself being one, too; the largest by clusters first.

    Parameters
    ----------
    member : ndarray of int, shape (N,)
        Number of the group that each cluster belongs to.
    clusters : ndarray of int, shape (G,)
        Clusters of each group.
    mass : ndarray, shape (G,)
        Mass of each (kg).
    extent : ndarray, shape (G, 3)
        How far each reaches along x, y, z (m), from sphere's edge to sphere's edge and across sides that repeat; never more than
        such a side.
    """

    member: Integers
    clusters: Integers
    mass: Floats
    extent: Floats


def groups_of(frame: Frame, gap: float = 0.0) -> Groups:
    """The connected groups of a frame.

    Parameters
    ----------
    frame : Frame
        The clusters: spheres with centres x, y, z.
    gap : float
        Largest gap between the surfaces of two clusters that belong together (m); 0 for those that touch or overlap.

    Returns
    -------
    Groups

    Raises
    ------
    ArgumentError
        If the gap is below 0 or no number.

    Notes
    -----
    Two clusters belong together if their centres, by the nearest of their images, are (d_1 + d_2)/2 + gap apart or less; groups
    are the connected components of that graph (union–find, as scipy has it). Neighbours are looked up size class by size
    class, so that few large clusters do not make many pairs of small ones.

    Examples
    --------
    >>> from clusterdem import Box
    >>> columns = {"x": [0.1, 0.9, 2.0], "y": [0.5] * 3, "z": [0.5] * 3, "mass": [1.0, 2.0, 4.0], "diameter": [0.5, 0.4, 0.4]}
    >>> frame = Frame(0, 0.0, Box((0, 0, 0), (3.0, 1, 1)), {k: np.array(v) for k, v in columns.items()})
    >>> groups_of(frame, 0.4).mass.tolist(), groups_of(frame, 0.4).extent[0].round(6).tolist()
    ([3.0, 4.0], [1.25, 0.5, 0.5])
    """
    if not 0 <= gap < np.inf:
        raise ArgumentError("gap", f"must be 0 or more (m), not {gap:g}")
    if not len(frame):
        return Groups(np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0), np.empty((0, 3)))
    first, second = _touching(frame, gap)
    graph = coo_array((np.ones(len(first), bool), (first, second)), shape=(len(frame), len(frame)))
    count, label = connected_components(graph, directed=False)
    clusters = np.bincount(label, minlength=count)
    mass = np.bincount(label, frame.mass, count).astype(np.float64, copy=False)
    order = np.lexsort((-mass, -clusters))
    rank = np.empty(count, np.int64)
    rank[order] = np.arange(count)
    member: Integers = rank[label]
    extent = np.stack([_extent(frame, axis, member, count) for axis in range(3)], axis=1)
    return Groups(member, clusters[order].astype(np.int64), mass[order], extent)


def _touching(frame: Frame, gap: float) -> tuple[Integers, Integers]:
    """Pairs of clusters that belong together."""
    box, radius = frame.box, frame.diameter / 2
    repeats = [length if periodic else 0.0 for length, periodic in zip(box.lengths, box.periodic)]
    places = np.stack([frame[axis] - low for axis, low in zip("xyz", box.lo)], axis=1)
    for axis, side in enumerate(repeats):
        if side:
            places[:, axis] %= side
            places[places[:, axis] >= side, axis] = 0.0  # what the remainder of a tiny negative number rounds to
    size = np.floor(np.log2(radius / radius.min())).astype(np.int64)
    classes = [np.flatnonzero(size == number) for number in np.unique(size)]
    trees = [cKDTree(places[chosen], boxsize=repeats) for chosen in classes]
    found: list[tuple[Integers, Integers]] = []
    for a, b in combinations_with_replacement(range(len(classes)), 2):
        reach = float(radius[classes[a]].max() + radius[classes[b]].max() + gap)
        near = trees[a].sparse_distance_matrix(trees[b], reach * (1 + SLACK), output_type="coo_matrix")
        one, other = classes[a][near.row], classes[b][near.col]
        close = near.data <= (radius[one] + radius[other] + gap) * (1 + SLACK)
        found.append((one[close], other[close]))
    first, second = zip(*found)
    return np.concatenate(first), np.concatenate(second)


def _extent(frame: Frame, axis: int, member: Integers, count: int) -> Floats:
    """How far each group reaches along an axis (m), shape (G,)."""
    place, radius = frame["xyz"[axis]] - frame.box.lo[axis], frame.diameter / 2
    if not frame.box.periodic[axis]:
        low, high = np.full(count, np.inf), np.full(count, -np.inf)
        np.minimum.at(low, member, place - radius)
        np.maximum.at(high, member, place + radius)
        reach: Floats = high - low
        return reach
    return _extent_around(place, radius, member, count, frame.box.lengths[axis])


def _extent_around(place: Floats, radius: Floats, member: Integers, count: int, side: float) -> Floats:
    """The side less the widest part of it that no sphere of the group covers."""
    begin = (place - radius) % side
    order = np.lexsort((begin, member))
    group, begin, end = member[order], begin[order], begin[order] + 2 * radius[order]
    # the farthest end so far in each group: groups are set apart by more than any end
    apart = group * (side + 2 * float(radius.max()))
    farthest = np.maximum.accumulate(end + apart) - apart
    last = np.flatnonzero(np.diff(group, append=count))
    over_the_side = farthest[last] - side  # as far as the group covers the side anew
    first = np.flatnonzero(np.diff(group, prepend=-1))
    covered = np.concatenate([[-np.inf], farthest[:-1]])
    covered[first] = -np.inf
    free = begin - np.maximum(covered, over_the_side[group])
    widest = np.full(count, -np.inf)
    np.maximum.at(widest, group, free)
    return np.clip(side - widest, 0.0, side)
