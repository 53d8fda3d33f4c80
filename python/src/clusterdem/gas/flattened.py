"""Meshes one cell thick, as what they stand for: a plane (OpenFOAM: between ``empty`` patches), or a body of revolution
(between ``wedge`` patches).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats
from .cells import CellSource, Patch
from .facets import Facets, Ints
from .revolve import Axis, Revolved
from .sources import ROUNDING, Source


def one_layer(source: CellSource) -> Source:
    """The plane or the body of revolution of a mesh one cell thick; other meshes as they are.

    A plane is made where all points lie in two planes across an axis, and nothing is known at these.
    """
    facets = source.facets
    if facets.flat or source.not_in_cells:
        return source
    wedges = [patch for patch in source.patches if patch.kind == "wedge" and len(patch.faces)]
    if len(wedges) == 2 and len(wedges[0].faces) == facets.cells:
        return _revolved(source, *wedges)
    low, high = source.bounds
    rounding = ROUNDING * float(np.max(high - low))
    for k in range(3):
        lower, upper = (np.abs(facets.points[:, k] - end[k]) <= rounding for end in (low, high))
        if not np.all(lower | upper) or _known_at(source, lower, upper):
            continue
        side = np.flatnonzero(np.bincount(facets.facet, ~lower[facets.corners], len(facets.cell)) == 0)
        if np.array_equal(facets.cell[side], np.arange(facets.cells)):
            plane = _side(source, side)
            return replace(plane, points=plane.facets.centres())
    return source


def _known_at(source: CellSource, *planes: NDArray[np.bool_]) -> bool:
    """Whether a patch that lies in one of the planes has values; symmetry has none of its own."""
    for patch in source.patches:
        inside = any(plane[face].all() for plane in planes for face in patch.faces)
        if inside and any(patch.how(name) == "value" for name in patch.values):
            return True
    return False


def _side(source: CellSource, side: Ints) -> CellSource:
    """The polygons that some facets are, one of each cell in order, with its values; patches by their edges there."""
    facets = source.facets
    chosen = np.zeros(len(facets.cell), bool)
    chosen[side] = True
    _, a, b = (column[chosen[facets.facet]] for column in facets.fans())
    used, at = np.unique(np.stack([a, b], axis=1), return_inverse=True)
    cell = np.repeat(np.arange(facets.cells), facets.sizes[side])
    starts = 2 * np.arange(len(a) + 1)
    plane = Facets(facets.points[used], at.ravel().astype(np.int64), starts, cell, facets.cells, True)
    number = np.full(len(facets.points), -1)
    number[used] = np.arange(len(used))
    at_points = {name: values[used] for name, values in source.at_points.items()}
    patches = [_edges(patch, number) for patch in source.patches]
    return replace(source, facets=plane, patches=patches, at_points=at_points)


def _edges(patch: Patch, number: Ints) -> Patch:
    """The edges that a patch's faces have among the points of a plane, numbered from 0, −1 for others."""
    edges = [number[face][number[face] >= 0] for face in patch.faces]
    rows = [k for k, edge in enumerate(edges) if edge.size == 2]
    values = {name: values[rows] for name, values in patch.values.items()}
    return replace(patch, faces=[edges[k] for k in rows], values=values)


def _revolved(source: CellSource, front: Patch, back: Patch) -> Revolved:
    """The body that a wedge is a part of. Its cells' values hold in the plane midway between the two sides."""
    axis = _axis(source, front, back)
    side = source.facets_of(front)
    side = side[np.argsort(source.facets.cell[side])]
    plane = _side(source, side)
    facets = replace(plane.facets, points=axis.fold(plane.facets.points))
    patches = [*plane.patches, _on_axis(facets, axis)]
    plane = replace(plane, facets=facets, points=axis.fold(source.points), patches=patches)
    return Revolved(source.path, source.arrays, plane.points, source.time, inner=plane, axis=axis)


def _axis(source: CellSource, front: Patch, back: Patch) -> Axis:
    """Where the planes of the two sides meet, and the direction midway between them."""
    normals, places = [], []
    for patch in (front, back):
        of = source.facets_of(patch)
        areas, middles = source.facets.areas()
        away = middles[of] - source.points[source.facets.cell[of]]
        areas = areas[of] * np.sign(np.einsum("ij,ij->i", areas[of], away))[:, None]
        total: Floats = areas.sum(axis=0)
        normals.append(total / np.linalg.norm(total))
        places.append(middles[of].mean(axis=0))
    along = np.cross(normals[0], normals[1])
    along /= np.linalg.norm(along)
    along *= 1.0 if along[np.argmax(np.abs(along))] > 0 else -1.0
    heights = np.array([*(n @ p for n, p in zip(normals, places)), 0.0])
    origin = np.linalg.solve(np.stack([*normals, along]), heights)
    middle = (places[0] + places[1]) / 2 - origin
    middle -= (middle @ along) * along
    return Axis(origin, along, middle / np.linalg.norm(middle))


def _on_axis(facets: Facets, axis: Axis) -> Patch:
    """The edges on the axis, where nothing flows away from it."""
    size = float(np.max(np.ptp(facets.points, axis=0)))
    on = axis.radius(facets.points) < ROUNDING * size
    ends = facets.corners.reshape(-1, 2)
    return Patch("axis", "axis", list(ends[on[ends].all(axis=1)]), {}, lambda _: "slide")
