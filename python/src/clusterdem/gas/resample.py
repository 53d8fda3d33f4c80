"""A source onto the rectilinear grid of a gas field file: which grid, which planes, what of the gaps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..frame import Floats
from .axes import Placement
from .field import Axes, GasField
from .quantities import Recipe
from .revolve import mirrored, revolved, with_vector
from .sections import KeptFlux, corrected, kept_flux
from .sources import ROUNDING, GridSource, Source

Flags = NDArray[np.bool_]

MOST_POINTS = 200_000_000
SINGLE = 1e-7
"""Rounding of float32, in which meshes are often held, relative."""
NEAR_SIDE = 1e-9
"""Share of a length below which two numbers are one."""


@dataclass(frozen=True)
class Target:
    """The grid to make.

    Parameters
    ----------
    box : sequence of 4 or 6 floats, or None
        x0 x1 [y0 y1] z0 z1 (m); None for the source's own extent.
    count : sequence of int
        Points along x, z or x, y, z; empty for a grid by spacing, or for the source's own.
    spacing : sequence of float
        Wished spacing (m): one, or along x, z, or along x, y, z; rounded so that the ends are met.
    periodic : str
        Axes along which the box repeats: their last point is left out, being the first of the next period.
    slice_y : float or None
        Where an x–z plane is cut; None for the middle.
    average : int
        Planes along y whose mean is taken instead; 0 for a cut.
    """

    box: Sequence[float] | None = None
    count: Sequence[int] = ()
    spacing: Sequence[float] = ()
    periodic: str = ""
    slice_y: float | None = None
    average: int = 0

    @property
    def flat(self) -> bool:
        """Whether the result is an x–z plane."""
        wanted = len(self.count) or len(self.spacing)
        return self.slice_y is not None or self.average > 0 or wanted == 2 or (wanted == 1 and len(self.box or ()) == 4)

    def ends(self, low: Floats, high: Floats) -> list[tuple[float, float]]:
        """Where the grid begins and ends along x, y, z, for a source from ``low`` to ``high``."""
        given = [float(v) for v in self.box or ()]
        pairs = list(zip(given[::2], given[1::2]))
        own = [(float(a), float(b)) for a, b in zip(low, high)]
        if not pairs:
            return own
        return pairs if len(pairs) == 3 else [pairs[0], own[1], pairs[1]]


def _extent(source: Source, placement: Placement) -> tuple[Floats, Floats]:
    low, high = source.bounds
    corners = placement.placed(np.stack([low, high]))
    return corners.min(axis=0), corners.max(axis=0)


def _flat(low: Floats, high: Floats) -> list[bool]:
    """Along which axes a source has no extent, but for rounding."""
    return [bool(length <= ROUNDING * np.max(high - low)) for length in high - low]


def _axis(name: str, low: float, high: float, count: int, periodic: bool) -> Floats:
    if count < 1 or (count == 1 and high > low and name != "y"):
        raise InputError("--grid", f"needs at least 2 points along {name}")
    if count == 1:
        return np.array([(low + high) / 2])
    if not high > low:
        raise InputError("--box", f"needs {name}0 < {name}1 for {count} points, not {low:.6g} and {high:.6g}")
    return np.linspace(low, high, count, endpoint=not periodic)


def target_axes(target: Target, source: Source, placement: Placement) -> tuple[Axes, list[float]]:
    """The grid's axes and the planes along y that are sampled for each of its planes.

    Returns
    -------
    (x, y, z), list of float
        The list is empty unless the result is one x–z plane.
    """
    low, high = _extent(source, placement)
    ends = target.ends(low, high)
    count = list(target.count)
    if target.spacing:
        count = _counts(target, ends)
    if not count:
        raise InputError(source.path, "needs --grid or --spacing: " + _suggestion(source, low, high))
    plane = _flat(low, high)[1]
    flat = target.flat or plane
    if flat and len(count) == 3:
        count.pop(1)
    if len(count) == 2:
        count.insert(1, 1)
    if math.prod(count) > MOST_POINTS:
        raise InputError("--grid", f"{math.prod(count):,} points are more than {MOST_POINTS:,}")
    x, y, z = (_axis(a, *end, n, a in target.periodic and n > 1) for a, end, n in zip("xyz", ends, count))
    if not flat:
        return (x, y, z), []
    (y0, y1) = ends[1]
    planes = [target.slice_y if target.slice_y is not None else (y0 + y1) / 2]
    if plane:  # wherever the box has it
        planes = [float(low[1])]
    elif target.average:  # midpoint rule: second-order
        planes = [y0 + (k + 0.5) * (y1 - y0) / target.average for k in range(target.average)]
    return (x, np.array([float(np.mean(planes))]), z), planes


def _counts(target: Target, ends: list[tuple[float, float]]) -> list[int]:
    steps = list(target.spacing)
    if len(steps) == 1:
        steps *= 3
    elif len(steps) == 2:
        steps.insert(1, math.inf)
    lengths = [b - a for a, b in ends]
    if any(not h > 0 for h in steps) or any(length / h > 1e6 for length, h in zip(lengths, steps)):
        raise InputError("--spacing", "must be above zero, and no finer than a millionth of the box")
    counts = [max(round(length / h), 1) if length > 0 else 0 for length, h in zip(lengths, steps)]
    counts = [n + (a not in target.periodic) if n else 1 for a, n in zip("xyz", counts)]
    if target.flat:
        counts.pop(1)
    return counts


def _suggestion(source: Source, low: Floats, high: Floats) -> str:
    lengths = (high - low)[high - low > 0]
    h = float(np.prod(lengths) / len(source.points)) ** (1 / max(lengths.size, 1))
    size = " x ".join(f"{v:.4g}" for v in high - low)
    return f"its {len(source.points):,} points fill {size} m, so that --spacing {h:.2g} would be about as fine"


def _own_grid(source: GridSource, recipe: Recipe, placement: Placement) -> tuple[Axes, dict[str, Floats]]:
    """The source's own points, in the order of the box."""
    placed = placement.placed(source.points)
    order = np.lexsort((placed[:, 0], placed[:, 1], placed[:, 2]))
    names = recipe.names(source.path, source.arrays)
    return placement.axes(source.axes), {name: source.arrays[name][order] for name in names}


