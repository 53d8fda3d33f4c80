"""What can be observed of a frame: one registry, for tables, reports, trades and calibrations, open to entries of one's own.

Examples
--------
A quantity of one's own, known to every command once its file is named (``observables_file`` of a study, ``--observables``):

>>> import numpy as np
>>> from clusterdem.observables import Observable, find, register
>>> register(Observable("fastest", "fastest cluster", "m/s", lambda frame, how: np.array([frame["vz"].max()]), columns=("vz",)))
>>> find("fastest").label
'fastest cluster'
"""

from __future__ import annotations

import hashlib
import importlib.util
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from .analysis.grid import Grid, grid_of_cells, solids_fraction
from .analysis.groups import groups_of
from .analysis.nonuniformity import measure
from .analysis.profiles import lateral, strips
from .analysis.sizes import borders_of, class_names, class_shares, mean_diameter, sauter_diameter
from .analysis.velocities import velocity_moments
from .errors import ArgumentError, InputError
from .frame import Floats, Frame

SHAPE = (30, 30)
"""Cells of a map where nothing else is said."""


@dataclass(frozen=True)
class How:
    """How frames are measured.

    Parameters
    ----------
    cell : (float, float), optional
        Width and height of a map's cell (m); 30 by 30 cells by default.
    borders : tuple of float
        Borders of the size classes (m); none for one class of all.
    strips : int
        Strips from centre to wall.
    plane : str
        The plane of the maps; its first axis is the width.
    """

    cell: tuple[float, float] | None = None
    borders: tuple[float, ...] = ()
    strips: int = 6
    plane: str = "xz"

    def grid(self, frame: Frame) -> Grid:
        """The frame's grid."""
        if self.cell is None:
            return Grid(frame.box, *SHAPE, self.plane)
        return grid_of_cells(frame.box, self.cell, self.plane)

    def settled(self, frames: Sequence[Frame]) -> How:
        """The same with cells and classes that follow from frames, where they are open: for all that is compared with these."""
        cell, borders = self.cell, self.borders
        if cell is None and frames:
            width, height = self.grid(frames[0]).spacing
            cell = (width, height)
        sizes = [extreme for frame in frames if len(frame) for extreme in (frame.diameter.min(), frame.diameter.max())]
        if not borders and sizes:
            borders = borders_of(float(min(sizes)), float(max(sizes)))
        return replace(self, cell=cell, borders=borders)


def _one(how: How) -> tuple[str, ...]:
    return ()


@dataclass(frozen=True)
class Observable:
    """Something to observe of a frame.

    Parameters
    ----------
    name : str
        By which study files and commands call it.
    label, unit : str
        Its name in tables and figures; the unit of its numbers.
    measure : callable
        Its numbers in one frame, measured as :class:`How` says, shape (M,); NaN where there is nothing to measure.
    parts : callable
        Names of its numbers, where they have any.
    relative : bool
        Whether ratios count between two values, or differences (in points of percent).
    columns : tuple of str
        What it needs besides x, z, diameter, mass and what tells the primary particles.
    of_run : tuple of str
        What it needs of ``Frame.run``; NaN where a frame is read without its run.
    source : str
        What else its numbers depend on, where it is one's own: its expression, or a hash of the file that registers it.
    """

    name: str
    label: str
    unit: str
    measure: Callable[[Frame, How], Floats]
    parts: Callable[[How], tuple[str, ...]] = _one
    relative: bool = True
    columns: tuple[str, ...] = ()
    of_run: tuple[str, ...] = ()
    source: str = ""

    def __call__(self, frame: Frame, how: How) -> Floats:
        """Its numbers in one frame, shape (M,)."""
        return np.atleast_1d(np.asarray(self.measure(frame, how), dtype=np.float64))

    def headings(self, how: How) -> list[str]:
        """Names of its numbers for a table's columns."""
        parts = self.parts(how)
        return [f"{self.name} {part}" for part in parts] if parts else [self.name]


def _single(value: Callable[[Frame], float]) -> Callable[[Frame, How], Floats]:
    return lambda frame, how: np.array([value(frame)])


def _of_run(name: str) -> Callable[[Frame, How], Floats]:
    return lambda frame, how: np.array([frame.run.get(name, np.nan)])


def _per_mass(frame: Frame) -> float:
    return len(frame) / float(frame.mass.sum()) if len(frame) else float("nan")


def _extreme(which: Callable[[Floats], float]) -> Callable[[Frame], float]:
    return lambda frame: float(which(frame.diameter)) if len(frame) else float("nan")


def _dispersion(frame: Frame, how: How) -> Floats:
    grid = how.grid(frame)
    return np.array([measure(solids_fraction(frame, grid), frame, grid).dispersion])


def _lateral_fraction(frame: Frame, how: How) -> Floats:
    fraction = lateral(frame, how.grid(frame).nx, how.plane).fraction
    assert fraction is not None
    return fraction


