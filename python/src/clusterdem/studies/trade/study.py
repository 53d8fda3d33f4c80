"""The study file (TOML): which input, which switches, which seeds, which observables."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ...errors import InputError
from ...observables import REGISTRY, How
from ...published.cases import CELL, case_of
from ..file import StudyReader, Variables, load_table
from .observe import DEFAULT

ONE_AT_A_TIME, PRODUCT = "one at a time", "product"
DEFAULT_SEEDS = 5
FEWEST_SEEDS = 3
KEYS = (
    "input", "seeds", "ranks", "combine", "observables", "observables_file", "cell", "classes", "plane", "variables", "switches", "axis",
)  # fmt: skip


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


def read_study(path: str | Path, variables: Variables | None = None, seeds: int | None = None) -> Study:
    """Read and check a study file; the message of a refusal names key, value and rule.

    Parameters
    ----------
    path : str or Path
        The file.
    variables : dict of str to str, optional
        Variables of every run, over those of the file.
    seeds : int, optional
        How many seeds, in place of those of the file.
    """
    path = Path(path)
    table = load_table(path)
    if seeds is not None:
        table["seeds"] = seeds
    if variables and isinstance(table.setdefault("variables", {}), dict):
        table["variables"] |= variables
    return _Reader(path, table).study()


class _Reader(StudyReader):
    def study(self) -> Study:
        self.only(KEYS, self.table)
        script = self.input(self.table)
        variables = self.variables("variables", self.table.get("variables", {}))
        axes = (*self.switches(), *self.named_axes())
        if not axes:
            raise InputError(self.path, "no axis: [switches] or [[axis]] must name settings to weigh")
        self.check_axes(axes, variables)
        combine = self.table.get("combine", ONE_AT_A_TIME)
        if combine not in (ONE_AT_A_TIME, PRODUCT):
            raise self.refuse("combine", combine, f"must be {ONE_AT_A_TIME!r} or {PRODUCT!r}")
        return Study(
            self.path,
            script,
            axes,
            self.seeds(self.table.get("seeds", DEFAULT_SEEDS), FEWEST_SEEDS),
            variables,
            self.count("ranks", self.table.get("ranks", 1)),
            combine == PRODUCT,
            self.observables(),
            How(self.cell(script), self.classes(self.table, [script]), plane=self.plane(self.table)),
        )

    def observables(self) -> tuple[str, ...]:
        self.own_observables(self.table)
        names = self.table.get("observables", list(DEFAULT))
        if not isinstance(names, list) or not names:
            raise self.refuse("observables", names, "must be a list of names")
        for name in names:
            if not isinstance(name, str) or name not in REGISTRY:
                raise self.refuse("observables", name, f"must be among {', '.join(REGISTRY)}")
        return tuple(dict.fromkeys(names))

    def cell(self, script: Path) -> tuple[float, float] | None:
        if "cell" not in self.table:
            return CELL if case_of(script.stem) else None
        size = self.table["cell"]
        if (
            not isinstance(size, list)
            or len(size) != 2
            or any(isinstance(edge, bool) or not isinstance(edge, (int, float)) for edge in size)
            or not all(0 < edge < float("inf") for edge in size)
        ):
            raise self.refuse("cell", size, "must be the width and height of a map's cell, two positive numbers (m)")
        return float(size[0]), float(size[1])

    def switches(self) -> list[Axis]:
        given = self.table.get("switches", {})
        if not isinstance(given, dict):
            raise self.refuse("switches", given, "must be a table NAME = [values], the most careful first")
        axes = []
        for name, values in given.items():
            if not isinstance(values, list):
                raise self.refuse(f"switches.{name}", values, "must be a list of values, the most careful first")
            texts = [self.value("switches", name, value) for value in values]
            axes.append(Axis(name, tuple(Option(f"{name} = {text}", {name: text}) for text in texts)))
        return axes

    def named_axes(self) -> list[Axis]:
        given = self.table.get("axis", [])
        if not isinstance(given, list) or not all(isinstance(axis, dict) for axis in given):
            raise self.refuse("axis", given, "must be written as [[axis]]")
        axes = []
        for axis in given:
            name, settings = axis.get("name"), axis.get("settings")
            if not isinstance(name, str) or not name:
                raise self.refuse("axis.name", name, "must be a text")
            if set(axis) - {"name", "settings"}:
                raise self.refuse("axis", sorted(set(axis) - {"name", "settings"}), "has name and settings only")
            if not isinstance(settings, list) or not all(isinstance(setting, dict) for setting in settings):
                raise self.refuse(f"axis {name!r} settings", settings, "must be a list of {name = …, VARIABLE = …}")
            options = []
            for setting in settings:
                label = setting.get("name")
                if not isinstance(label, str) or not label:
                    raise self.refuse(f"axis {name!r} settings", setting, "each needs a name")
                rest = {key: value for key, value in setting.items() if key != "name"}
                options.append(Option(label, self.variables(f"axis {name!r} {label!r}", rest)))
            axes.append(Axis(name, tuple(options)))
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
