"""The study file (TOML): which input, which switches, which seeds, which observables."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...observables import How
from ...published.cases import CELL, case_of
from ..file import StudyReader, Variables, load_table
from .observe import DEFAULT
from .schema import ONE_AT_A_TIME, PRODUCT, SCHEMA

DEFAULT_SEEDS = 5


@dataclass(frozen=True)
class Option:
    """One setting of an axis: its name and its variables."""

    name: str
    variables: Variables


@dataclass(frozen=True)
class Axis:
    """A choice to weigh.

    Parameters
    ----------
    name : str
        What is chosen.
    options : tuple of Option
        The most careful first.
    """

    name: str
    options: tuple[Option, ...]


@dataclass(frozen=True)
class Study:
    """What a study file says.

    Parameters
    ----------
    path, input : Path
        The study file; the input script.
    axes : tuple of Axis
        The choices.
    seeds : tuple of int
        Every setting runs with each of them, as variable ``seed``.
    variables : dict of str to str
        Variables of every run.
    ranks : int
        MPI ranks of a run.
    product : bool
        All combinations of the axes, instead of one axis at a time.
    observables : tuple of str
        Names of what is compared.
    how : How
        How they are measured: cells, size classes, plane; what is open follows from the reference's frames.
    launcher : str or None
        What starts a run (:mod:`clusterdem.studies.launch`).
    """

    path: Path
    input: Path
    axes: tuple[Axis, ...]
    seeds: tuple[int, ...]
    variables: Variables
    ranks: int
    product: bool
    observables: tuple[str, ...]
    how: How
    launcher: str | None = None


def read_study(path: str | Path, variables: Variables | None = None, **over: Any) -> Study:
    """Read and check a study file; the message of a refusal names key, value and rule.

    Parameters
    ----------
    path : str or Path
        The file.
    variables : dict of str to str, optional
        Variables of every run, over those of the file.
    **over
        Values of the keys ``seeds``, ``ranks`` and ``launcher`` in place of the file's.
    """
    path = Path(path)
    return _Reader(path, load_table(path, SCHEMA, variables, **over)).study()


class _Reader(StudyReader):
    def study(self) -> Study:
        script = self.input(self.table)
        variables = self.variables(self.table.get("variables", {}))
        axes = (*self.switches(), *self.named_axes())
        if not axes:
            raise InputError(self.path, "no axis: [switches] or [[axis]] must name settings to weigh")
        self.check_axes(axes, variables)
        self.own_observables()
        names = [self.observable("observables", name) for name in self.table.get("observables", DEFAULT)]
        plane = self.table.get("plane", "xz")
        return Study(
            self.path,
            script,
            axes,
            self.seeds(self.table.get("seeds", DEFAULT_SEEDS)),
            variables,
            self.table.get("ranks", 1),
            self.table.get("combine", ONE_AT_A_TIME) == PRODUCT,
            tuple(dict.fromkeys(names)),
            How(self.cell(script), self.classes([script]), plane=plane),
            self.launcher(),
        )

    def cell(self, script: Path) -> tuple[float, float] | None:
        if "cell" not in self.table:
            return CELL if case_of(script.stem) else None
        width, height = map(float, self.table["cell"])
        return width, height

    def switches(self) -> list[Axis]:
        axes = []
        for name, values in self.table.get("switches", {}).items():
            axes.append(Axis(name, tuple(Option(f"{name} = {text}", {name: text}) for text in map(str, values))))
        return axes

    def named_axes(self) -> list[Axis]:
        axes = []
        for axis in self.table.get("axis", []):
            options = []
            for setting in axis["settings"]:
                rest = {key: value for key, value in setting.items() if key != "name"}
                options.append(Option(setting["name"], self.variables(rest)))
            axes.append(Axis(axis["name"], tuple(options)))
        return axes

    def check_axes(self, axes: tuple[Axis, ...], variables: Variables) -> None:
        taken = dict.fromkeys(variables, "[variables]")
        if len({axis.name for axis in axes}) < len(axes):
            raise self.refuse("axis", [axis.name for axis in axes], "axes need names that all differ")
        for axis in axes:
            names = [option.name for option in axis.options]
            if len(names) < 2 or len(set(names)) < len(names):
                raise self.refuse(f"axis {axis.name!r}", names, "needs two settings or more, all different")
            for name in dict.fromkeys(name for option in axis.options for name in option.variables):
                if name in taken:
                    raise self.refuse(f"axis {axis.name!r}", name, f"this variable is already set by {taken[name]}")
                taken[name] = f"axis {axis.name!r}"
