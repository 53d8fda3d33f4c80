"""Results of a CFD run that can be asked for their values anywhere: on a grid, at scattered points, on a mesh.

All three interpolate linearly: exact for linear fields, second-order for smooth ones. What a point outside gets is NaN.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.interpolate import LinearNDInterpolator, RegularGridInterpolator
from scipy.spatial import Delaunay, KDTree, QhullError
from threadpoolctl import threadpool_limits

from ..errors import InputError
from ..frame import Floats
from .field import Axes

ROUNDING = 1e-6
"""Share of the size by which a point may lie outside and still counts as on the border; CFD files are often float32."""

Arrays = Mapping[str, Floats]


@dataclass(eq=False)
class Source:
    """Values at points, and a way to values between them.

    Parameters
    ----------
    path : str
        The file, for messages.
    arrays : mapping of str to ndarray, shape (M,) or (M, k)
        Values at each point, in the file's own units.
    points : ndarray, shape (M, 3)
        Where, in the file's own units and axes.
    time : float
        Time (s); NaN if the file does not tell.
    no_slip : frozenset of str
        Arrays that vanish at walls, whatever the file says.
    notes : sequence of str
        What the user should know of it.
    steady : bool
        It is the result of a steady solver, whose times are iterations.
    units : mapping of str to str
        Units that the file tells, of its arrays, and of its coordinates under "".
    """

    path: str
    arrays: Arrays
    points: Floats
    time: float = math.nan
    no_slip: frozenset[str] = frozenset()
    notes: Sequence[str] = ()
    steady: bool = False
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def walls(self) -> list[str]:
        """Names of its walls, as far as the file tells them."""
        return []

    def slipping(self, names: Iterable[str]) -> list[str]:
        """Those of its walls at which it knows no values of the velocity's arrays."""
        return []

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lowest and highest coordinates."""
        return self.points.min(axis=0), self.points.max(axis=0)

    def snapped(self, places: Floats) -> Floats:
        """Places off the bounds by no more than rounding, to either side, put onto them."""
        low, high = self.bounds
        margin = ROUNDING * float(np.max(high - low))
        for end in (low, high):
            places = np.where(np.abs(places - end) <= margin, end, places)
        return places

    def sample(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        """Values at places, shape (N, 3); NaN outside."""
        raise NotImplementedError

    def means(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        """Values whose integral over a section is the flux of the source: those of its cells, as they are, if it has such."""
        return self.sample(places, names)

    def nearest(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        """Values of the nearest points that have finite ones."""
        names = list(names)
        whole = np.all([_rows(np.isfinite(self.arrays[name])) for name in names], axis=0)
        if not whole.any():
            raise InputError(self.path, f"no point has finite values of {', '.join(names)}")
        _, at = KDTree(self.points[whole]).query(places)
        return {name: self.arrays[name][whole][at] for name in names}


def _rows(flags: Any) -> Any:
    return flags if flags.ndim == 1 else flags.all(axis=1)


@dataclass(eq=False)
class GridSource(Source):
    """Values on a rectilinear grid, x fastest; an axis with one point is uniform.

    Parameters
    ----------
    axes : (x, y, z)
        Coordinates, ascending.
    """

    axes: Axes = field(default=(np.zeros(1), np.zeros(1), np.zeros(1)))

    def sample(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        long = [k for k in range(3) if self.axes[k].size > 1]
        shape = tuple(axis.size for axis in reversed(self.axes))
        places = self.snapped(places)[:, long]
        found = {}
        for name in names:
            values = self.arrays[name]
            table = np.moveaxis(values.reshape(*shape, *values.shape[1:]), (0, 1, 2), (2, 1, 0))
            table = np.squeeze(table, axis=tuple(k for k in range(3) if k not in long))
            if not long:
                found[name] = np.broadcast_to(table, (len(places), *values.shape[1:])).copy()
                continue
            between = RegularGridInterpolator([self.axes[k] for k in long], table, bounds_error=False)
            found[name] = np.asarray(between(places), np.float64)
        return found

    def closed(self, axis: int, period: float) -> GridSource:
        """The grid with its first plane repeated a period later, if what lacks there is not more than a cell."""
        own = self.axes[axis]
        gap = period - (own[-1] - own[0])
        if own.size < 2 or not ROUNDING * period < gap <= (1 + ROUNDING) * float(np.max(np.diff(own))):
            return self
        longer = list(self.axes)
        longer[axis] = np.append(own, own[0] + period)
        shape = tuple(a.size for a in reversed(self.axes))
        arrays = {}
        for name, values in self.arrays.items():
            table = values.reshape(*shape, *values.shape[1:])
            table = np.concatenate([table, np.take(table, [0], 2 - axis)], axis=2 - axis)
            arrays[name] = table.reshape(-1, *values.shape[1:])
        return grid_source(self.path, (longer[0], longer[1], longer[2]), arrays, self.time)


def grid_source(path: str, axes: Axes, arrays: Arrays, time: float = math.nan) -> GridSource:
    """A :class:`GridSource` from its axes; each axis must ascend or descend, and is made to ascend."""
    flips = []
    for name, axis in zip("xyz", axes):
        steps = np.diff(axis)
        if not np.all(np.isfinite(axis)):
            raise InputError(path, f"the {name} coordinates of its grid must be finite")
        if not (np.all(steps > 0) or np.all(steps < 0)):
            k = int(np.argmax(steps * (steps[0] if steps.size else 1.0) <= 0))
            raise InputError(path, f"the {name} coordinates of its grid must ascend: {axis[k]:.6g}, {axis[k + 1]:.6g}")
        flips.append(bool(steps.size and steps[0] < 0))
    shape = tuple(axis.size for axis in reversed(axes))
    order = np.arange(math.prod(shape)).reshape(shape)
    order = np.flip(order, tuple(k for k, flip in zip((2, 1, 0), flips) if flip)).ravel()
    x, y, z = (axis[::-1] if flip else axis for axis, flip in zip(axes, flips))
    mesh = np.meshgrid(z, y, x, indexing="ij")
    points = np.stack([m.ravel() for m in reversed(mesh)], axis=1)
    return GridSource(path, {name: v[order] for name, v in arrays.items()}, points, time, axes=(x, y, z))


def cell_grid(path: str, axes: Axes, cells: Arrays, time: float = math.nan) -> GridSource:
    """Cell values of a rectilinear grid: at the cells' centres, and continued linearly to the outer faces.

    The faces are where a box ends, half a cell beyond the last centre. The continuation keeps the second order.
    """
    shape = tuple(max(axis.size - 1, 1) for axis in reversed(axes))
    centres = [axis if axis.size == 1 else (axis[1:] + axis[:-1]) / 2 for axis in axes]
    arrays = {name: values.reshape(*shape, *values.shape[1:]) for name, values in cells.items()}
    for k, axis in enumerate(axes):
        c = centres[k]
        if c.size < 2:  # one cell: uniform along this axis
            continue
        d = 2 - k  # arrays run z, y, x
        centres[k] = np.concatenate([axis[:1], c, axis[-1:]])
        w0, w1 = (c[0] - axis[0]) / (c[1] - c[0]), (axis[-1] - c[-1]) / (c[-1] - c[-2])
        for name, v in arrays.items():
            first, second, last, before = (np.take(v, [i], d) for i in (0, 1, -1, -2))
            ends = first + w0 * (first - second), last + w1 * (last - before)
            arrays[name] = np.concatenate([ends[0], v, ends[1]], axis=d)
    flat = {name: v.reshape(-1, *v.shape[3:]) for name, v in arrays.items()}
    return grid_source(path, (centres[0], centres[1], centres[2]), flat, time)


@dataclass(eq=False)
class CloudSource(Source):
    """Values at scattered points, joined by Delaunay's triangles or tetrahedra; hollows of the outline are filled."""

    def sample(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        names = list(names)
        low, high = self.bounds
        size = np.where(high - low > ROUNDING * np.max(high - low), high - low, 0.0)
        long = np.flatnonzero(size)
        if long.size < 2:
            raise InputError(self.path, "its points lie on a line: needs a grid, or points over a plane or a volume")
        columns = [self.arrays[name].reshape(len(self.points), -1) for name in names]
        scaled = (self.points[:, long] - low[long]) / size[long]
        try:
            between = LinearNDInterpolator(Delaunay(scaled), np.concatenate(columns, axis=1))
        except QhullError as error:
            raise InputError(
                self.path, f"its points cannot be joined to a mesh: {str(error).splitlines()[0]}"
            ) from error
        asked = (self.snapped(places)[:, long] - low[long]) / size[long]
        # a point on the hull's face is searched for in every simplex, one just inside is walked to
        asked = 0.5 + (1 - ROUNDING / 10) * (asked - 0.5)
        with threadpool_limits(1):  # threads for its thousands of 3 x 3 matrices would take 60 times as long
            values = np.asarray(between(asked), np.float64)
        parts = np.split(values, np.cumsum([column.shape[1] for column in columns])[:-1], axis=1)
        return {name: part.reshape(-1, *self.arrays[name].shape[1:]) for name, part in zip(names, parts)}


def from_points(path: str, points: Floats, arrays: Arrays, time: float = math.nan) -> Source:
    """A :class:`GridSource` if the points are all those of a rectilinear grid, in any order; a cloud if not."""
    axes, counts = [], []
    for column in points.T:
        unique = np.unique(column)
        # the same coordinate written with rounding is one coordinate
        apart = np.diff(unique, prepend=-math.inf) > ROUNDING * (unique[-1] - unique[0])
        apart[0] = True
        axes.append(unique[apart])
        counts.append(np.searchsorted(unique[apart], column + 0.5 * ROUNDING * (unique[-1] - unique[0]), "right") - 1)
    (x, y, z), (i, j, k) = axes, counts
    flat = i + x.size * (j + y.size * k)
    if x.size * y.size * z.size == len(points) and np.unique(flat).size == len(points):
        order = np.argsort(flat)
        return grid_source(path, (x, y, z), {name: values[order] for name, values in arrays.items()}, time)
    return CloudSource(path, arrays, points, time)


def joined(sources: Sequence[Source]) -> Source:
    """Parts of one time as one source: further arrays of the same points, or further points with the same arrays."""
    first, arrays = sources[0], dict(sources[0].arrays)
    points = first.points
    for other in sources[1:]:
        size = float(np.max(np.ptp(points, axis=0), initial=0.0))
        same = len(points) == len(other.points) and bool(
            np.allclose(points, other.points, rtol=0, atol=ROUNDING * size)
        )
        if same:
            arrays = {**other.arrays, **arrays}
        elif set(arrays) == set(other.arrays):
            points = np.concatenate([points, other.points])
            arrays = {name: np.concatenate([values, other.arrays[name]]) for name, values in arrays.items()}
        else:
            rule = f"cannot be joined with {first.path}: it has neither the same points nor the same arrays"
            raise InputError(other.path, f"{rule} ({', '.join(sorted(other.arrays))}; {', '.join(sorted(arrays))})")
    if len(points) > len(first.points):  # where parts meet, a point stands in both
        size = float(np.max(np.ptp(points, axis=0)))
        _, once = np.unique(np.round(points / (ROUNDING * size)), axis=0, return_index=True)
        points, arrays = points[once], {name: values[once] for name, values in arrays.items()}
    whole = from_points(first.path, points, arrays, first.time)
    whole.units = first.units
    return whole
