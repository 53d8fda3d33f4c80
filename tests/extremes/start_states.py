"""Where clusters are at the start: pairs about to meet, lattices, crowds."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import VOIDAGE, Clusters


def diameter(d_p: float, n) -> np.ndarray:
    return d_p * np.cbrt(np.asarray(n, dtype=float) / (1.0 - VOIDAGE))


def meeting(
    draw: Draw,
    d: tuple[float, float],
    n: tuple[int, int],
    m: tuple[float, float],
    box: float,
    speed: float,
    gap: float,
    offset: float,
    planar: bool = False,
) -> Clusters:
    """Two clusters that approach each other along a random line anywhere in a periodic cubic box.

    `offset` (< 1) is the sideways distance over the sum of radii; momentum is zero.
    """
    along = draw.direction(planar)
    aside = np.cross(along, [0.0, 1.0, 0.0])
    if np.linalg.norm(aside) < 1e-3:
        aside = np.cross(along, [1.0, 0.0, 0.0])
    aside /= np.linalg.norm(aside)
    touching = 0.5 * (d[0] + d[1])
    b = offset * touching
    apart = np.sqrt(touching**2 - b**2) + gap
    middle = draw.random.uniform(0.0, box, 3)
    if planar:
        middle[1] = 0.5 * box
    share = m[1] / (m[0] + m[1])
    x = np.array([middle - share * (apart * along + b * aside), middle + (1 - share) * (apart * along + b * aside)])
    v = np.array([share * speed * along, (share - 1.0) * speed * along])
    return Clusters(np.array(n), np.mod(x, box), v)


def lattice(columns: int, rows: int, spacing: float, y: float) -> tuple[np.ndarray, float, float]:
    """Square lattice in the plane y, and the periodic box that it fills."""
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    x = np.column_stack([(i.ravel() + 0.5) * spacing, np.full(i.size, y), (j.ravel() + 0.5) * spacing])
    return x, columns * spacing, rows * spacing


def crowd(draw: Draw, d_p: float, n: np.ndarray, speed: float, dilution: float, y: float, least: float = 0.0):
    """Clusters on a shaken lattice, no two in contact, moving at random in the plane; the box's side."""
    largest = float(diameter(d_p, n.max()))
    side = max(int(np.ceil(np.sqrt(len(n)))), int(np.ceil(least / (dilution * largest))))
    spacing = dilution * largest
    x, length, _ = lattice(side, side, spacing, y)
    x = x[draw.random.permutation(len(x))[: len(n)]]
    shake = 0.49 * (spacing - largest)
    x[:, [0, 2]] += draw.random.uniform(-shake, shake, (len(n), 2))
    v = np.zeros((len(n), 3))
    v[:, [0, 2]] = draw.random.normal(0.0, speed, (len(n), 2))
    return Clusters(n, x, v), length
