"""Tables of points: CSV of any program, ParaView's and CFD-Post's CSV, Fluent's ASCII export."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .quantities import plain
from .sources import Source, from_points

SUFFIXES = (".csv", ".tsv", ".txt", ".asc", ".xy", ".raw", "")
COORDINATES = (
    ("x", "y", "z"),
    ("xcoordinate", "ycoordinate", "zcoordinate"),  # Fluent
    ("points0", "points1", "points2"),  # ParaView
    ("pointx", "pointy", "pointz"),
    ("coordinatex", "coordinatey", "coordinatez"),
    ("centroidx", "centroidy", "centroidz"),
    ("centroid[x]", "centroid[y]", "centroid[z]"),
    ("ccx", "ccy", "ccz"),
)
"""Names of the coordinates as :func:`plain` has them."""
MOST_HEAD_LINES = 100
UNIT = re.compile(r"\s*(?:\(([^()]*)\)|\[(?![ijk]\])([^\[\]]*)\])$")
SPELLINGS = {"m s^-1": "m/s", "m s-1": "m/s", "cm s^-1": "cm/s", "mm s^-1": "mm/s", "ms-1": "m/s", "micron": "um"}


def _fields(line: str) -> tuple[list[str], str | None, list[str]]:
    """Names in a heading, what separates them (None: blanks), and their units ("" for none)."""
    line = line.strip().lstrip("#%").strip()
    separator = next((mark for mark in (",", ";", "\t") if mark in line), None)
    if separator is None:  # a unit belongs to the name before it
        line = re.sub(r"\s+([(\[])", r"\1", line)
    names: list[str] = []
    units: list[str] = []
    for word in line.split(separator):
        word = word.strip().strip('"').strip()
        unit = UNIT.search(word)
        text = (unit.group(1) or unit.group(2) or "").strip() if unit else ""
        units.append(SPELLINGS.get(text, text))
        names.append(UNIT.sub("", word))
    return names, separator, units


def _coordinates(names: list[str]) -> list[str | None] | None:
    """The columns of x, y and z; None for one that a plane does not need; None if these are no coordinates."""
    known: dict[str, str] = {}
    for name in names:
        known.setdefault(plain(name), name)
    for kind in COORDINATES:
        found = [known.get(name) for name in kind]
        if sum(name is not None for name in found) >= 2:
            return found
    return None


@dataclass(frozen=True)
class _Heading:
    line: int
    names: list[str]
    separator: str | None
    units: list[str]
    places: list[str | None]


def _heading(path: Path, head: list[str]) -> _Heading:
    for number, line in enumerate(head, start=1):
        names, separator, units = _fields(line)
        if (places := _coordinates(names)) is not None:
            return _Heading(number, names, separator, units, places)
    if path.suffix == ".xy":
        return _foam_set(path, head)
    rule = "needs a heading with the coordinates: x y z, or x-coordinate …, or Points:0 …, and the arrays' names"
    raise InputError(path, rule)


def _foam_set(path: Path, head: list[str]) -> _Heading:
    """A set that OpenFOAM sampled in format raw: SET_FIELD_FIELD.xy, three coordinates and no heading."""
    rows = [line.split() for line in head if line.strip() and not line.startswith("#")]
    fields = path.stem.split("_")[1:]
    columns = len(rows[0]) if rows else 0
    each, rest = divmod(columns - 3, max(len(fields), 1))
    if not fields or columns < 4 or rest or each not in (1, 3, 6, 9):
        rule = "needs a heading, or the form of OpenFOAM's sets: SET_FIELD.xy with x y z and the field in its columns"
        raise InputError(path, f"{rule} (axis xyz), not {columns} columns")
    parts = [""] if each == 1 else [f"_{k}" for k in range(each)]
    names = ["x", "y", "z", *(f"{name}{part}" for name in fields for part in parts)]
    return _Heading(0, names, None, [""] * len(names), ["x", "y", "z"])


def read_table(path: str | Path) -> Source:
    """Read a table with a heading; lines before it are passed over.

    Columns ``x y z`` (two of them for a plane) or as Fluent, CFD-Post and ParaView name them hold the coordinates.
    Every other column is an array, named as in the heading; ``name:0 name:1 name:2`` are also one vector ``name``.
    """
    path = Path(path)
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            head = [line for _, line in zip(range(MOST_HEAD_LINES), file)]
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror or error}") from error
    heading = _heading(path, head)
    names, number = heading.names, heading.line
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(path, f"two columns have the name '{twice}'", number)
    try:
        rows = np.loadtxt(
            path, delimiter=heading.separator, skiprows=number, ndmin=2, encoding="utf-8-sig", comments=None
        )
    except ValueError as error:
        raise InputError(path, f"below the heading, line {number}, must be numbers only: {error}") from error
    if rows.shape[0] == 0 or rows.shape[1] != len(names):
        raise InputError(
            path, f"{rows.shape[1]} columns of {rows.shape[0]} rows below a heading of {len(names)}", number
        )
    units = {name: unit for name, unit in zip(names, heading.units) if unit}
    columns = dict(zip(names, rows.T))
    points = np.stack([np.zeros(len(rows)) if name is None else columns.pop(name) for name in heading.places], axis=1)
    if not np.all(np.isfinite(points)):
        row = int(np.argmin(np.isfinite(points).all(axis=1)))
        raise InputError(path, "coordinates must be finite", number + 1 + row)
    source = from_points(str(path), points, {**columns, **_vectors(columns)})
    of_places = {units.get(name, "") for name in heading.places if name is not None}
    source.units = {**units, "": of_places.pop()} if len(of_places) == 1 else units
    return source


def _vectors(columns: dict[str, Floats]) -> dict[str, Floats]:
    found = {}
    for name in columns:
        stem, mark = name[:-2], name[-2:]
        parts = [f"{stem}{mark[0]}{k}" for k in range(3)]
        if mark in (":0", "_0", ".0") and stem and all(part in columns for part in parts):
            found[stem] = np.stack([columns[part] for part in parts], axis=1)
    return found
