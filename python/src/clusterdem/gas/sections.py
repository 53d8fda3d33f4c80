"""What flows through sections of a gas field: whether it conserves mass, and whether resampling kept the flux."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..frame import Floats
from .field import Axes, GasField

REFINED = 32, 8
"""How many times finer than the grid a source is asked for its own flux: along the one axis of a section, and two."""
LEAST_FLUX = 1e-3
"""Share of the largest flux below which a section's is not corrected: it is a difference of larger ones."""


def _across(values: Floats, axes: Axes, along: int) -> Floats:
    """Integral over the sections across an axis (trapezoidal rule), one value for each; 1 m for a uniform axis."""
    for k in (2, 1, 0):
        if k != along and axes[k].size > 1:
            values = np.asarray(np.trapezoid(values, axes[k], axis=k))
        elif k != along:
            values = np.take(values, 0, k)
    return values


def _momentum(gas: GasField) -> Floats:
    """Velocity, times density over its mean where it is known."""
    if "density" not in gas:
        return gas["velocity"]
    share: Floats = gas["density"] / gas["density"].mean()
    return gas["velocity"] * share[..., None]


@dataclass(frozen=True)
class Balance:
    """How far a field is from conserving mass, over whole sections.

    Parameters
    ----------
    change : float
        Largest change of the flux between two sections, less what passes the sides between, over the largest flux.
    axis : str
        Along which axis.
    place : float
        The section with the largest change from the first (m).
    """

    change: float
    axis: str
    place: float


def balance(gas: GasField) -> Balance:
    """Gauss's theorem between the first section across each axis and all others.

    What a wall layer is off by at one place is small beside the flux through the section, and solids have none; a plane
    cut out of a three-dimensional flow, or gas that appears and vanishes, is seen.
    """
    flow = _momentum(gas)
    worst = Balance(0.0, "z", float(gas.axes[2][0]))
    long = [k for k in range(3) if gas.axes[k].size > 1]
    passing = {k: float(np.max(_across(np.abs(flow[..., k]), gas.axes, k))) for k in long}
    largest = max(passing.values(), default=0.0)
    if largest == 0:
        return worst
    for k in sorted(long, key=lambda k: -passing[k]):  # the main direction first: it is named where others are as bad
        axis = gas.axes[k]
        through = _across(flow[..., k], gas.axes, k)
        aside = np.zeros(axis.size)
        for other in range(3):
            if other != k and gas.axes[other].size > 1:
                ends = [np.take(flow[..., other], [end], axis=other) for end in (-1, 0)]
                aside += _across(ends[0] - ends[1], _without(gas.axes, other), k)
        lost = np.concatenate([[0.0], np.cumsum(0.5 * (aside[1:] + aside[:-1]) * np.diff(axis))])
        change = through - through[0] + lost
        span = float(np.ptp(change)) / largest
        if span > worst.change * (1 + 1e-6):
            worst = Balance(span, "xyz"[k], float(axis[np.argmax(np.abs(change))]))
    return worst


def _without(axes: Axes, gone: int) -> Axes:
    x, y, z = (np.zeros(1) if k == gone else axis for k, axis in enumerate(axes))
    return (x, y, z)


@dataclass(frozen=True)
class KeptFlux:
    """Flux through the two ends of a field along its main axis, on the grid and in the source.

    Parameters
    ----------
    axis : str
        Along which the most flows.
    places : ndarray, shape (n,)
        Where the sections lie (m).
    grid, source : ndarray, shape (n,)
        Flux through each (m³/s; m²/s where the field is uniform along y).
    """

    axis: str
    places: Floats
    grid: Floats
    source: Floats

    @property
    def off(self) -> float:
        """Largest relative difference of sections through which something flows."""
        least = LEAST_FLUX * float(np.max(np.abs(self.source), initial=0.0))
        there = np.abs(self.source) > least
        return float(np.max(np.abs(self.grid / np.where(there, self.source, 1.0) - 1)[there], initial=0.0))


Velocity = Callable[[Axes], Floats]
"""A source's velocity (m/s) at all points of a grid, shape (nx, ny, nz, 3); at rest where it has none."""


def _finer(axis: Floats, times: int) -> Floats:
    if axis.size < 2:
        return axis
    parts = axis[:-1, None] + np.diff(axis)[:, None] * np.arange(times) / times
    return np.append(parts.ravel(), axis[-1])


def kept_flux(gas: GasField, velocity: Velocity, everywhere: bool = False) -> KeptFlux:
    """Compare with the source on finer sections: the first and the last, or all."""
    means = [abs(float(np.mean(_across(gas["velocity"][..., k], gas.axes, k)))) for k in range(3)]
    sizes = [axis.size > 1 for axis in gas.axes]
    k = int(np.argmax([m if s else -1.0 for m, s in zip(means, sizes)]))
    which = np.arange(gas.axes[k].size) if everywhere else np.array([0, gas.axes[k].size - 1])
    grid = _across(gas["velocity"][..., k], gas.axes, k)[which]
    times = REFINED[sum(sizes) > 2]
    source = []
    for at in gas.axes[k][which]:
        x, y, z = (np.array([at]) if i == k else _finer(axis, times) for i, axis in enumerate(gas.axes))
        source.append(float(_across(velocity((x, y, z))[..., k], (x, y, z), k)[0]))
    return KeptFlux("xyz"[k], gas.axes[k][which], grid, np.array(source))


def corrected(gas: GasField, kept: KeptFlux) -> GasField:
    """The component along the main axis scaled in each section, so that its flux is the source's.

    Walls stay at rest. Sections through which next to nothing flows stay as they are.
    """
    k = "xyz".index(kept.axis)
    least = LEAST_FLUX * float(np.max(np.abs(kept.source), initial=0.0))
    sound = (np.abs(kept.source) > least) & (np.abs(kept.grid) > least)
    factor = np.where(sound, kept.source / np.where(sound, kept.grid, 1.0), 1.0)
    velocity = gas["velocity"].copy()
    velocity[..., k] *= factor.reshape([-1 if i == k else 1 for i in range(3)])
    return replace(gas, arrays={**gas.arrays, "velocity": velocity})
