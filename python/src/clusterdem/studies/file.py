"""Study files (TOML): what all of them have, and refusals that name key, value and rule."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import observables
from ..analysis.sizes import check_borders
from ..errors import ArgumentError, InputError
from ..published.cases import CLASS_BORDERS, case_of

Variables = dict[str, str]
"""LAMMPS index variables by name, each given as ``-var NAME VALUE``."""

OWN_VARIABLES = ("seed", "inputs", "outdir")
"""Variables that the study itself sets for every run."""


class Written(float):
    """A number that remembers how it was written: LAMMPS and the tables get ``1e-6``, not ``1e-06``."""

    def __new__(cls, text: str) -> Written:
        number = super().__new__(cls, text)
        number.text = text
        return number

    text: str

    def __repr__(self) -> str:
        return self.text


def load_table(path: Path) -> dict[str, Any]:
    """The table of a study file."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"), parse_float=Written)
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is not a text file (UTF-8)") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(path, f"is not TOML: {error}") from error


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


@dataclass
class StudyReader:
    """A study file's table being checked.

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

    def only(self, keys: tuple[str, ...], table: dict[str, Any], where: str = "") -> None:
        """Refuse keys that nobody reads."""
        for key in table:
            if key not in keys:
                raise InputError(self.path, f"{where}unknown key {key!r}: the keys are {', '.join(keys)}")

    def count(self, key: str, given: object) -> int:
        """A whole number, 1 or more."""
        if type(given) is not int or given < 1:
            raise self.refuse(key, given, "must be a whole number, 1 or more")
        return given

    def input(self, table: dict[str, Any]) -> Path:
        """The LAMMPS input script of a table."""
        name = table.get("input")
        if not isinstance(name, str):
            raise InputError(self.path, "input: must name the LAMMPS input script, relative to the study file")
        script = (self.path.parent / name).resolve()
        if not script.is_file():
            raise self.refuse("input", name, "no such file (relative to the study file)")
        return script

    def seeds(self, given: object, fewest: int, key: str = "seeds") -> tuple[int, ...]:
        """Seeds, given by how many or as a list."""
        seeds = list(range(1, given + 1)) if type(given) is int and given < 10**6 else given
        if not isinstance(seeds, list) or not all(type(seed) is int and 0 < seed < 2**31 for seed in seeds):
            raise self.refuse(key, given, "must be how many, or a list of positive whole numbers below 2^31")
        if len(set(seeds)) < len(seeds):
            raise self.refuse(key, given, "must all differ")
        if len(seeds) < fewest:
            raise self.refuse(key, given, f"fewer than {fewest} show no spread between seeds")
        return tuple(seeds)

    def own_observables(self, table: dict[str, Any]) -> None:
        """Run the file of one's own that registers observables, where the study names one."""
        name = table.get("observables_file")
        if name is None:
            return
        if not isinstance(name, str) or not (self.path.parent / name).is_file():
            raise self.refuse("observables_file", name, "no such file (relative to the study file)")
        observables.load(self.path.parent / name)

    def classes(self, table: dict[str, Any], inputs: Sequence[Path]) -> tuple[float, ...]:
        """Borders of the size classes (m): the study's, or the paper's where all inputs are its cases; empty if open."""
        given = table.get("classes")
        if given is None:
            return CLASS_BORDERS if all(case_of(path.stem) for path in inputs) else ()
        if not isinstance(given, list) or not given or not all(_is_number(border) for border in given):
            raise self.refuse("classes", given, "must be a list of borders of size classes (µm)")
        borders = tuple(1e-6 * float(border) for border in given)
        try:
            check_borders(borders)
        except ArgumentError as error:
            raise self.refuse("classes", given, error.rule) from None
        return borders

    def plane(self, table: dict[str, Any]) -> str:
        """The plane of maps and profiles."""
        plane = table.get("plane", "xz")
        if not isinstance(plane, str) or len(plane) != 2 or len(set(plane)) != 2 or not set(plane) <= set("xyz"):
            raise self.refuse("plane", plane, "must be two of x, y, z, such as 'xz'")
        return plane

    def variables(self, where: str, given: object) -> Variables:
        """A table of LAMMPS variables."""
        if not isinstance(given, dict):
            raise self.refuse(where, given, "must be a table of variables")
        return {name: self.value(where, name, value) for name, value in given.items()}

    def value(self, where: str, name: str, value: object) -> str:
        """A variable's value as it follows -var."""
        if not re.fullmatch(r"\w+", name, re.ASCII):
            raise self.refuse(where, name, "a LAMMPS variable's name holds letters, digits and underscores only")
        if name in OWN_VARIABLES:
            raise self.refuse(f"{where}.{name}", value, "is set by the study itself (seeds by the key seeds)")
        if isinstance(value, bool) or not isinstance(value, (str, int, float)):
            raise self.refuse(f"{where}.{name}", value, "must be a number or a text, as after -var")
        if not str(value).strip() or "\n" in str(value):
            raise self.refuse(f"{where}.{name}", value, "must be one line that is not empty")
        return str(value)
