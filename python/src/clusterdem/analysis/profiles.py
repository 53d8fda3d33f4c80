"""Profiles: across the width, from centre to wall, along the height, over the radius of a tube.

A cluster belongs whole to the bin of its centre. The volume of a bin is its own: a slab of the box, an annulus of the tube.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..frame import Box, Floats, Frame
from .grid import Maps


@dataclass(frozen=True)
class Profile:
    """A profile of one frame.

    Parameters
    ----------
    edges : ndarray, shape (B + 1,)
        Borders of the bins (m).
    fraction : ndarray, shape (B,), or None
        Solids fraction, where it was asked for.
    velocity : ndarray, shape (B,), or None
        Mass-weighted mean velocity along ``along`` (m/s).
    diameter : ndarray, shape (B,)
        Mean diameter by number (m); NaN where no cluster is.
    count : ndarray, shape (B,)
        Clusters.
    mass : ndarray, shape (B,)
        Their mass (kg).
    across : str
        What the bins stand along: an axis, or r, the distance from a tube's axis.
    along : str
        The axis of the velocity.
    """

    edges: Floats
    fraction: Floats | None
    velocity: Floats | None
    diameter: Floats
    count: Floats
    mass: Floats
    across: str = "x"
    along: str = "z"

    @property
    def columns(self) -> Maps:
        """Its numbers by the names that tables have, shape (B,) each."""
        found = {"fraction": self.fraction, f"velocity_{self.along}": self.velocity, "mean_diameter": self.diameter}
        nothing = np.full(len(self.count), np.nan)
        named = {name: nothing if values is None else values for name, values in found.items()}
        return named | {"clusters": self.count, "mass": self.mass}


WEIGHTS = {"velocity_x": "mass", "velocity_y": "mass", "velocity_z": "mass", "mean_diameter": "clusters"}
"""What the means of a profile are weighted by, for averages over time."""


@dataclass(frozen=True)
class Tube:
    """A round tube along an axis of the box.

    Parameters
    ----------
    axis : str
        Its direction: x, y or z.
    centre : (float, float)
        Where its axis lies, along the two others in the order x, y, z (m).
    radius : float
        Inner radius (m).

    Raises
    ------
    ArgumentError
        If the axis is none, or the radius not above 0.

    Examples
    --------
    >>> tube = Tube.in_box(Box((0, 0, 0), (0.1, 0.2, 2.0)))
    >>> tube.centre, tube.radius
    ((0.05, 0.1), 0.05)
    """

    axis: str
    centre: tuple[float, float]
    radius: float

    def __post_init__(self) -> None:
        if self.axis not in ("x", "y", "z"):
            raise ArgumentError("axis", f"must be x, y or z, not {self.axis}")
        if not 0 < self.radius < np.inf:
            raise ArgumentError("radius", f"must be above 0 m, not {self.radius:g}")

    @classmethod
    def in_box(
        cls, box: Box, axis: str = "z", centre: tuple[float, float] | None = None, radius: float | None = None
    ) -> Tube:
        """The tube in a box: about the middle, as wide as the narrower side, where nothing else is given (m)."""
        sides = [number for number, letter in enumerate("xyz") if letter != axis]
        middle = tuple((box.lo[side] + box.hi[side]) / 2 for side in sides)
        widest = min(box.lengths[side] for side in sides) / 2
        return cls(axis, centre or (middle[0], middle[1]), widest if radius is None else radius)

    def distance(self, frame: Frame) -> Floats:
        """Distance of the centres from the tube's axis (m), shape (N,)."""
        first, second = (letter for letter in "xyz" if letter != self.axis)
        return np.hypot(frame[first] - self.centre[0], frame[second] - self.centre[1])


def _mean(total: Floats, weight: Floats) -> Floats:
    out: Floats = np.divide(total, weight, out=np.full(len(total), np.nan), where=weight > 0)
    return out


