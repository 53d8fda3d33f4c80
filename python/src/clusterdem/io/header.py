"""The header of one frame: everything from ``ITEM: TIMESTEP`` to ``ITEM: ATOMS``."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import InputError
from ..frame import Box
from .streams import LineSource

MAX_CLUSTERS = 10**10
LARGEST = 1e100
"""No number of a dump may reach this: sums and squares must stay finite."""


@dataclass(frozen=True)
class Header:
    """What precedes the rows of a frame.

    Parameters
    ----------
    step : int
        Timestep number.
    time : float
        Physical time (s), NaN if absent.
    count : int
        Number of rows that follow.
    box : Box
        The box (m).
    names : tuple of str
        Column names, as written.
    line : int
        Line of ``ITEM: TIMESTEP``; ``names_line`` that of ``ITEM: ATOMS``.
    cells : tuple of int, or None
        Numbers of cells along x, y, z where the rows are cells (dump style grid), not atoms.
    """

    step: int
    time: float
    count: int
    box: Box
    names: tuple[str, ...]
    line: int
    names_line: int
    cells: tuple[int, int, int] | None = None


def _integer(source: LineSource, what: str) -> int:
    text = source.readline()
    try:
        if b"_" in text:
            raise ValueError
        return int(text)
    except ValueError:
        raise InputError(source.path, f"{what} must be one whole number", source.line) from None


def number(text: bytes) -> float:
    """A float as C writes it (no underscores, which Python alone accepts)."""
    if b"_" in text:
        raise ValueError(text)
    return float(text)


def _box(source: LineSource, flags: list[str]) -> Box:
    boundary = [flag for flag in flags if len(flag) == 2 and set(flag) <= set("pfsm")]
    if len(boundary) != len(flags) or len(boundary) not in (0, 3):
        raise InputError(
            source.path, "only an orthogonal box can be read: BOX BOUNDS pp pp pp or the like", source.line
        )
    bounds = []
    for axis in "xyz":
        try:
            lo, hi = (number(word) for word in source.readline().split())
        except ValueError:
            raise InputError(source.path, f"box bounds along {axis} must be two numbers", source.line) from None
        if not (1e-6 <= hi - lo <= 1e6 and abs(lo) <= 1e6):
            raise InputError(
                source.path, f"the box must be 1e-6 to 1e6 m long along {axis}, lower bound first", source.line
            )
        bounds.append((lo, hi))
    periodic = [flag == "pp" for flag in boundary] or [False, False, False]  # nothing says that it repeats
    (xlo, xhi), (ylo, yhi), (zlo, zhi) = bounds
    return Box((xlo, ylo, zlo), (xhi, yhi, zhi), (periodic[0], periodic[1], periodic[2]))


def _cells(source: LineSource) -> tuple[int, int, int]:
    try:
        nx, ny, nz = (int(word) for word in source.readline().split())
        if min(nx, ny, nz) < 1 or nx * ny * nz > MAX_CLUSTERS:
            raise ValueError
    except ValueError:
        raise InputError(
            source.path, "the grid's size must be three numbers of cells, 1 or more", source.line
        ) from None
    return nx, ny, nz


OTHER_KINDS = (
    (b"# vtk DataFile", "is a VTK file, which ParaView opens"),
    (b"<?xml", "is an XML file, maybe VTK, which ParaView opens"),
    (b"<VTKFile", "is a VTK file, which ParaView opens"),
    (b"LAMMPS data file", "is a data file, which read_data reads"),
    (b"LIGGGHTS data file", "is a data file, which read_data reads"),
)


def _refuse_other_kinds(item: bytes, source: LineSource) -> None:
    for first, what in OTHER_KINDS:
        if item.lstrip().startswith(first):
            raise InputError(source.path, f"{what}: not a dump, as dump custom writes it", source.line)


def read_header(source: LineSource) -> Header | None:
    """Read a frame's header, of atoms or of cells; None at the end of the file.

    A dump states ``ITEM: UNITS`` once and ``ITEM: TIME`` per frame, both before ``ITEM: TIMESTEP``;
    LIGGGHTS writes neither. Items of unknown name have one line, which is passed over.
    """
    step: int | None = None
    count: int | None = None
    box: Box | None = None
    cells: tuple[int, int, int] | None = None
    time = math.nan
    begin = 0
    while not source.at_end():
        item = source.readline()
        if not item.strip():
            continue
        begin = begin or source.line
        _refuse_other_kinds(item, source)
        if not item.startswith(b"ITEM: "):
            raise InputError(source.path, "not a LAMMPS dump here: a line 'ITEM: …' must stand here", source.line)
        try:
            words = item[6:].decode("ascii").split()
        except UnicodeDecodeError:
            raise InputError(
                source.path, "not a text dump: the header holds bytes that are no ASCII", source.line
            ) from None
        name = " ".join(words)
        if name == "UNITS":
            units = source.readline().strip()
            if units != b"si":
                raise InputError(source.path, f"units must be si, not {units[:20]!r}", source.line)
        elif name == "TIME":
            text = source.readline()
            try:
                time = number(text)
            except ValueError:
                time = math.nan
            if not abs(time) < LARGEST:
                raise InputError(source.path, "the time must be one finite number", source.line)
        elif name == "TIMESTEP":
            begin, step = source.line, _integer(source, "the timestep")
            if not 0 <= step < 2**63:
                raise InputError(source.path, "the timestep must be 0 or more and below 2^63", source.line)
        elif name == "NUMBER OF ATOMS":
            count = _integer(source, "the number of atoms")
            if not 0 <= count <= MAX_CLUSTERS:
                raise InputError(source.path, "the number of atoms must be 0 or more, and sane", source.line)
        elif words[:2] == ["BOX", "BOUNDS"]:
            box = _box(source, words[2:])
        elif words[:1] == ["ATOMS"]:
            for what, found in (("TIMESTEP", step), ("NUMBER OF ATOMS", count), ("BOX BOUNDS", box)):
                if found is None:
                    raise InputError(source.path, f"'ITEM: {what}' must come before 'ITEM: ATOMS'", source.line)
            if not words[1:]:
                raise InputError(source.path, "'ITEM: ATOMS' must name the columns", source.line)
            assert step is not None and count is not None and box is not None
            return Header(step, time, count, box, tuple(words[1:]), begin, source.line)
        elif name == "NUMBER OF ENTRIES" or words[:1] == ["ENTRIES"]:
            rule = (
                "holds entries (pairs, bonds), not atoms, as dump local writes them: atoms are written by dump custom"
            )
            raise InputError(source.path, rule, source.line)
        elif words[:2] == ["GRID", "SIZE"]:
            cells = _cells(source)
        elif words[:2] == ["GRID", "CELLS"]:
            if step is None or box is None or cells is None:
                raise InputError(
                    source.path, "TIMESTEP, BOX BOUNDS and GRID SIZE must come before 'ITEM: GRID CELLS'", source.line
                )
            return Header(step, time, math.prod(cells), box, tuple(words[2:]), begin, source.line, cells)
        else:
            source.readline()
    if begin:
        raise InputError(source.path, "the file ends inside a frame's header", source.line)
    return None
