"""Values in the cells of a mesh, and at its patches, asked for anywhere.

Each cell is split about its centre: into tetrahedra upon the fans of its faces (triangles upon its edges, where the mesh
lies in a plane). Their corners have the cell's own value, those of the patches (at faces and points that lie on them) and,
at all other points, what the cells around continue to linearly (reconstruct.py). So polyhedra need no rule of their own,
linear fields stay exact, and the value at a wall is that of the file. OpenFOAM's ``cellPointFace`` splits cells alike.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..frame import Floats
from .facets import Facets, Ints
from .reconstruct import continued, gradients
from .sources import ROUNDING, Arrays, Source
from .zones import outer_facets

CELLS_AT_ONCE = 25_000
"""How many cells are split at a time: 24 tetrahedra of each hexahedron take some 1 kB."""


@dataclass(frozen=True, eq=False)
class Patch:
    """A part of the surface.

    Parameters
    ----------
    name : str
        Its name.
    kind : str
        "wall", "wedge", "empty" and so on, as OpenFOAM names kinds; "patch" if nothing is known.
    faces : sequence of ndarray of int
        Points of each of its faces (edges), as :class:`Facets` numbers them.
    values : mapping of str to ndarray
        Values at these faces.
    how : callable
        Of an array's name "value" where these values hold, "slide" where only the part of a vector along the face goes
        on to it, "open" where nothing is known.
    """

    name: str
    kind: str
    faces: Sequence[Ints]
    values: Arrays
    how: Callable[[str], str]

    @property
    def wall(self) -> bool:
        """Whether it is a wall."""
        return self.kind == "wall"


@dataclass(eq=False)
class CellSource(Source):
    """Values in the cells of a mesh; ``points`` are the cells' centres, ``arrays`` their values.

    Parameters
    ----------
    facets : Facets
        The mesh.
    patches : sequence of Patch
        What is known of its surface.
    at_points : mapping of str to ndarray, shape (P,) or (P, k)
        Arrays that are known at the points of the mesh, too: they hold at its surface where no patch has a value.
    not_in_cells : frozenset of str
        Those of them that are known there alone.
    """

    facets: Facets = None  # type: ignore[assignment]
    patches: Sequence[Patch] = ()
    at_points: Arrays = field(default_factory=dict)
    not_in_cells: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        kept = []
        for patch in self.patches:  # a surface within the mesh, such as a cut that was saved with it, is no patch
            rows = np.flatnonzero(np.isin(self._keys(patch), self.facets.keys))
            values = {name: v[rows] for name, v in patch.values.items()}
            kept.append(replace(patch, faces=[patch.faces[int(k)] for k in rows], values=values))
        self.patches = kept

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        return self.facets.points.min(axis=0), self.facets.points.max(axis=0)

    @property
    def walls(self) -> list[str]:
        """Names of the patches that are walls."""
        return [patch.name for patch in self.patches if patch.wall and len(patch.faces)]

    def slipping(self, names: Iterable[str]) -> list[str]:
        names = [name for name in names if name in self.arrays and name not in self.at_points]
        walls = [patch for patch in self.patches if patch.wall and len(patch.faces)]
        return [patch.name for patch in walls if any(patch.how(name) == "open" for name in names)]

    def sample(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        return self._found(places, {name: self._at_nodes(name) for name in names})[0]

    def means(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        _, cell = self._found(places, {})
        found = {}
        for name in names:
            found[name] = self.arrays[name][cell]
            found[name][cell < 0] = np.nan
        return found

    def _found(self, places: Floats, nodes: Arrays) -> tuple[dict[str, Floats], Ints]:
        """Values at places from those at the nodes, and the cell of each; NaN and −1 outside."""
        places = self._plane(self.snapped(places))
        found = {name: np.full((len(places), *values.shape[1:]), np.nan) for name, values in nodes.items()}
        of_cell = np.full(len(places), -1)
        missing = np.arange(len(places))
        asked = self._near(places)
        for cells in np.array_split(asked, -(-len(asked) // CELLS_AT_ONCE)) if len(asked) else ():
            missing = self._sample_cells(cells, places, missing, nodes, found, of_cell)
        return found, of_cell

    @cached_property
    def _boxes(self) -> tuple[Floats, Floats]:
        return self.facets.boxes(self._plane(self.facets.points))

    @property
    def _margin(self) -> float:
        """By how much a point may lie outside of a cell (in the file's own unit)."""
        low, high = self.bounds
        return ROUNDING * float(np.max(high - low))

    def _near(self, places: Floats) -> Ints:
        """Cells in whose boxes places may lie, by each coordinate alone: all that are needed, of a grid no others."""
        near = np.ones(self.facets.cells, bool)
        low, high = self._boxes
        for k in range(3):
            have = np.unique(places[:, k])
            first = np.searchsorted(have, low[:, k] - self._margin)
            near &= first < np.searchsorted(have, high[:, k] + self._margin, "right")
        return np.flatnonzero(near)

    def _sample_cells(
        self, cells: Ints, places: Floats, missing: Ints, nodes: Arrays, found: dict[str, Floats], of_cell: Ints
    ) -> Ints:
        """Fill in what lies in some of the cells; the rest is still missing."""
        from .meshes import pyvista

        pv = pyvista()
        low, high = (end[cells] for end in self._boxes)
        margin = self._margin
        near = np.all(
            (places[missing] >= low.min(axis=0) - margin) & (places[missing] <= high.max(axis=0) + margin), axis=1
        )
        asked = missing[near]
        if not asked.size:
            return missing
        used, simplices, owner = self._simplices(cells)
        kind = 5 if self.facets.flat else 10
        wide = simplices.shape[1]
        stream = np.concatenate([np.full((len(simplices), 1), wide), simplices], axis=1).ravel()
        mesh = pv.UnstructuredGrid(stream, np.full(len(simplices), kind, np.uint8), self._nodes[used])
        mesh.cell_data["cell of the simplex"] = owner
        for name, values in nodes.items():
            mesh.point_data[name] = values[used]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            probed = pv.PolyData(places[asked]).sample(mesh, tolerance=margin, locator="static_cell")
        valid = np.asarray(probed.point_data["vtkValidPointMask"]) == 1
        for name in nodes:
            found[name][asked[valid]] = np.asarray(probed.point_data[name], np.float64)[valid]
        of_cell[asked[valid]] = np.asarray(probed.point_data["cell of the simplex"], np.int64)[valid]
        return np.setdiff1d(missing, asked[valid], assume_unique=True)

    @cached_property
    def _basis(self) -> tuple[Floats, Floats] | None:
        """A point of the plane that the mesh lies in and two directions in it, as columns; None of other meshes."""
        facets = self.facets
        if not facets.flat:
            return None
        ends = facets.points[facets.corners.reshape(-1, 2)] - self.points[facets.cell][:, None]
        normal = np.cross(ends[:, 0], ends[:, 1]).sum(axis=0)
        normal /= np.linalg.norm(normal)
        across = int(np.argmax(np.abs(normal)))
        first = np.eye(3)[(across + 1) % 3]
        first -= (first @ normal) * normal
        first /= np.linalg.norm(first)
        return facets.points[0], np.stack([first, np.cross(normal, first)], axis=1)

    def _plane(self, points: Floats) -> Floats:
        """Of points their coordinates in that plane, the third 0, wherever they lie across; of other meshes as they are."""
        if self._basis is None:
            return points
        origin, directions = self._basis
        return np.concatenate([(points - origin) @ directions, np.zeros((len(points), 1))], axis=1)

    @cached_property
    def _nodes(self) -> Floats:
        """Corners of the simplices: points of the mesh, centres of cells, middles of facets."""
        return self._plane(np.concatenate([self.facets.points, self.points, self.facets.mean(self.facets.points)]))

    def _simplices(self, cells: Ints) -> tuple[Ints, Ints, Ints]:
        """Of some cells: the nodes in use, each simplex by its place among these, and its cell."""
        facets, count = self.facets, len(self.facets.points)
        chosen = np.zeros(facets.cells, bool)
        chosen[cells] = True
        facet, a, b = facets.fans(facets.of_cells(chosen))
        apex = count + facets.cell[facet]
        middle = count + facets.cells + facet
        if facets.flat:  # a, the middle of the edge and the centre; each edge has both of its ends as a
            simplices = np.stack([apex, a, middle], axis=1)
        else:
            simplices = np.stack([apex, middle, a, b], axis=1)
        used, at = np.unique(simplices, return_inverse=True)
        return used, at.reshape(simplices.shape), facets.cell[facet]

    def _at_nodes(self, name: str) -> Floats:
        facets = self.facets
        shape = self.arrays[name].shape[1:]
        if name in self.not_in_cells:
            points = self.at_points[name].reshape(len(facets.points), -1)
            middle = facets.mean(points)
            cell, point = facets.incidence
            count = np.bincount(cell, minlength=facets.cells)[:, None]
            inside = np.stack([np.bincount(cell, column, facets.cells) for column in points[point].T], axis=1) / count
        else:
            inside = self.arrays[name].reshape(facets.cells, -1)
            cell, point = facets.incidence
            slope = gradients(facets.points, self.points, cell, point, inside)
            points = continued(facets.points, self.points, cell, point, inside, slope)
            middle = self._at_middles(inside, slope)
            if name in self.at_points:
                outside = self._outside
                on = np.unique(facets.corners[outside[facets.facet]])
                points[on] = self.at_points[name].reshape(len(facets.points), -1)[on]
                middle[outside] = facets.mean(points)[outside]
            for facet, value in self._at_patches(name, points, middle):
                middle[facet] = value
        return np.concatenate([points, inside, middle]).reshape(-1, *shape)

    @cached_property
    def _outside(self) -> NDArray[np.bool_]:
        """Facets that have a cell on one side alone."""
        once = np.zeros(len(self.facets.cell), bool)
        once[outer_facets(self.facets)] = True
        return once

    def _at_middles(self, inside: Floats, slope: Floats) -> Floats:
        """At the middles of facets, from the cells on both sides; those at the surface have one."""
        facets = self.facets
        _, first, same = np.unique(facets.keys, return_index=True, return_inverse=True)
        places = facets.mean(facets.points)[first]
        return continued(places, self.points, facets.cell, same, inside, slope)[same]

    def _at_patches(self, name: str, points: Floats, middle: Floats) -> list[tuple[Ints, Floats]]:
        """Set the values at points that lie on patches; return those of the patches' facets.

        A point gets the mean over the facets of its walls, if it has any with a value, else of other patches.
        """
        fixed = []
        taken = np.zeros(len(points), bool)
        for wall in (True, False):
            total, count = np.zeros_like(points), np.zeros(len(points))
            for patch in self.patches:
                if patch.wall != wall or not len(patch.faces):
                    continue
                no_slip = wall and name in self.no_slip
                how = "value" if no_slip else patch.how(name)
                rows = np.repeat(np.arange(len(patch.faces)), [len(face) for face in patch.faces])
                corners = np.concatenate(patch.faces)
                if how == "value" and (no_slip or name in patch.values):
                    value = np.zeros((len(patch.faces), points.shape[1]))
                    if not no_slip:
                        value += patch.values[name].reshape(len(patch.faces), -1)
                    fixed.append((self.facets_of(patch), value))
                    value = value[rows]
                elif how == "slide" and points.shape[1] == 3:
                    normal = self._normals(patch)
                    of = self.facets_of(patch)
                    fixed.append((of, _along(middle[of], normal)))
                    value = _along(points[corners], normal[rows])
                else:
                    continue
                for k in range(points.shape[1]):
                    total[:, k] += np.bincount(corners, value[:, k], len(points))
                count += np.bincount(corners, minlength=len(points))
            new = (count > 0) & ~taken
            points[new] = total[new] / count[new, None]
            taken |= new
        return fixed

    def _keys(self, patch: Patch) -> NDArray[np.uint64]:
        if not len(patch.faces):
            return np.zeros(0, np.uint64)
        starts = np.concatenate([[0], np.cumsum([len(face) for face in patch.faces])])
        return self.facets.key(np.concatenate(patch.faces), starts)

    def facets_of(self, patch: Patch) -> Ints:
        """The facets of a patch's faces."""
        keys = self.facets.keys
        order = np.argsort(keys)
        return order[np.searchsorted(keys, self._keys(patch), sorter=order)]

    def _normals(self, patch: Patch) -> Floats:
        facets = self.facets
        of = self.facets_of(patch)
        if facets.flat:
            ends = np.stack([facets.corners[facets.starts[of]], facets.corners[facets.starts[of] + 1]], axis=1)
            along = facets.points[ends[:, 1]] - facets.points[ends[:, 0]]
            away = facets.points[ends[:, 0]] - self.points[facets.cell[of]]
            normal = (
                away
                - along
                * (np.einsum("ij,ij->i", away, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300))[
                    :, None
                ]
            )
        else:
            normal = facets.areas()[0][of]
        unit: Floats = normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        return unit


def _along(vectors: Floats, normal: Floats) -> Floats:
    """Their parts along faces."""
    along: Floats = vectors - np.einsum("ij,ij->i", vectors, normal)[:, None] * normal
    return along
