"""The study file (TOML): which input, which switches, which seeds, which observables."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from .observables import CELL, OBSERVABLES

Variables = dict[str, str]
"""LAMMPS index variables by name, each given as ``-var NAME VALUE``."""

OWN_VARIABLES = ("seed", "inputs", "outdir")
"""Variables that the study itself sets for every run."""

ONE_AT_A_TIME, PRODUCT = "one at a time", "product"
DEFAULT_SEEDS = 5
FEWEST_SEEDS = 3
KEYS = ("input", "seeds", "ranks", "combine", "observables", "cell", "variables", "switches", "axis")


class Written(float):
    """A number that remembers how it was written: LAMMPS and the tables get ``1e-6``, not ``1e-06``."""

    def __new__(cls, text: str) -> Written:
        number = super().__new__(cls, text)
        number.text = text
        return number

    text: str

    def __repr__(self) -> str:
        return self.text


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
    cell : (float, float)
        Width and height of a map's cell (m).
    """

    path: Path
    input: Path
    axes: tuple[Axis, ...]
    seeds: tuple[int, ...]
    variables: Variables
    ranks: int
    product: bool
    observables: tuple[str, ...]
    cell: tuple[float, float]


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
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"), parse_float=Written)
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is not a text file (UTF-8)") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(path, f"is not TOML: {error}") from error
    if seeds is not None:
        table["seeds"] = seeds
    if variables and isinstance(table.setdefault("variables", {}), dict):
        table["variables"] |= variables
    return _Reader(path, table).study()


@dataclass
class _Reader:
    path: Path
    table: dict[str, Any]

    def refuse(self, key: str, value: object, rule: str) -> InputError:
        return InputError(self.path, f"{key} = {value!r}: {rule}")

    def study(self) -> Study:
        for key in self.table:
            if key not in KEYS:
                raise InputError(self.path, f"unknown key {key!r}: the keys are {', '.join(KEYS)}")
        variables = self.variables("variables", self.table.get("variables", {}))
        axes = (*self.switches(), *self.named_axes())
        if not axes:
            raise InputError(self.path, "no axis: [switches] or [[axis]] must name settings to weigh")
        self.check_axes(axes, variables)
        combine = self.table.get("combine", ONE_AT_A_TIME)
        if combine not in (ONE_AT_A_TIME, PRODUCT):
            raise self.refuse("combine", combine, f"must be {ONE_AT_A_TIME!r} or {PRODUCT!r}")
        ranks = self.table.get("ranks", 1)
        if type(ranks) is not int or ranks < 1:
            raise self.refuse("ranks", ranks, "must be a whole number, 1 or more")
        return Study(
            self.path,
            self.input(),
            axes,
            self.seeds(),
            variables,
            ranks,
            combine == PRODUCT,
            self.observables(),
            self.cell(),
        )

    def input(self) -> Path:
        name = self.table.get("input")
        if not isinstance(name, str):
            raise InputError(self.path, "input: must name the LAMMPS input script, relative to the study file")
        script = (self.path.parent / name).resolve()
        if not script.is_file():
            raise self.refuse("input", name, "no such file (relative to the study file)")
        return script

    def seeds(self) -> tuple[int, ...]:
        given = self.table.get("seeds", DEFAULT_SEEDS)
        seeds = list(range(1, given + 1)) if type(given) is int and given < 10**6 else given
        if not isinstance(seeds, list) or not all(type(seed) is int and 0 < seed < 2**31 for seed in seeds):
            raise self.refuse("seeds", given, "must be how many, or a list of positive whole numbers below 2^31")
        if len(set(seeds)) < len(seeds):
            raise self.refuse("seeds", given, "must all differ")
        if len(seeds) < FEWEST_SEEDS:
            raise self.refuse("seeds", given, f"fewer than {FEWEST_SEEDS} show no spread between seeds")
        return tuple(seeds)

    def observables(self) -> tuple[str, ...]:
        names = self.table.get("observables", list(OBSERVABLES))
        if not isinstance(names, list) or not names:
            raise self.refuse("observables", names, "must be a list of names")
        for name in names:
            if name not in OBSERVABLES:
                raise self.refuse("observables", name, f"must be among {', '.join(OBSERVABLES)}")
        return tuple(dict.fromkeys(names))

    def cell(self) -> tuple[float, float]:
        size = self.table.get("cell", list(CELL))
        if (
            not isinstance(size, list)
            or len(size) != 2
            or any(isinstance(edge, bool) or not isinstance(edge, (int, float)) for edge in size)
            or not all(0 < edge < float("inf") for edge in size)
        ):
            raise self.refuse("cell", size, "must be the width and height of a map's cell, two positive numbers (m)")
        return float(size[0]), float(size[1])

    def variables(self, where: str, given: object) -> Variables:
        if not isinstance(given, dict):
            raise self.refuse(where, given, "must be a table of variables")
        return {name: self.value(where, name, value) for name, value in given.items()}

    def value(self, where: str, name: str, value: object) -> str:
        if not re.fullmatch(r"\w+", name, re.ASCII):
            raise self.refuse(where, name, "a LAMMPS variable's name holds letters, digits and underscores only")
        if name in OWN_VARIABLES:
            raise self.refuse(f"{where}.{name}", value, "is set by the study itself (seeds by the key seeds)")
        if isinstance(value, bool) or not isinstance(value, (str, int, float)):
            raise self.refuse(f"{where}.{name}", value, "must be a number or a text, as after -var")
        if not str(value).strip() or "\n" in str(value):
            raise self.refuse(f"{where}.{name}", value, "must be one line that is not empty")
        return str(value)

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