def _largest_group(frame: Frame) -> float:
    """Clusters of it."""
    return float(groups_of(frame).clusters[0]) if len(frame) else 0.0


def _classes(how: How) -> tuple[str, ...]:
    return class_names(how.borders)


def _numbered_strips(how: How) -> tuple[str, ...]:
    return tuple(str(strip) for strip in range(1, how.strips + 1))


REGISTRY: dict[str, Observable] = {}
"""Every observable by its name."""


def register(observable: Observable) -> None:
    """Add an observable; one of the same name gives way."""
    if not observable.name.isidentifier():
        raise ArgumentError("name", f"must be a word of letters, digits and underscores, not {observable.name!r}")
    REGISTRY[observable.name] = observable


def find(name: str) -> Observable:
    """An observable by its name.

    Raises
    ------
    ArgumentError
        If there is none, with the names that there are.
    """
    if name not in REGISTRY:
        raise ArgumentError("observables", f"there is no {name!r}; there are {', '.join(REGISTRY)}")
    return REGISTRY[name]


def load(path: str | Path) -> None:
    """Run a Python file of one's own that registers observables.

    Raises
    ------
    InputError
        If the file cannot be read or ends with an error.
    """
    spec = importlib.util.spec_from_file_location(f"observables_of_{Path(path).stem}", path)
    if spec is None or spec.loader is None:
        raise InputError(path, "must be a Python file (.py) that registers observables")
    module = importlib.util.module_from_spec(spec)
    before = dict(REGISTRY)
    try:
        spec.loader.exec_module(module)
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror}") from error
    except Exception as error:  # whatever a user's file does
        raise InputError(path, f"ended with {type(error).__name__}: {error}") from error
    source = hashlib.sha256(Path(path).read_bytes()).hexdigest()
    for name, own in REGISTRY.items():
        if before.get(name) is not own:
            REGISTRY[name] = replace(own, source=source)


def check_frame(frame: Frame, names: Sequence[str]) -> None:
    """Refuse a frame that lacks what observables need.

    Raises
    ------
    InputError
        With the observable, what it needs and what there is.
    """
    for name in names:
        for what, needed, there in (
            ("column", find(name).columns, frame.columns),
            ("number of the run", find(name).of_run, frame.run),
        ):
            for word in needed:
                if word not in there:
                    known = ", ".join(there) or "none"
                    raise InputError(
                        frame.path, f"no {what} {word!r}, which observable {name!r} needs; there are {known}"
                    )


def columns_of(names: Sequence[str]) -> tuple[str, ...]:
    """The columns that observables need, with those that tell the primary particles."""
    needed = [column for name in names for column in find(name).columns]
    return tuple(dict.fromkeys(["n", "type", *needed]))


for _observable in (
    Observable("count", "clusters", "", _single(lambda frame: float(len(frame)))),
    Observable("clusters", "N", "1/kg", _single(_per_mass)),
    Observable("mass", "mass", "kg", _single(lambda frame: float(frame.mass.sum()))),
    Observable("mean_diameter", "mean d", "m", _single(lambda frame: mean_diameter(frame.diameter))),
    Observable("mass_mean_diameter", "mean d by mass", "m", _single(lambda f: mean_diameter(f.diameter, f.mass))),
    Observable("sauter_diameter", "Sauter d", "m", _single(lambda frame: sauter_diameter(frame.diameter))),
    Observable("smallest_diameter", "smallest d", "m", _single(_extreme(np.min))),
    Observable("largest_diameter", "largest d", "m", _single(_extreme(np.max))),
    Observable(
        "size_classes", "share", "%", lambda frame, how: class_shares(frame.diameter, how.borders), _classes, False
    ),
    Observable(
        "mass_classes",
        "share of mass",
        "%",
        lambda frame, how: class_shares(frame.diameter, how.borders, frame.mass),
        _classes,
        False,
    ),
    Observable("map", "map", "", lambda frame, how: solids_fraction(frame, how.grid(frame)).ravel()),
    Observable(
        "densest_cell",
        "densest cell",
        "",
        lambda frame, how: np.array([solids_fraction(frame, how.grid(frame)).max()]),
    ),
    Observable("dispersion", "dispersion", "", _dispersion),
    Observable("lateral_fraction", "lateral fraction", "", _lateral_fraction),
    Observable(
        "granular_temperature",
        "granular temperature",
        "m²/s²",
        lambda frame, how: np.array([velocity_moments(frame, how.plane).temperature]),
        columns=("vx", "vy", "vz"),
    ),
    Observable("largest_group", "largest group that touches", "", _single(_largest_group), columns=("y",)),
    Observable(
        "strip_diameter",
        "mean d in strip",
        "m",
        lambda frame, how: strips(frame, how.strips, how.plane, False).diameter,
        _numbered_strips,
    ),
    Observable("timestep", "time step", "s", _of_run("dt"), of_run=("dt",)),
    Observable("core_seconds", "core-seconds", "s", _of_run("core_seconds"), of_run=("core_seconds",)),
):
    register(_observable)
