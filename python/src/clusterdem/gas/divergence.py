"""How far a gas field is from conserving mass: its discrete divergence."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..frame import Floats
from .field import GasField


@dataclass(frozen=True)
class Divergence:
    """Divergence of a field, and what it amounts to.

    Parameters
    ----------
    map : ndarray, shape (nx, ny, nz)
        div u, or div(rho u) / mean rho where the density is known (1/s).
    rms, most : float
        Root mean square and largest magnitude (1/s).
    where : int
        Flat index of the largest.
    relative : float
        rms · L / U with L the longest extent and U the r.m.s. speed: 1 means that the gas doubles on its way.
    """

    map: Floats
    rms: float
    most: float
    where: int
    relative: float


def divergence(gas: GasField) -> Divergence:
    """Central differences on the grid's own spacing, one-sided at its ends: second-order with 3 points or more."""
    flux = gas["velocity"]
    if "density" in gas:
        flux = flux * (gas["density"] / gas["density"].mean())[..., None]
    total = np.zeros(gas.shape)
    for k, axis in enumerate(gas.axes):
        if axis.size > 1:
            total += np.gradient(flux[..., k], axis, axis=k, edge_order=2 if axis.size > 2 else 1)
    where = int(np.argmax(np.abs(total)))
    rms = float(np.sqrt(np.mean(total**2)))
    speed = float(np.sqrt(np.mean(gas.speed**2)))
    length = max(float(axis[-1] - axis[0]) for axis in gas.axes)
    relative = rms * length / speed if speed > 0 else 0.0
    return Divergence(total, rms, float(np.abs(total).flat[where]), where, relative)
