"""Which faces of a Fluent case are its walls.

VTK's reader gives a zone of faces as the cells behind them, each as often as it has faces there. A cell all of whose outer
faces belong to one zone is clear; one at an edge between zones gives each face to the zone that most of the face's points
belong to already.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from ..frame import Floats
from .facets import Facets, Ints, facets_of


def outer_facets(facets: Facets) -> Ints:
    """Facets with a cell on one side alone."""
    _, same, count = np.unique(facets.keys, return_inverse=True, return_counts=True)
    return np.flatnonzero(count[same] == 1)


def faces_of_zones(facets: Facets, centres: Floats, zones: Mapping[str, Any]) -> dict[str, list[Ints]]:
    """The faces of each zone, by their points.

    Parameters
    ----------
    facets, centres
        The mesh and the centres of its cells.
    zones : mapping of str to pyvista.UnstructuredGrid
        The cells behind the faces of each zone.
    """
    tree, names = KDTree(centres), list(zones)
    left = np.zeros((len(names), facets.cells), np.int64)  # faces of each cell that a zone still has to get
    for row, mesh in zip(left, zones.values()):
        np.add.at(row, tree.query(facets_of(mesh).centres())[1], 1)
    outside = outer_facets(facets)
    total = np.bincount(facets.cell[outside], minlength=facets.cells)
    belongs = np.zeros((len(names), len(facets.points)), bool)
    chosen: dict[str, list[Ints]] = {name: [] for name in names}

    def give(zone: int, facet: int) -> None:
        face = facets.corners[facets.starts[facet] : facets.starts[facet + 1]]
        chosen[names[zone]].append(face)
        belongs[zone, face] = True
        left[zone, facets.cell[facet]] -= 1

    clear = (left == total) & (total > 0)
    doubtful = []
    for facet in outside:
        (zone,) = np.nonzero(clear[:, facets.cell[facet]])
        if zone.size:
            give(int(zone[0]), int(facet))
        else:
            doubtful.append(int(facet))
    for facet in doubtful:
        face = facets.corners[facets.starts[facet] : facets.starts[facet + 1]]
        shared = np.where(left[:, facets.cell[facet]] > 0, belongs[:, face].sum(axis=1), -1)
        if names and shared.max() >= 0:
            give(int(np.argmax(shared)), facet)
    return chosen
