"""How far a gas field is from conserving mass: its discrete divergence."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats
from .field import GasField

AT_REST = 1e-6
"""Share of the highest speed below which a point is at rest, as at walls, but for rounding."""
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Divergence:
    """Divergence of a field, and what it amounts to.

    Parameters
    ----------
    map : ndarray, shape (nx, ny, nz)
        div u, or div(rho u) / mean rho where the density is known (1/s).
    inner : ndarray of bool, shape (nx, ny, nz)
        Points that are counted: neither at rest, in solids and on walls, nor beside such, where the grid cannot follow.
    rms, most : float
        Root mean square and largest magnitude (1/s).
    where : int
        Flat index of the largest.
    """

    map: Floats
    inner: Flags
    rms: float
    most: float
    where: int


def _inner(gas: GasField) -> Flags:
    """Points that neither are at rest, as walls and solids are, nor stand beside one that is."""
    rest: Flags = gas.speed <= AT_REST * gas.speed.max()
    near = rest.copy()
    for k in range(3):
        for step in (1, -1):
            other = np.roll(rest, step, axis=k)
            edge: list[slice | int] = [slice(None)] * 3
            edge[k] = 0 if step == 1 else -1
            other[tuple(edge)] = False
            near |= other
    return np.logical_not(near)


def divergence(gas: GasField) -> Divergence:
    """Central differences on the grid's own spacing, one-sided at its ends: second-order with 3 points or more."""
    flux = gas["velocity"]
    if "density" in gas:
        flux = flux * (gas["density"] / gas["density"].mean())[..., None]
    total = np.zeros(gas.shape)
    for k, axis in enumerate(gas.axes):
        if axis.size > 1:
            total += np.gradient(flux[..., k], axis, axis=k, edge_order=2 if axis.size > 2 else 1)
    inner = _inner(gas)
    where = int(np.argmax(np.where(inner, np.abs(total), 0.0)))
    rms = float(np.sqrt(np.mean(total[inner] ** 2))) if inner.any() else 0.0
    return Divergence(total, inner, rms, float(np.abs(total).flat[where]), where)
