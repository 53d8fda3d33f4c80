"""What runs are compared by: of every frame after the start, one row of numbers per observable."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...analysis.grid import Grid, maps_of
from ...analysis.nonuniformity import lateral, measure, strips
from ...analysis.sizes import class_shares
from ...errors import InputError
from ...frame import Floats, Frame

CELL = (0.01, 0.02)
"""Width and height of the cells of the paper's 30 x 30 grid (m)."""


@dataclass(frozen=True)
class Observable:
    """Something to compare runs by.

    Parameters
    ----------
    label : str
        Its name in tables and figures.
    measure : callable
        Its numbers in one frame on a grid, shape (M,).
    """

    label: str
    measure: Callable[[Frame, Grid], Floats]


def clusters(frame: Frame, grid: Grid) -> Floats:
    """Clusters per mass of solids (1/kg), so that boxes of other sizes compare."""
    return np.array([len(frame) / frame.mass.sum()])


def mean_diameter(frame: Frame, grid: Grid) -> Floats:
    """Mean diameter by number (m)."""
    return np.array([frame.diameter.mean()])


def sauter_diameter(frame: Frame, grid: Grid) -> Floats:
    """Sauter mean diameter (m)."""
    return np.array([(frame.diameter**3).sum() / (frame.diameter**2).sum()])


def size_classes(frame: Frame, grid: Grid) -> Floats:
    """Percent of clusters in the paper's four size classes."""
    return np.array(class_shares(frame.diameter))


def cell_fractions(frame: Frame, grid: Grid) -> Floats:
    """The map: solids fraction of every cell."""
    return maps_of(frame, grid)["fraction"].ravel()


def dispersion(frame: Frame, grid: Grid) -> Floats:
    """Index of dispersion by mass: 1 is chance, above it clustering."""
    fraction = maps_of(frame, grid)["fraction"]
    return np.array([measure(fraction, frame.mass, frame.x, frame.z, grid).dispersion])


def lateral_fraction(frame: Frame, grid: Grid) -> Floats:
    """Solids fraction across the width, in strips as wide as a cell."""
    return lateral(frame, grid.nx).fraction


def lateral_diameter(frame: Frame, grid: Grid) -> Floats:
    """Mean diameter in six strips from centre to wall (m); 0 where no cluster is."""
    return np.nan_to_num(strips(frame).diameter)


OBSERVABLES = {
    "clusters": Observable("clusters N(t)", clusters),
    "mean_diameter": Observable("mean d", mean_diameter),
    "sauter_diameter": Observable("Sauter d", sauter_diameter),
    "size_classes": Observable("size classes", size_classes),
    "map": Observable("map", cell_fractions),
    "dispersion": Observable("dispersion", dispersion),
    "lateral_fraction": Observable("lateral fraction", lateral_fraction),
    "lateral_diameter": Observable("lateral d", lateral_diameter),
}


@dataclass(frozen=True)
class Observed:
    """A run's observables.

    Parameters
    ----------
    times : ndarray, shape (F,)
        Times of its frames after the start (s).
    values : dict of str to ndarray, shape (F, M)
        Numbers by observable; M differs between observables.
    """

    times: Floats
    values: dict[str, Floats]


def grid_of(frame: Frame, cell: tuple[float, float]) -> Grid:
    """Cells of a size as near to ``cell`` as fits the box a whole number of times."""
    lx, _, lz = frame.box.lengths
    return Grid(frame.box, max(1, round(lx / cell[0])), max(1, round(lz / cell[1])))


def observe(frames: Sequence[Frame], names: Sequence[str], cell: tuple[float, float] = CELL) -> Observed:
    """Measure a run.

    Parameters
    ----------
    frames : sequence of Frame
        Its frames; the first is the start, which settings have in common, and is left out.
    names : sequence of str
        Keys of :data:`OBSERVABLES`.
    cell : (float, float)
        Size of the grid's cells (m).
    """
    later = frames[1:]
    if not later:
        raise InputError(frames[0].path if frames else "run", "holds no frame after the start")
    values = {
        name: np.stack([OBSERVABLES[name].measure(frame, grid_of(frame, cell)) for frame in later]) for name in names
    }
    return Observed(np.array([frame.time for frame in later]), values)
