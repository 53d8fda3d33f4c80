"""From values in cells to values at points, second-order everywhere, also at walls.

VTK's own filter gives a point the mean of the cells around it. At a wall these all lie on one side, so that the value
there is that half a cell inside: first-order, and a shear layer at the wall loses a part of its velocity. Here each
cell first gets its gradient, by least squares over all cells that share a point with it, and the mean is over what each
cell's linear function gives at the point: exact for linear fields on any mesh.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from ..frame import Floats

Ints = NDArray[np.int64]

FLAT = 1e-6
"""Directions along which a cell's neighbours spread less than this share of their spread get no gradient."""


def continued(places: Floats, centres: Floats, cell: Ints, place: Ints, values: Floats, gradient: Floats) -> Floats:
    """Values at places: the mean of what the linear functions of the cells around give there.

    Parameters
    ----------
    places, centres : ndarray, shape (P, 3) and (C, 3)
        Points of the mesh or middles of its facets, and centres of its cells.
    cell, place : ndarray of int, shape (M,)
        Which cell has which place: one entry for each pair.
    values : ndarray, shape (C, k)
        Values in cells.
    gradient : ndarray, shape (C, 3, k)
        Their gradients.

    Returns
    -------
    ndarray, shape (P, k); NaN at places of no cell
    """
    away = places[place] - centres[cell]
    count = np.bincount(place, minlength=len(places))
    result = np.full((len(places), values.shape[1]), np.nan)
    used = count > 0
    for k in range(values.shape[1]):
        there = values[cell, k] + np.einsum("mi,mi->m", gradient[cell, :, k], away)
        if values.shape[1] == 1 and values.min() >= 0:  # what is positive stays so: this cell goes on as it is
            there = np.where(there <= 0, values[cell, k], there)
        result[used, k] = np.bincount(place, there, len(places))[used] / count[used]
    return result


def gradients(points: Floats, centres: Floats, cell: Ints, point: Ints, values: Floats) -> Floats:
    """Least-squares gradient of values (C, k) in cells, shape (C, 3, k); ``cell`` and ``point`` as above.

    Neighbours weigh as many times as they share points. Sums over the cells around each point are made once, relative
    to the point (no cancellation), and then gathered by the cells that have it: nothing grows with pairs of cells.
    """
    cells, parts = values.shape
    near = centres[cell] - points[point]  # of each corner: centre as seen from the point
    around = len(points)

    def at_points(v: Floats) -> Floats:
        return np.bincount(point, v, around).astype(np.float64, copy=False)

    def at_cells(v: Floats) -> Floats:
        return np.bincount(cell, v, cells).astype(np.float64, copy=False)

    m0 = at_points(np.ones(len(cell)))
    m1 = np.stack([at_points(near[:, i]) for i in range(3)], axis=1)
    matrix = np.empty((cells, 3, 3))
    for i in range(3):
        for j in range(i, 3):
            m2 = at_points(near[:, i] * near[:, j])
            # sum over the cells n around the point of (x_n - x_c)_i (x_n - x_c)_j, x_c being this cell's centre
            corner = m2[point] - m1[point, i] * near[:, j] - near[:, i] * m1[point, j]
            matrix[:, i, j] = matrix[:, j, i] = at_cells(corner + m0[point] * near[:, i] * near[:, j])
    right = np.empty((cells, 3, parts))
    for k in range(parts):
        own = values[cell, k]
        f0 = at_points(own)
        for i in range(3):
            f1 = at_points(near[:, i] * own)
            corner = f1[point] - near[:, i] * f0[point] - own * (m1[point, i] - m0[point] * near[:, i])
            right[:, i, k] = at_cells(corner)
    with threadpool_limits(1):  # threads do not pay for 3 x 3 matrices
        return np.linalg.pinv(matrix, rcond=FLAT, hermitian=True) @ right
