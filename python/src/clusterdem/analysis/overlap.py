"""Exact shares of a sphere's volume in the cells of an x–z grid, in closed form.

A cell runs through the whole depth y, so its share follows from G(a, b), the volume of a unit sphere where
x > a and z > b, at the cell's four corners. G is the divergence theorem on that piece: a third of its spherical
area minus the distances of its two flat faces times their areas; the spherical area is Gauss–Bonnet's.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats

Integers = NDArray[np.int64]


def cap(a: Floats) -> Floats:
    """Volume of a unit sphere where x > a, for a in [-1, 1]."""
    return np.pi / 3 * (2 + a) * (1 - a) ** 2


def edge_volume(a: Floats, b: Floats) -> Floats:
    """G(a, b): volume of a unit sphere where x > a and z > b; any shape.

    Parameters
    ----------
    a, b : ndarray
        Distances of the two planes from the centre, in radii; beyond ±1 they miss the sphere.
    """
    a, b = np.clip(a, -1.0, 1.0), np.clip(b, -1.0, 1.0)
    miss = np.where((a > 0) & (b > 0), 0.0, np.where(a > 0, cap(a), np.where(b > 0, cap(b), 0.0)))
    both = (a <= 0) & (b <= 0)
    miss = np.where(both, 4 * np.pi / 3 - cap(-a) - cap(-b), miss)
    cuts = a * a + b * b < 1.0
    # where the planes' common edge misses the sphere the formula below is not used
    p, q = np.where(cuts, a, 0.0), np.where(cuts, b, 0.0)
    ra, rb, s = np.sqrt(1 - p * p), np.sqrt(1 - q * q), np.sqrt(1 - p * p - q * q)
    half_a, half_b = np.arctan2(s, q), np.arctan2(s, p)  # half angles of the two arcs
    corner = np.arctan2(s, p * q)
    area = 2 * (corner - p * half_a - q * half_b)
    flat = p * (ra * ra * half_a - q * s) + q * (rb * rb * half_b - p * s)
    return np.where(cuts, (area - flat) / 3, miss)


def overlap_weights(
    x: Floats,
    z: Floats,
    radius: Floats,
    spacing: tuple[float, float],
    shape: tuple[int, int],
    periodic: tuple[bool, bool],
) -> tuple[Integers, Integers, Integers, Floats]:
    """Cells that each sphere covers and the share of its volume in each.

    Parameters
    ----------
    x, z, radius : ndarray, shape (N,)
        Centres from the grid's lower corner, and radii (m).
    spacing : (float, float)
        Cell widths (m).
    shape : (int, int)
        Cells along x and z.
    periodic : (bool, bool)
        Along a periodic axis shares wrap around, along another the outermost cell takes what sticks out.

    Returns
    -------
    ix, iz : ndarray of int, shape (M,)
        Cells.
    sphere : ndarray of int, shape (M,)
        Index of the sphere.
    weight : ndarray, shape (M,)
        Shares; those of one sphere sum to 1.
    """
    (dx, dz), (nx, nz) = spacing, shape
    if not len(x):
        return (*np.empty((3, 0), np.int64), np.empty(0))
    i0, k0 = np.floor((x - radius) / dx).astype(np.int64), np.floor((z - radius) / dz).astype(np.int64)
    width = np.floor((x + radius) / dx).astype(np.int64) - i0 + 1
    height = np.floor((z + radius) / dz).astype(np.int64) - k0 + 1
    parts: list[tuple[Integers, Integers, Integers, Floats]] = []
    spans = np.stack([width, height], axis=1)
    for w, h in np.unique(spans, axis=0):
        sphere = np.flatnonzero((width == w) & (height == h))
        a = ((i0[sphere, None] + np.arange(w + 1)) * dx - x[sphere, None]) / radius[sphere, None]
        b = ((k0[sphere, None] + np.arange(h + 1)) * dz - z[sphere, None]) / radius[sphere, None]
        corner = edge_volume(a[:, :, None], b[:, None, :])
        share = corner[:, :-1, :-1] - corner[:, 1:, :-1] - corner[:, :-1, 1:] + corner[:, 1:, 1:]
        share = np.clip(share, 0.0, None)
        share /= share.sum(axis=(1, 2), keepdims=True)
        ix = np.broadcast_to(i0[sphere, None, None] + np.arange(w)[None, :, None], share.shape)
        iz = np.broadcast_to(k0[sphere, None, None] + np.arange(h)[None, None, :], share.shape)
        owner = np.broadcast_to(sphere[:, None, None], share.shape)
        parts.append((ix.ravel(), iz.ravel(), owner.ravel(), share.ravel()))
    ix, iz, sphere, weight = (np.concatenate(group) for group in zip(*parts))
    ix = ix % nx if periodic[0] else np.clip(ix, 0, nx - 1)
    iz = iz % nz if periodic[1] else np.clip(iz, 0, nz - 1)
    return ix, iz, sphere, weight


def mean_square_share(
    radius: Floats, spacing: tuple[float, float], shape: tuple[int, int], periodic: tuple[bool, bool]
) -> Floats:
    """Expected sum over cells of the squares of a sphere's shares, for a sphere anywhere by chance; shape (N,).

    Two random points of the sphere share a cell with the probability <(1 − |ξ|/dx)(1 − |ζ|/dz)>, (ξ, ζ) their distance
    along the two axes, each factor 0 below 0. (At a side that does not repeat the outermost cells take what sticks out: of
    n cells in a row then only n − 1 borders part two points.) Their distance s in radii has the density 3s² − 9s³/4 + 3s⁵/16 on
    (0, 2) and any direction, with <s> = 36/35, <s²> = 6/5 and <|u_x||u_z|> = 2/(3π); a sphere no wider than a cell gives

        1 − 18/35 (r/dx + r/dz) + 4/(5π) r²/(dx dz)

    and a wider one, or one that meets its own image, is integrated by Gauss–Legendre's rule.

    Parameters
    ----------
    radius : ndarray, shape (N,)
        Radii (m).
    spacing : (float, float)
        Cell widths (m).
    shape : (int, int)
        Cells along both axes.
    periodic : (bool, bool)
        Whether shares wrap around.
    """
    (dx, dz), (nx, nz) = spacing, shape
    a, b = (radius / width * (1 if wraps else 1 - 1 / count) for width, count, wraps in zip(spacing, shape, periodic))
    closed: Floats = 1 - 18 / 35 * (a + b) + 4 / (5 * np.pi) * a * b
    wide = 2 * radius > min(dx, dz)
    if (periodic[0] and nx <= 2) or (periodic[1] and nz <= 2):
        wide = np.ones(len(radius), bool)
    if not wide.any():
        return closed
    low, high = float(radius[wide].min()), float(radius[wide].max())
    knots = np.linspace(low, high, 1 if high - low <= 1e-6 * high else 65)
    found = np.array([_same_cell(knot, list(zip(spacing, shape, periodic))) for knot in knots])
    closed[wide] = np.interp(radius[wide], knots, found)
    return closed


def _same_cell(radius: float, sides: Sequence[tuple[float, int, bool]]) -> float:
    """Probability that two random points of a sphere lie in one cell; (width, cells, whether it repeats) of both sides."""
    nodes, weights = np.polynomial.legendre.leggauss(48)
    s = nodes + 1
    w_s = weights * (3 * s**2 - 9 / 4 * s**3 + 3 / 16 * s**5)
    mu, w_mu = (nodes + 1) / 2, weights / 2
    phi, w_phi = np.pi / 4 * (nodes + 1), weights / 2
    across = np.sqrt(1 - mu**2)[:, None]
    together = np.ones((len(s), len(mu), len(phi)))
    for direction, (width, cells, repeats) in zip((across * np.cos(phi), across * np.sin(phi)), sides):
        apart = radius * s[:, None, None] * direction / width
        if cells == 1:
            continue
        if repeats:
            together *= sum(np.maximum(1 - np.abs(apart - cells * image), 0) for image in (-1, 0, 1))
        else:
            together *= ((cells - 2) * np.maximum(1 - apart, 0) + np.maximum(2 - apart, 0)) / cells
    return float(np.einsum("smp,s,m,p", together, w_s, w_mu, w_phi))
