"""Tables of points: CSV of any program, ParaView's and CFD-Post's CSV, Fluent's ASCII export."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .sources import Source, from_points

SUFFIXES = (".csv", ".tsv", ".txt", ".asc", ".xy", "")
COORDINATES = (
    ("x", "y", "z"),
    ("x-coordinate", "y-coordinate", "z-coordinate"),  # Fluent
    ("points:0", "points:1", "points:2"),  # ParaView, and points_0 of its later versions
    ("points_0", "points_1", "points_2"),
    ("point_x", "point_y", "point_z"),
)
MOST_HEAD_LINES = 100


def _fields(line: str) -> tuple[list[str], str | None]:
    """Names in a heading, and what separates them (None: blanks)."""
    line = line.strip().lstrip("#%").strip()
    separator = next((mark for mark in (",", ";", "\t") if mark in line), None)
    names = [name.strip().strip('"').strip() for name in line.split(separator)]
    return [re.sub(r"\s*\[.*\]$", "", name) for name in names], separator  # CFD-Post: X [ m ]


def _coordinates(names: list[str]) -> list[str | None] | None:
    """The columns of x, y and z; None for one that a plane does not need; None if these are no coordinates."""
    lower = {name.lower(): name for name in names}
    for kind in COORDINATES:
        found = [lower.get(name) for name in kind]
        if sum(name is not None for name in found) >= 2:
            return found
    return None


def _heading(path: str | Path, head: list[str]) -> tuple[int, list[str], str | None, list[str | None]]:
    """Its line, all names, what separates them, and those of the coordinates."""
    for number, line in enumerate(head, start=1):
        names, separator = _fields(line)
        if (places := _coordinates(names)) is not None:
            return number, names, separator, places
    rule = "needs a heading with the coordinates: x y z, or x-coordinate …, or Points:0 …, and the arrays' names"
    raise InputError(path, rule)


def read_table(path: str | Path) -> Source:
    """Read a table with a heading; lines before it are passed over.

    Columns ``x y z`` (two of them for a plane) or as Fluent, CFD-Post and ParaView name them hold the coordinates.
    Every other column is an array, named as in the heading; ``name:0 name:1 name:2`` are also one vector ``name``.
    """
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            head = [line for _, line in zip(range(MOST_HEAD_LINES), file)]
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror or error}") from error
    number, names, separator, places = _heading(path, head)
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(path, f"two columns have the name '{twice}'", number)
    try:
        rows = np.loadtxt(path, delimiter=separator, skiprows=number, ndmin=2, encoding="utf-8-sig", comments=None)
    except ValueError as error:
        raise InputError(path, f"below the heading, line {number}, must be numbers only: {error}") from error
    if rows.shape[0] == 0 or rows.shape[1] != len(names):
        raise InputError(
            path, f"{rows.shape[1]} columns of {rows.shape[0]} rows below a heading of {len(names)}", number
        )
    columns = dict(zip(names, rows.T))
    points = np.stack([np.zeros(len(rows)) if name is None else columns.pop(name) for name in places], axis=1)
    if not np.all(np.isfinite(points)):
        row = int(np.argmin(np.isfinite(points).all(axis=1)))
        raise InputError(path, "coordinates must be finite", number + 1 + row)
    return from_points(str(path), points, {**columns, **_vectors(columns)})


def _vectors(columns: dict[str, Floats]) -> dict[str, Floats]:
    found = {}
    for name in columns:
        stem, mark = name[:-2], name[-2:]
        parts = [f"{stem}{mark[0]}{k}" for k in range(3)]
        if mark in (":0", "_0") and stem and all(part in columns for part in parts):
            found[stem] = np.stack([columns[part] for part in parts], axis=1)
    return found