@dataclass(frozen=True)
class Making:
    """How a field is made of a source.

    Parameters
    ----------
    recipe : Recipe
        Which of its arrays are the gas.
    placement : Placement
        Where it lies in the box.
    target : Target
        The grid.
    fill : {"", "rest", "nearest"}
        What points get that the mesh does not cover: rest, or the values of the nearest point. "": rest within the
        extent of the mesh, where solids are; beyond it they are refused.
    no_slip : bool
        The velocity vanishes at walls, whatever the file says.
    mirror : sequence of str
        Ends of the source at which it is mirrored, such as ``x-``.
    revolve : str
        Its axis about which it is turned, "" for none.
    keep_flux : bool
        Sections are scaled to the flux of the source.
    """

    recipe: Recipe
    placement: Placement
    target: Target
    fill: str = ""
    no_slip: bool = False
    mirror: Sequence[str] = ()
    revolve: str = ""
    keep_flux: bool = False

    def prepared(self, source: Source) -> tuple[Source, Recipe]:
        """The source with what the options say of it as a whole."""
        names = self.recipe.velocity_names(source.path, source.arrays)
        recipe = self.recipe
        if self.no_slip:
            if not source.walls:
                rule = (
                    f"noslip: {source.path} does not tell which of its faces are walls (OpenFOAM and Fluent cases do)"
                )
                raise InputError("--wall", rule)
            source.no_slip = frozenset(names)
        if (self.mirror or self.revolve) and len(names) == 3:
            source, one = with_vector(source, names)
            recipe = replace(recipe, velocity=(one,))
        if self.revolve:
            source = revolved(source, self.revolve)
        return mirrored(source, self.mirror), recipe


def resample(source: Source, making: Making) -> tuple[GasField, KeptFlux | None]:
    """Make a gas field of a source.

    Returns
    -------
    GasField, KeptFlux or None
        The flux is that before any correction; None where the grid is the source's own.
    """
    source, recipe = making.prepared(source)
    placement, target = making.placement, making.target
    own = target == Target(periodic=target.periodic)  # nothing asked for
    flat_x, flat_y, flat_z = _flat(*_extent(source, placement))
    if flat_z and not (flat_x or flat_y):
        raise InputError(source.path, "lies in a plane of constant z; if its y is upward, turn it: --axes x,-z,y")
    names = recipe.names(source.path, source.arrays)
    periods = _periods(target, source, placement)
    between = _continued(source, periods, placement)
    if own and isinstance(source, GridSource):
        axes, samples = _own_grid(source, recipe, placement)
        planes: list[float] = []
    else:
        axes, planes = target_axes(target, source, placement)
        samples = _at_planes(between, placement, periods, axes, planes, names)
    places = _points(axes)
    solid = _uncovered(
        source, samples, placement.back(_wrapped(places, periods, between, placement)), places, making.fill
    )
    if solid is not None:
        moving = recipe.moving(source.path, source.arrays) if making.fill != "nearest" else set()
        samples = _filled(source, samples, placement.back(places), solid, moving)
    gas = _field(source, recipe, placement, axes, samples, None if making.fill == "nearest" else solid)
    if own and isinstance(source, GridSource):
        return gas, None
    still = np.abs(gas["velocity"]) < SINGLE * np.max(np.abs(gas["velocity"]))
    gas["velocity"][still] = 0.0  # at walls, but for rounding

    def velocity(finer: Axes) -> Floats:
        found = _at_planes(between, placement, periods, finer, planes, names, means=True)
        at_rest = {name: np.nan_to_num(values) for name, values in found.items()}
        return _field(source, recipe, placement, finer, at_rest, None)["velocity"]

    kept = kept_flux(gas, velocity, making.keep_flux)
    return (corrected(gas, kept) if making.keep_flux else gas), kept