def _profile(
    frame: Frame, where: NDArray[np.int64], edges: Floats, volume: Floats | float, axes: str, fractions: bool
) -> Profile:
    """Sums over the clusters of each bin, ``where``; a bin beyond all takes what belongs to none."""
    bins = len(edges) - 1

    def total(values: Floats | None = None) -> Floats:
        return np.bincount(where, values, bins + 1)[:bins].astype(np.float64, copy=False)

    along = f"v{axes[1]}"
    count, mass = total(), total(frame.mass)
    return Profile(
        edges,
        total(frame.solids) / volume if fractions else None,
        _mean(total(frame.mass * frame[along]), mass) if along in frame else None,
        _mean(total(frame.diameter), count),
        count,
        mass,
        *axes,
    )


def _bin_of(place: Floats, edges: Floats) -> NDArray[np.int64]:
    """The bin of each place; beyond the borders the outermost takes it, on one the upper."""
    where: NDArray[np.int64] = np.clip(np.searchsorted(edges, place, side="right") - 1, 0, len(edges) - 2)
    return where


def _slabs(frame: Frame, place: Floats, edges: Floats, axes: str, fractions: bool) -> Profile:
    volume = float(np.prod(frame.box.lengths)) / (len(edges) - 1)
    return _profile(frame, _bin_of(place, edges), edges, volume, axes, fractions)


def lateral(frame: Frame, bins: int = 30, plane: str = "xz", fractions: bool = True) -> Profile:
    """Profile across the width, the plane's first axis, averaged over the two others."""
    return _along_axis(frame, bins, plane, fractions)


def height(frame: Frame, bins: int = 30, plane: str = "xz", fractions: bool = True) -> Profile:
    """Profile along the height, the plane's second axis, averaged over the two others."""
    return _along_axis(frame, bins, 2 * plane[1], fractions)


def _along_axis(frame: Frame, bins: int, axes: str, fractions: bool) -> Profile:
    _check_bins(bins)
    axis = "xyz".index(axes[0])
    edges = np.linspace(frame.box.lo[axis], frame.box.hi[axis], bins + 1)
    return _slabs(frame, frame[axes[0]], edges, axes, fractions)


def strips(frame: Frame, count: int = 6, plane: str = "xz", fractions: bool = True) -> Profile:
    """Profile from the centre (0) to the wall (half the width), both halves together, in equal strips."""
    _check_bins(count)
    axis = "xyz".index(plane[0])
    half = frame.box.lengths[axis] / 2
    distance = np.abs(frame[plane[0]] - (frame.box.lo[axis] + half))
    return _slabs(frame, distance, np.linspace(0.0, half, count + 1), plane, fractions)


def radial(frame: Frame, tube: Tube, bins: int = 10, fractions: bool = True) -> Profile:
    """Profile over the radius of a tube, in annuli of equal width, along the whole box.

    Parameters
    ----------
    frame : Frame
        The clusters.
    tube : Tube
        The tube; clusters with their centres beyond its radius count nowhere.
    bins : int
        Annuli.
    fractions : bool
        Whether the solids fraction is among the numbers, which needs to know the primary particles.

    Returns
    -------
    Profile
        The fraction is the volume of solids of the clusters whose centres lie in an annulus over the annulus' own,
        π (r_2² − r_1²) L with the length L of the box; the velocity that along the tube.

    Raises
    ------
    ArgumentError
        If there is no annulus.
    """
    _check_bins(bins)
    edges = np.linspace(0.0, tube.radius, bins + 1)
    distance = tube.distance(frame)
    where = np.where(distance > tube.radius, bins, _bin_of(distance, edges))
    volume = np.pi * np.diff(edges**2) * frame.box.lengths["xyz".index(tube.axis)]
    return _profile(frame, where, edges, volume, f"r{tube.axis}", fractions)


def _check_bins(bins: int) -> None:
    if bins < 1:
        raise ArgumentError("bins", f"must be 1 or more, not {bins}")
