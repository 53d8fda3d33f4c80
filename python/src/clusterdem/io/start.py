"""Start positions: clusters of one size at random in the middle plane of the slab, no two overlapping."""

from __future__ import annotations

from math import ceil
from pathlib import Path

import numpy as np

from ..errors import ArgumentError
from ..frame import Floats
from .output import write_text

D_P = 1e-4
"""Diameter of a primary particle (m)."""
VOIDAGE = 0.5
"""Between the particles of a cluster."""
TRIES = 10_000
"""Places tried for a cluster before the box counts as full."""


def diameter(n: float, d_p: float = D_P, voidage: float = VOIDAGE) -> float:
    """Equivalent diameter of a cluster of n particles (m)."""
    return float(d_p * np.cbrt(n / (1 - voidage)))


def place(count: int, d: float, lengths: tuple[float, float], seed: int) -> Floats:
    """Centres of ``count`` discs of diameter d in a box that is periodic along both lengths, one after the other.

    Parameters
    ----------
    count : int
        How many.
    d : float
        Diameter, the least distance of two centres (m).
    lengths : (float, float)
        Of the box along x and z (m).
    seed : int
        The same seed gives the same places.

    Returns
    -------
    array of shape (count, 2)
        x and z (m).
    """
    # cells not larger than d: whoever is nearer than d lies in a `near` cell
    shape = [max(1, ceil(length / d)) for length in lengths]
    sides = [length / n for length, n in zip(lengths, shape)]
    near = [  # each cell once, where the box has but few
        range(-min(ceil(d / side), (n - 1) // 2), min(ceil(d / side), n // 2) + 1) for side, n in zip(sides, shape)
    ]
    offsets = [(a, b) for a in near[0] for b in near[1]]
    taken: dict[tuple[int, int], list[tuple[float, float]]] = {}
    random = np.random.default_rng(seed)

    def free(x: float, z: float, i: int, k: int) -> bool:
        for a, b in offsets:
            for other_x, other_z in taken.get(((i + a) % shape[0], (k + b) % shape[1]), ()):
                dx = abs(x - other_x)
                dz = abs(z - other_z)
                dx = min(dx, lengths[0] - dx)
                dz = min(dz, lengths[1] - dz)
                if dx * dx + dz * dz < d * d:
                    return False
        return True

    centres = np.empty((count, 2))
    for number in range(count):
        for _ in range(TRIES):
            x, z = (float(u) for u in random.random(2) * lengths)
            i, k = min(int(x / sides[0]), shape[0] - 1), min(int(z / sides[1]), shape[1] - 1)
            if free(x, z, i, k):
                taken.setdefault((i, k), []).append((x, z))
                centres[number] = x, z
                break
        else:
            raise ArgumentError(
                "count", f"no room for cluster {number + 1} of {count} after {TRIES} tries: fewer, or a larger box"
            )
    return centres


def write_start(
    path: str | Path, count: int, n: int, box: tuple[float, float, float], seed: int, rho_p: float = 2000.0
) -> Path:
    """Write a data file that LAMMPS (atom styles sphere and cluster) and LIGGGHTS (granular) read alike.

    Parameters
    ----------
    path : str or Path
        The file.
    count, n : int
        Clusters, and particles in each.
    box : (float, float, float)
        Lengths of the box from 0 (m); clusters lie in the middle of y.
    seed : int
        Of the places.
    rho_p : float, optional
        Density of the primary particles (kg/m³).
    """
    d = diameter(n)
    if min(box[0], box[2]) < 2 * d:
        raise ArgumentError("box", f"the box must be at least two diameters ({2 * d:.3g} m) long along x and z")
    lines = [f"clusters of {n} particles, seed {seed}", "", f"{count} atoms", "1 atom types"]
    lines += [f"0 {length!r} {axis}lo {axis}hi" for axis, length in zip("xyz", box)]
    lines += ["", "Atoms", ""]
    density = rho_p * (1 - VOIDAGE)
    lines += [
        f"{number} 1 {d!r} {density!r} {x!r} {box[1] / 2!r} {z!r}"
        for number, (x, z) in enumerate(place(count, d, (box[0], box[2]), seed).tolist(), start=1)
    ]
    return write_text(path, "\n".join(lines) + "\n")