def _field(
    source: Source, recipe: Recipe, placement: Placement, axes: Axes, samples: dict[str, Floats], solid: Flags | None
) -> GasField:
    flat: dict[str, Floats] = recipe.gas(source.path, samples, placement)
    shape = tuple(axis.size for axis in reversed(axes))

    def table(values: Any) -> Any:
        return np.ascontiguousarray(np.moveaxis(values.reshape(*shape, *values.shape[1:]), (0, 1, 2), (2, 1, 0)))

    arrays = {name: table(values) for name, values in flat.items()}
    return GasField(axes, arrays, source.time, source.path, None if solid is None else table(solid))


def _at_planes(
    source: Source,
    placement: Placement,
    periods: dict[int, float],
    axes: Axes,
    planes: list[float],
    names: list[str],
    means: bool = False,
) -> dict[str, Floats]:
    """Samples at a grid, or the mean over planes of it; or what has the flux of the source."""
    parts = [_points(axes, plane) for plane in planes] or [_points(axes)]
    ask = source.means if means else source.sample
    wholes = [ask(placement.back(_wrapped(p, periods, source, placement)), names) for p in parts]
    return {name: _mean([whole[name] for whole in wholes]) for name in names}


def _points(axes: Axes, plane: float | None = None) -> Floats:
    """All points of the grid, x fastest, shape (N, 3)."""
    y = axes[1] if plane is None else np.array([plane])
    mesh = np.meshgrid(axes[2], y, axes[0], indexing="ij")
    return np.stack([m.ravel() for m in reversed(mesh)], axis=1)


def _periods(target: Target, source: Source, placement: Placement) -> dict[int, float]:
    """Length of the box along each periodic axis (m)."""
    ends = target.ends(*_extent(source, placement))
    return {k: ends[k][1] - ends[k][0] for k, a in enumerate("xyz") if a in target.periodic and ends[k][1] > ends[k][0]}


def _continued(source: Source, periods: dict[int, float], placement: Placement) -> Source:
    """A grid that ends up to a cell short of its period, closed by its first plane; other sources as they are."""
    for k, period in periods.items():
        if not isinstance(source, GridSource):
            break
        source = source.closed(placement.order[k], period / placement.factor)
    return source


def _wrapped(places: Floats, periods: dict[int, float], source: Source, placement: Placement) -> Floats:
    """Along periodic axes, points beyond the source taken back into it by whole periods."""
    low, high = _extent(source, placement)
    places = places.copy()
    for k, period in periods.items():
        margin = NEAR_SIDE * period
        beyond = places[:, k] > high[k] + margin
        places[beyond, k] -= np.ceil((places[beyond, k] - high[k] - margin) / period) * period
        short = places[:, k] < low[k] - margin
        places[short, k] += np.ceil((low[k] - margin - places[short, k]) / period) * period
    return places


def _mean(planes: list[Floats]) -> Floats:
    """Mean over the planes that have a value; NaN where none has."""
    if len(planes) == 1:
        return planes[0]
    total, count = np.zeros_like(planes[0]), np.zeros_like(planes[0])
    for values in planes:
        there = np.isfinite(values)
        total += np.where(there, values, 0.0)
        count += there
    return np.divide(total, count, out=np.full_like(total, np.nan), where=count > 0)


def _uncovered(source: Source, samples: dict[str, Floats], back: Floats, places: Floats, fill: str) -> Flags | None:
    """Which points have no value; an error where they can be no solids."""
    gaps: Flags = ~np.all([np.isfinite(v).reshape(len(v), -1).all(axis=1) for v in samples.values()], axis=0)
    if not gaps.any():
        return None
    low, high = source.bounds
    margin = ROUNDING * float(np.max(high - low))
    thin = high - low <= margin
    within = np.all(thin | ((back >= low - margin) & (back <= high + margin)), axis=1)
    whole = all(np.isfinite(source.arrays[name]).all() for name in samples)
    refused = gaps & ~within if whole else gaps
    if fill == "" and refused.any():
        where = places[refused]
        spans = ", ".join(f"{a} {lo:.6g} to {hi:.6g}" for a, lo, hi in zip("xyz", where.min(axis=0), where.max(axis=0)))
        first = ", ".join(f"{v:.6g}" for v in where[0])
        rule = (
            f"{int(refused.sum()):,} of {len(places):,} points lie outside its mesh or have no number ({spans} m; "
            f"the first at {first}): another --box, --shift or --length-unit, or --fill rest or nearest"
        )
        raise InputError(source.path, rule)
    return gaps


def _filled(
    source: Source, samples: dict[str, Floats], back: Floats, gaps: Flags, moving: set[str]
) -> dict[str, Floats]:
    """Nothing moves at the gaps; other values are those of the nearest points."""
    rest = [name for name in samples if name not in moving]
    nearest = source.nearest(back[gaps], rest) if rest else {}
    for name in samples:
        samples[name] = samples[name].copy()
        samples[name][gaps] = nearest.get(name, 0.0)
    return samples
