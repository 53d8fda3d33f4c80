"""OpenFOAM cases one cell thick, as what they stand for: a plane between ``empty`` patches, a body of revolution between
``wedge`` patches.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from ..frame import Floats
from .cells import CellSource, Patch
from .facets import Facets, Ints, facets_of
from .openfoam import Conditions
from .revolve import Axis, Revolved
from .sources import ROUNDING, Source


@dataclass(frozen=True)
class Block:
    """A part of a case as VTK gives it.

    Parameters
    ----------
    name, kind : str
        Of a patch; "internalMesh" and "" of the cells.
    mesh : pyvista.DataSet
        Cells with their values, or faces with theirs.
    """

    name: str
    kind: str
    mesh: Any


def numbers(data: Any) -> dict[str, Floats]:
    """The arrays of numbers of cells or of points."""
    return {name: np.array(v, np.float64) for name, v in data.items() if v.dtype.kind in "fiu"}


def flattened(path: str, time: float, cells: int, patches: Sequence[Block], conditions: Conditions) -> Source | None:
    """The plane or the body of revolution; None if the case is neither.

    VTK gives an ``empty`` or ``wedge`` patch the values of the cells behind it, so that one of the two sides is the whole
    case. Those of a wedge hold in the plane midway between its sides.
    """
    wedges = [block for block in patches if block.kind == "wedge" and block.mesh.n_cells]
    if len(wedges) == 2 and wedges[0].mesh.n_cells == cells:
        side, (front, back) = wedges[0].mesh, (_normal(block.mesh) for block in wedges)
        axis = _axis(front, back, side, wedges[1].mesh)
    else:
        axis = None
        found = _one_side([block.mesh for block in patches if block.kind == "empty"], cells)
        if found is None:
            return None
        side = found
    others = [block for block in patches if block.kind not in ("empty", "wedge") and block.mesh.n_cells]
    facets = facets_of(side.cast_to_unstructured_grid())
    edges = [_edges(block, facets, conditions) for block in others]
    if axis is None:
        return CellSource(path, numbers(side.cell_data), facets.centres(), time, facets=facets, patches=edges)
    facets = replace(facets, points=axis.fold(facets.points))
    edges.append(_on_axis(facets, axis))
    plane = CellSource(path, numbers(side.cell_data), facets.centres(), time, facets=facets, patches=edges)
    return Revolved(path, plane.arrays, plane.points, time, inner=plane, axis=axis)


def _one_side(leaves: list[Any], cells: int) -> Any:
    """Those faces of ``empty`` patches that look to one of the two sides, if they are as many as there are cells."""
    leaves = [leaf for leaf in leaves if leaf.n_cells]
    if sum(leaf.n_cells for leaf in leaves) != 2 * cells:
        return None
    whole = leaves[0].merge(leaves[1:], merge_points=False) if len(leaves) > 1 else leaves[0]
    normals = np.asarray(whole.extract_surface(algorithm=None).face_normals, np.float64)
    along = int(np.argmax(np.abs(normals).sum(axis=0)))
    one = np.flatnonzero(normals[:, along] > 0)
    return whole.extract_cells(one) if len(one) == cells else None


def _normal(mesh: Any) -> Floats:
    total: Floats = np.asarray(mesh.face_normals, np.float64).mean(axis=0)
    return total / np.linalg.norm(total)


def _axis(front: Floats, back: Floats, side: Any, other: Any) -> Axis:
    """Where the planes of the two sides meet, and the direction midway between them."""
    along = np.cross(front, back)
    along /= np.linalg.norm(along)
    along *= 1.0 if along[np.argmax(np.abs(along))] > 0 else -1.0
    p, q = (np.asarray(mesh.points, np.float64).mean(axis=0) for mesh in (side, other))
    origin = np.linalg.solve(np.stack([front, back, along]), np.array([front @ p, back @ q, 0.0]))
    middle = (p + q) / 2 - origin
    middle -= (middle @ along) * along
    return Axis(origin, along, middle / np.linalg.norm(middle))


def _edges(block: Block, facets: Facets, conditions: Conditions) -> Patch:
    """The edges that a patch's faces have in the plane."""
    mesh = block.mesh
    size = float(np.max(np.ptp(facets.points, axis=0)))
    _, at = KDTree(facets.points).query(np.asarray(mesh.points), distance_upper_bound=ROUNDING * size)
    faces: list[Ints] = []
    rows = []
    for k, face in enumerate(mesh.regular_faces if mesh.is_all_triangles else mesh.irregular_faces):
        ends = np.unique(at[face][at[face] < len(facets.points)])
        if ends.size == 2:
            faces.append(ends.astype(np.int64))
            rows.append(k)
    values = {name: v[rows] for name, v in numbers(mesh.cell_data).items()}
    how = {name: conditions.at(name, block.name) for name in values}
    return Patch(block.name, block.kind == "wall", faces, values, how.__getitem__)


def _on_axis(facets: Facets, axis: Axis) -> Patch:
    """The edges on the axis, where nothing flows away from it."""
    size = float(np.max(np.ptp(facets.points, axis=0)))
    on = axis.radius(facets.points) < ROUNDING * size
    ends = facets.corners.reshape(-1, 2)
    return Patch("axis", False, list(ends[on[ends].all(axis=1)]), {}, lambda _: "slide")
