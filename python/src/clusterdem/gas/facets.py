"""Meshes by their facets: each cell as the list of its faces (of its edges, where the mesh lies in a plane)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats

Ints = NDArray[np.int64]

FACES: dict[int, tuple[tuple[int, ...], ...]] = {
    10: ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)),
    11: ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)),
    12: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
    13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}
"""Faces of VTK's tetrahedron, voxel, hexahedron, wedge and pyramid by their points."""
EDGES: dict[int, tuple[tuple[int, int], ...]] = {8: ((0, 1), (1, 3), (3, 2), (2, 0))}
"""Of VTK's pixel, whose points do not go round."""
POLYHEDRON = 42
FACETS_AT_ONCE = 200_000
"""How many facets are looked at at a time, so that little is in memory."""


@dataclass(frozen=True)
class Facets:
    """Points and the facets between them.

    Parameters
    ----------
    points : ndarray, shape (P, 3)
        Points of the mesh.
    corners, starts : ndarray of int, shape (M,) and (F + 1,)
        Facet f has the points ``corners[starts[f]:starts[f + 1]]``, in order.
    cell : ndarray of int, shape (F,)
        The cell of each facet, ascending; a face between two cells stands twice.
    cells : int
        How many cells there are.
    flat : bool
        Facets are edges of polygons, not faces.
    """

    points: Floats
    corners: Ints
    starts: Ints
    cell: Ints
    cells: int
    flat: bool

    @property
    def sizes(self) -> Ints:
        """Points of each facet."""
        return np.diff(self.starts)

    @property
    def facet(self) -> Ints:
        """The facet of each entry of ``corners``."""
        return np.repeat(np.arange(len(self.cell)), self.sizes)

    @cached_property
    def keys(self) -> NDArray[np.uint64]:
        """A number for each facet that is the same for facets of the same points: the sum of random ones of these."""
        return self.key(self.corners, self.starts)

    def key(self, corners: Ints, starts: Ints) -> NDArray[np.uint64]:
        """Such numbers of any lists of points, none of them empty."""
        words = np.random.default_rng(0).integers(0, 2**64, len(self.points), np.uint64)
        return np.add.reduceat(words[corners], starts[:-1]) if len(starts) > 1 else np.zeros(0, np.uint64)

    def mean(self, values: Floats) -> Floats:
        """Mean over the points of each facet, of values at points; shape (F, k)."""
        return _mean(self.facet, values[self.corners], len(self.cell))

    def boxes(self, points: Floats) -> tuple[Floats, Floats]:
        """Lowest and highest coordinates of each cell, each of shape (C, 3), the points being where they are given."""
        at = points[self.corners]
        first = self.starts[np.searchsorted(self.cell, np.arange(self.cells))]
        return np.minimum.reduceat(at, first, axis=0), np.maximum.reduceat(at, first, axis=0)

    def of_cells(self, chosen: NDArray[np.bool_]) -> Ints:
        """The facets of some cells."""
        return np.flatnonzero(chosen[self.cell])

    @cached_property
    def incidence(self) -> tuple[Ints, Ints]:
        """Which cell has which point, each pair once."""
        pairs = np.unique(self.cell[self.facet] * np.int64(len(self.points)) + self.corners)
        return pairs // len(self.points), pairs % len(self.points)

    def fans(self, facets: Ints | None = None) -> tuple[Ints, Ints, Ints]:
        """Sides of some facets (all): the facet of each, and the points that it joins."""
        facets = np.arange(len(self.cell)) if facets is None else facets
        sizes = self.sizes[facets]
        ends = np.cumsum(sizes)
        place = np.arange(sizes.sum()) - np.repeat(ends - sizes, sizes)  # within the facet
        facet = np.repeat(facets, sizes)
        begin = self.starts[facet]
        return facet, self.corners[begin + place], self.corners[begin + (place + 1) % np.repeat(sizes, sizes)]

    def areas(self) -> tuple[Floats, Floats]:
        """Area vectors and centroids of faces, each of shape (F, 3), by their fans about the mean of their points.

        As OpenFOAM's ``primitiveMesh::makeFaceCentresAndAreas`` has them, whose cells' centres values belong to.
        """
        count = len(self.cell)
        area, middle = np.empty((count, 3)), self.mean(self.points)
        for block in np.array_split(np.arange(count), -(-count // FACETS_AT_ONCE)):
            facet, a, b = self.fans(block)
            p, q, m = self.points[a], self.points[b], middle[facet]
            parts = 0.5 * np.cross(p - m, q - m)
            sizes = np.linalg.norm(parts, axis=1)
            row, rows = facet - block[0], len(block)
            whole = np.bincount(row, sizes, rows)[:, None]
            moment = _sum(row, sizes[:, None] * (p + q + m) / 3, rows)
            area[block] = _sum(row, parts, rows)
            middle[block] = np.divide(moment, whole, out=middle[block], where=whole > 0)
        return area, middle

    def centres(self) -> Floats:
        """Centres of the cells, shape (C, 3): of the pyramids upon their faces (triangles upon their edges).

        As OpenFOAM's ``primitiveMesh::makeCellCentresAndVols``; the centroid where faces are plane.
        """
        if self.flat:  # each edge once, in the direction of its polygon
            ends = self.corners.reshape(-1, 2)
            middle = (self.points[ends[:, 0]] + self.points[ends[:, 1]]) / 2
            rough = _mean(self.cell, middle, self.cells)
            normal = np.cross(self.points[ends[:, 0]] - rough[self.cell], self.points[ends[:, 1]] - rough[self.cell])
            total = _sum(self.cell, normal, self.cells)
            size, share = np.einsum("ij,ij->i", normal, total[self.cell]), 2 / 3
        else:
            area, middle = self.areas()
            rough = _mean(self.cell, middle, self.cells)
            # whichever way the face turns
            size, share = np.abs(np.einsum("ij,ij->i", area, middle - rough[self.cell])), 3 / 4
        whole = np.bincount(self.cell, size, self.cells)[:, None]
        moment = _sum(self.cell, size[:, None] * share * (middle - rough[self.cell]), self.cells)
        return rough + np.divide(moment, whole, out=np.zeros_like(rough), where=whole != 0)


def _sum(index: Ints, values: Floats, count: int) -> Floats:
    return np.stack([np.bincount(index, column, count) for column in values.T], axis=1)


def _mean(index: Ints, values: Floats, count: int) -> Floats:
    number = np.bincount(index, minlength=count)
    return _sum(index, values, count) / np.maximum(number, 1)[:, None]


def facets_of(mesh: Any) -> Facets:
    """The facets of a VTK mesh whose cells are linear: all of three dimensions, or all of two.

    Parameters
    ----------
    mesh : pyvista.UnstructuredGrid
        Cells of the types that ``FACES`` lists and polyhedra; or triangles, quads, pixels and polygons.
    """
    types = np.asarray(mesh.celltypes)
    offsets = np.asarray(mesh.cell_offsets, np.int64)
    nodes = np.asarray(mesh.cell_connectivity, np.int64)
    flat = mesh.max_cell_dimensionality == 2
    parts = [_polygons(types, offsets, nodes)] if flat else []
    for kind in np.unique(types):
        of_kind = np.flatnonzero(types == kind)
        if flat and int(kind) in EDGES:
            parts.append(_by_table(of_kind, offsets, nodes, EDGES[int(kind)]))
        elif not flat and int(kind) in FACES:
            parts.append(_by_table(of_kind, offsets, nodes, FACES[int(kind)]))
        elif kind == POLYHEDRON:
            parts.append(_polyhedra(mesh, of_kind))
    cell = np.concatenate([part[0] for part in parts])
    sizes = np.concatenate([part[1] for part in parts])
    corners = np.concatenate([part[2] for part in parts])
    order = np.argsort(cell, kind="stable")
    starts = np.concatenate([[0], np.cumsum(sizes)])
    sorted_sizes = sizes[order]
    new_starts = np.concatenate([[0], np.cumsum(sorted_sizes)])
    take = np.repeat(starts[order] - new_starts[:-1], sorted_sizes) + np.arange(new_starts[-1])
    points, same = _unique_points(np.asarray(mesh.points))
    return Facets(points, same[corners[take]], new_starts, cell[order], mesh.n_cells, flat)


def is_linear(mesh: Any) -> bool:
    """Whether :func:`facets_of` can take it."""
    flat = mesh.max_cell_dimensionality == 2
    known = {5, 7, 8, 9} if flat else {*FACES, POLYHEDRON}
    return set(map(int, np.unique(mesh.celltypes))) <= known


def _unique_points(points: Any) -> tuple[Floats, Ints]:
    """Points that are the same to the bit made one: parts of a case meet in such."""
    packed = np.ascontiguousarray(points + 0.0)  # no -0.0
    bits = packed.view(np.dtype((np.void, packed.dtype.itemsize * 3))).ravel()
    _, first, same = np.unique(bits, return_index=True, return_inverse=True)
    return np.asarray(packed[first], np.float64), same.astype(np.int64)


Part = tuple[Ints, Ints, Ints]


def _by_table(cells: Ints, offsets: Ints, nodes: Ints, table: Sequence[Sequence[int]]) -> Part:
    corners, sizes = [], []
    for face in table:
        corners.append(nodes[offsets[cells][:, None] + np.array(face)])
        sizes.append(len(face))
    flat = np.concatenate(corners, axis=1).ravel()  # cell by cell, face by face
    return np.repeat(cells, len(table)), np.tile(sizes, len(cells)), flat


def _polygons(types: Any, offsets: Ints, nodes: Ints) -> Part:
    """Edges of all polygons but pixels."""
    wanted = ~np.isin(types, list(EDGES))
    sizes = np.diff(offsets)
    cell = np.repeat(np.arange(len(sizes)), sizes)
    following = np.arange(1, len(nodes) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    edges = np.stack([nodes, nodes[following]], axis=1)[wanted[cell]]
    cell = cell[wanted[cell]]
    return cell, np.full(len(cell), 2), edges.ravel()


def _polyhedra(mesh: Any, cells: Ints) -> Part:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    faces, places = mesh.GetPolyhedronFaces(), mesh.GetPolyhedronFaceLocations()
    corners = vtk_to_numpy(faces.GetConnectivityArray()).astype(np.int64)
    starts = vtk_to_numpy(faces.GetOffsetsArray()).astype(np.int64)
    which = vtk_to_numpy(places.GetConnectivityArray()).astype(np.int64)
    of_cell = vtk_to_numpy(places.GetOffsetsArray()).astype(np.int64)
    number = np.diff(of_cell)[cells]
    first = np.concatenate([[0], np.cumsum(number)])
    which = which[np.repeat(of_cell[cells] - first[:-1], number) + np.arange(first[-1])]
    sizes = np.diff(starts)[which]
    begin = np.concatenate([[0], np.cumsum(sizes)])
    take = np.repeat(starts[which] - begin[:-1], sizes) + np.arange(begin[-1])
    return np.repeat(cells, number), sizes, corners[take]
