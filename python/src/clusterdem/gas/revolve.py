"""Half domains made whole: bodies of revolution about their axis, mirror images about a plane."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..frame import Floats
from .sources import ROUNDING, Source


@dataclass(frozen=True, eq=False)
class Axis:
    """The axis of a body of revolution, and the half plane that its values are given in.

    Parameters
    ----------
    origin, along, outward : ndarray, shape (3,)
        A point of the axis, its direction, and the direction away from it that lies in the half plane (unit vectors).
    """

    origin: Floats
    along: Floats
    outward: Floats

    def _split(self, points: Floats) -> tuple[Floats, Floats]:
        """Coordinate along the axis, and the part of each place away from it."""
        away = points - self.origin
        height = away @ self.along
        return height, away - height[:, None] * self.along

    def radius(self, points: Floats) -> Floats:
        """Distance from the axis."""
        radius: Floats = np.linalg.norm(self._split(points)[1], axis=1)
        return radius

    def fold(self, points: Floats) -> Floats:
        """Each place turned into the half plane."""
        height, away = self._split(points)
        radius = np.linalg.norm(away, axis=1)
        folded: Floats = self.origin + height[:, None] * self.along + radius[:, None] * self.outward
        return folded

    def unfold(self, vectors: Floats, points: Floats) -> Floats:
        """Vectors of the half plane turned with it to places; on the axis as they are."""
        _, away = self._split(points)
        radius = np.linalg.norm(away, axis=1)[:, None]
        outward = np.where(radius > 0, away / np.maximum(radius, 1e-300), self.outward)
        around, around_there = np.cross(self.along, self.outward), np.cross(self.along, outward)
        parts = (vectors @ d for d in (self.along, self.outward, around))
        height, out, round_ = (part[:, None] for part in parts)
        turned: Floats = height * self.along + out * outward + round_ * around_there
        return turned


@dataclass(eq=False)
class Completed(Source):
    """A source that is a part of what it stands for.

    Parameters
    ----------
    inner : Source
        The part; its arrays of three components are vectors.
    """

    inner: Source = None  # type: ignore[assignment]

    @property
    def walls(self) -> list[str]:
        return self.inner.walls

    def slipping(self, names: Iterable[str]) -> list[str]:
        return self.inner.slipping(names)

    def fold(self, places: Floats) -> Floats:
        """Where the part has what the whole has at places."""
        raise NotImplementedError

    def unfold(self, vectors: Floats, places: Floats) -> Floats:
        """Vectors of the part as they stand at places of the whole."""
        raise NotImplementedError

    def sample(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        self.inner.no_slip = self.no_slip
        return self._unfolded(self.inner.sample(self.fold(places), names), places)

    def means(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        return self._unfolded(self.inner.means(self.fold(places), names), places)

    def nearest(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        return self._unfolded(self.inner.nearest(self.fold(places), names), places)

    def _unfolded(self, found: dict[str, Floats], places: Floats) -> dict[str, Floats]:
        return {name: self.unfold(v, places) if v.ndim == 2 and v.shape[1] == 3 else v for name, v in found.items()}


@dataclass(eq=False)
class Revolved(Completed):
    """A half plane turned about an axis.

    Parameters
    ----------
    axis : Axis
        The axis.
    """

    axis: Axis = None  # type: ignore[assignment]

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        low, high = self.inner.bounds
        corners = np.array([[(low, high)[k][i] for i, k in enumerate(c)] for c in np.ndindex(2, 2, 2)])
        radius = float(self.axis.radius(corners).max())
        height = (corners - self.axis.origin) @ self.axis.along
        ends = self.axis.origin + np.array([[height.min()], [height.max()]]) * self.axis.along
        across = radius * np.sqrt(np.maximum(1 - self.axis.along**2, 0.0))
        return ends.min(axis=0) - across, ends.max(axis=0) + across

    def fold(self, places: Floats) -> Floats:
        return self.axis.fold(places)

    def unfold(self, vectors: Floats, places: Floats) -> Floats:
        return self.axis.unfold(vectors, places)


@dataclass(eq=False)
class Mirrored(Completed):
    """A half domain and its mirror image.

    Parameters
    ----------
    axis : int
        Which coordinate is turned round.
    at : float
        Where the mirror stands.
    upper : bool
        The half domain lies below the mirror, not above it.
    """

    axis: int = 0
    at: float = 0.0
    upper: bool = False

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        low, high = (end.copy() for end in self.inner.bounds)
        if self.upper:
            high[self.axis] = 2 * self.at - low[self.axis]
        else:
            low[self.axis] = 2 * self.at - high[self.axis]
        return low, high

    def _beyond(self, places: Floats) -> NDArray[np.bool_]:
        return places[:, self.axis] > self.at if self.upper else places[:, self.axis] < self.at

    def fold(self, places: Floats) -> Floats:
        folded, beyond = places.copy(), self._beyond(places)
        folded[beyond, self.axis] = 2 * self.at - places[beyond, self.axis]
        return folded

    def unfold(self, vectors: Floats, places: Floats) -> Floats:
        turned, beyond = vectors.copy(), self._beyond(places)
        turned[beyond, self.axis] *= -1
        return turned


def mirrored(source: Source, words: Iterable[str]) -> Source:
    """Mirror a source at its ends: ``x-`` at its lowest x, ``x+`` at its highest, in its own axes."""
    for word in words:
        if len(word) != 2 or word[0] not in "xyz" or word[1] not in "+-":
            raise InputError("--mirror", f"must be ends of INPUT such as x- (its lowest x) or z+, not {word}")
        axis, upper = "xyz".index(word[0]), word[1] == "+"
        low, high = source.bounds
        if not high[axis] > low[axis]:
            raise InputError("--mirror", f"{word}: {source.path} has no extent along {word[0]}")
        at = float((high if upper else low)[axis])
        source = Mirrored(
            source.path, source.arrays, source.points, source.time, inner=source, axis=axis, at=at, upper=upper
        )
    return source


def revolved(source: Source, word: str) -> Source:
    """Turn a plane source about an axis of its own that bounds it or lies beside it (``x``, ``y`` or ``z``)."""
    if isinstance(source, Revolved):
        return source
    if word not in ("x", "y", "z"):
        raise InputError("--revolve", f"must be the axis x, y or z of INPUT, not {word}")
    low, high = source.bounds
    size = np.max(high - low)
    flat = np.flatnonzero(high - low <= ROUNDING * size)
    along = "xyz".index(word)
    if flat.size != 1 or along in flat:
        raise InputError("--revolve", f"{word}: {source.path} must lie in one plane that has the {word} axis")
    outward = ({0, 1, 2} - {along, int(flat[0])}).pop()
    if low[outward] < -ROUNDING * size:
        rule = f"{word}: {source.path} must lie on one side of the axis, but its {'xyz'[outward]} begins at"
        raise InputError("--revolve", f"{rule} {low[outward]:.6g}")
    unit = np.eye(3)
    origin = unit[flat[0]] * low[flat[0]]
    axis = Axis(origin, unit[along], unit[outward])
    return Revolved(source.path, source.arrays, source.points, source.time, inner=source, axis=axis)


def with_vector(source: Source, names: tuple[str, ...]) -> tuple[Source, str]:
    """Three arrays (``0`` for none) as one vector, so that it can be turned."""
    one = " ".join(names)
    zero = np.zeros(len(source.points))
    stacked = np.stack([zero if name == "0" else source.arrays[name].reshape(-1) for name in names], axis=1)
    return replace(source, arrays={**source.arrays, one: stacked}), one
