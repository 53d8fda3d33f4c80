"""Study files (TOML): what all of them have, and refusals that name key, value and rule."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import observables
from ..analysis.sizes import check_borders
from ..errors import ArgumentError, InputError
from ..published.cases import CLASS_BORDERS, case_of
from .expression import expression
from .launch import check_launcher
from .schema import Schema, check, unknown

Variables = dict[str, str]
"""LAMMPS index variables by name, each given as ``-var NAME VALUE``."""


class Written(float):
    """A number that remembers how it was written: LAMMPS and the tables get ``1e-6``, not ``1e-06``."""

    def __new__(cls, text: str) -> Written:
        number = super().__new__(cls, text)
        number.text = text
        return number

    text: str

    def __repr__(self) -> str:
        return self.text


def load_table(path: Path, schema: Schema, variables: Variables | None = None, **over: object) -> dict[str, Any]:
    """The table of a study file, checked by its schema.

    Parameters
    ----------
    path : Path
        The file.
    schema : dict
        What it may hold.
    variables : dict of str to str, optional
        Variables of every run, over those of the file.
    **over
        Values of keys in place of the file's; None leaves the file's.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"), parse_float=Written)
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is not a text file (UTF-8)") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(path, f"is not TOML: {error}") from error
    table |= {key: value for key, value in over.items() if value is not None}
    if variables and isinstance(table.setdefault("variables", {}), dict):
        table["variables"] |= variables
    check(path, table, schema)
    return table


@dataclass
class StudyReader:
    """A study file's table, checked by its schema; what a schema cannot know is checked here.

    Parameters
    ----------
    path : Path
        The file.
    table : dict
        What it holds.
    """

    path: Path
    table: dict[str, Any]

    def refuse(self, key: str, value: object, rule: str) -> InputError:
        """The error for a value that breaks a rule."""
        return InputError(self.path, f"{key} = {value!r}: {rule}")

    def input(self, table: dict[str, Any]) -> Path:
        """The LAMMPS input script of a table."""
        script: Path = (self.path.parent / table["input"]).resolve()
        if not script.is_file():
            raise self.refuse("input", table["input"], "no such file (relative to the study file)")
        return script

    def seeds(self, given: int | list[int]) -> tuple[int, ...]:
        """Seeds, given by how many or as a list."""
        return tuple(range(1, given + 1) if isinstance(given, int) else given)

    def launcher(self) -> str | None:
        """What starts the runs; its words are checked."""
        given: str | None = self.table.get("launcher")
        if given is not None:
            try:
                check_launcher(given)
            except ArgumentError as error:
                raise self.refuse("launcher", given, error.rule) from None
        return given

    def own_observables(self) -> None:
        """Register the observables of one's own: expressions of the study, and what its Python file registers."""
        for own in self.table.get("observable", []):
            try:
                observables.register(expression(**own))
            except ArgumentError as error:
                raise self.refuse(f"observable {own['name']!r}.value", own["value"], error.rule) from None
        name = self.table.get("observables_file")
        if name is None:
            return
        if not (self.path.parent / name).is_file():
            raise self.refuse("observables_file", name, "no such file (relative to the study file)")
        observables.load(self.path.parent / name)

    def observable(self, key: str, name: str) -> str:
        """The name of an observable that there is."""
        if name not in observables.REGISTRY:
            raise self.refuse(key, name, unknown("observable", name, observables.REGISTRY))
        return name

    def classes(self, inputs: Sequence[Path]) -> tuple[float, ...]:
        """Borders of the size classes (m): the study's, or the paper's where all inputs are its cases; empty if open."""
        given = self.table.get("classes")
        if given is None:
            return CLASS_BORDERS if all(case_of(path.stem) for path in inputs) else ()
        borders = tuple(1e-6 * float(border) for border in given)
        try:
            check_borders(borders)
        except ArgumentError as error:
            raise self.refuse("classes", given, error.rule) from None
        return borders

    def variables(self, given: dict[str, Any]) -> Variables:
        """A table of LAMMPS variables, as they follow -var."""
        return {name: str(value) for name, value in given.items()}
