"""Dump files to frames, one at a time."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..frame import Box, Floats, Frame
from .binary import BinarySource, is_binary
from .header import LARGEST, Header, read_header
from .rows import parse_rows
from .streams import LineSource, open_lines

BREAKMERGE = ("n", "d", "l", "N_st", "N_cc", "N_smf")
DRAG = ("ug_x", "ug_y", "ug_z", "fd_x", "fd_y", "fd_z", "Re", "tau")
ALIASES = {
    **{f"f_{fix}[{i}]": name for fix in ("bm", "size") for i, name in enumerate(BREAKMERGE, 1)},
    **{f"f_drag[{i}]": name for i, name in enumerate(DRAG, 1)},
}
"""Plain names of the raw output columns of the fixes with the ids ``bm`` or ``size``, and ``drag``."""


@dataclass(frozen=True)
class Column:
    """Where a quantity stands in a row and what makes it SI: ``value * factor + shift``."""

    index: int
    factor: float = 1.0
    shift: float = 0.0
    wrap: tuple[float, float] | None = None


def _coordinate(axis: int, names: dict[str, int], box: Box) -> Column | None:
    letter, lo, length = "xyz"[axis], box.lo[axis], box.lengths[axis]
    wrap = (lo, length) if box.periodic[axis] else None
    for name, factor, shift in (
        (letter, 1.0, 0.0),
        (letter + "s", length, lo),
        (letter + "u", 1.0, 0.0),
        (letter + "su", length, lo),
    ):
        if name in names:
            return Column(names[name], factor, shift, wrap)
    return None


def _layout(header: Header, path: str) -> dict[str, Column]:
    """The columns of a frame by their plain names."""
    names: dict[str, int] = {}
    for index, raw in enumerate(header.names):
        names.setdefault(raw, index)
    for raw, plain in ALIASES.items():
        if raw in names:
            names.setdefault(plain, names[raw])
    layout = {name: Column(index) for name, index in names.items()}
    for axis, letter in enumerate("xyz"):
        coordinate = _coordinate(axis, names, header.box)
        if coordinate is not None:
            layout[letter] = coordinate
        elif letter != "y":
            raise InputError(path, f"no column {letter}, {letter}s or {letter}u", header.names_line)
    if "diameter" not in layout:
        if "radius" not in layout:
            raise InputError(path, "no column diameter or radius", header.names_line)
        layout["diameter"] = Column(names["radius"], 2.0)
    if "mass" not in layout:
        raise InputError(path, "no column mass", header.names_line)
    return layout


def _values(column: Column, raw: Floats) -> Floats:
    values = raw if column.factor == 1.0 and column.shift == 0.0 else raw * column.factor + column.shift
    if column.wrap is not None:
        lo, length = column.wrap
        outside = (values < lo) | (values >= lo + length)
        if outside.any():
            values = values.copy()
            values[outside] = lo + np.mod(values[outside] - lo, length)
            values[values >= lo + length] = lo
    return values


def _check(frame: Frame) -> None:
    largest = min(frame.box.lengths[0], frame.box.lengths[2])
    for name, most, limit in (("mass", LARGEST, ""), ("diameter", largest, ", and smaller than the box")):
        wrong = np.flatnonzero(~((frame[name] > 1 / LARGEST) & (frame[name] < most)))
        if len(wrong):
            raise InputError(frame.path, f"{name} must be positive{limit}", frame.first_row + int(wrong[0]))
    for axis, letter in ((0, "x"), (2, "z")):
        if not frame.box.periodic[axis]:
            lo, hi, slack = frame.box.lo[axis], frame.box.hi[axis], frame.diameter
            values = frame[letter]
            out = np.flatnonzero((values < lo - slack) | (values > hi + slack))
            if len(out):
                raise InputError(frame.path, f"{letter} lies outside the box", frame.first_row + int(out[0]))


class _TextFrames:
    """The frames of a text dump, one after the other."""

    def __init__(self, source: LineSource) -> None:
        self._source = source

    def header(self) -> Header | None:
        return read_header(self._source)

    def rows(self, header: Header, wanted: list[int]) -> list[Floats]:
        first = header.names_line + 1
        block = self._source.read_until(b"ITEM:", header.count)
        return parse_rows(block, header.count, header.names, wanted, self._source.path, first)

    def skip(self, header: Header) -> None:
        self._source.read_until(b"ITEM:", header.count, keep=False)


class _BinaryFrames:
    """The frames of a binary dump, one after the other."""

    def __init__(self, source: BinarySource) -> None:
        self._source = source

    def header(self) -> Header | None:
        return self._source.read_header()

    def rows(self, header: Header, wanted: list[int]) -> list[Floats]:
        return self._source.read_rows(header, wanted)

    def skip(self, header: Header) -> None:
        self._source.read_rows(header, ())


@contextmanager
def _open_frames(path: str | Path) -> Iterator[_TextFrames | _BinaryFrames]:
    if is_binary(path):
        with open(path, "rb") as stream:
            yield _BinaryFrames(BinarySource(stream, str(path)))
    else:
        with open_lines(path) as source:
            yield _TextFrames(source)


def _read_frame(
    frames: _TextFrames | _BinaryFrames, header: Header, columns: Collection[str] | None, path: str
) -> Frame:
    layout = _layout(header, path)
    if columns is not None:
        always = {"x", "z", "mass", "diameter"}
        layout = {name: column for name, column in layout.items() if name in always or name in columns}
    indices = sorted({column.index for column in layout.values()})
    raw = dict(zip(indices, frames.rows(header, indices)))
    values = {name: _values(column, raw[column.index]) for name, column in layout.items()}
    frame = Frame(header.step, header.time, header.box, values, path, header.line, header.names_line + 1)
    _check(frame)
    return frame


def natural_order(paths: Iterable[str | Path]) -> list[Path]:
    """Paths in the order a reader expects: ``case1.900.dump`` before ``case1.1000.dump``."""

    def key(path: Path) -> list[tuple[int, int, str]]:
        words = re.split(r"([0-9]+)", str(path))
        return [(1, int(word), "") if word.isdecimal() and word.isascii() else (0, 0, word) for word in words]

    return sorted((Path(path) for path in paths), key=key)


def read_file(
    path: str | Path,
    columns: Collection[str] | None = None,
    *,
    share: tuple[int, int] = (0, 1),
    dt: float | None = None,
) -> Iterator[Frame]:
    """The frames of one file, one at a time.

    Parameters
    ----------
    path : str or Path
        A LAMMPS or LIGGGHTS text dump, plain, .gz or .zst, or a binary one of LAMMPS.
    columns : collection of str, optional
        Columns to read besides x, z, mass and diameter; all by default. Absent ones are left out.
    share : (int, int), optional
        Of every ``share[1]`` frames only number ``share[0]`` is returned; the rest are passed over.
    dt : float, optional
        Step (s) that gives the time where the dump holds none.

    Yields
    ------
    Frame
    """
    name = str(path)
    with _open_frames(path) as frames:
        number, last = 0, None
        while (header := frames.header()) is not None:
            if last is not None and header.step <= last:
                raise InputError(
                    name, f"frames must rise in time: step {header.step} comes after step {last}", header.line or None
                )
            if header.cells is not None:
                raise InputError(name, "holds cells, not clusters: clusterdem map reads such files", header.line)
            last = header.step
            if number % share[1] == share[0]:
                frame = _read_frame(frames, header, columns, name)
                if dt is not None and np.isnan(frame.time):
                    frame = replace(frame, time=frame.step * dt)
                yield frame
            else:
                frames.skip(header)
            number += 1
        if number == 0:
            raise InputError(name, "is empty: a dump file must hold at least one frame", 1)


def read_dumps(
    paths: Iterable[str | Path], columns: Collection[str] | None = None, *, dt: float | None = None
) -> Iterator[Frame]:
    """The frames of several files in natural order of their names; time and box are checked.

    Parameters
    ----------
    paths : iterable of str or Path
        The files.
    columns, dt
        As in :func:`read_file`.

    Yields
    ------
    Frame
    """
    before: Frame | None = None
    for path in natural_order(paths):
        for frame in read_file(path, columns, dt=dt):
            if before is not None:
                check_follows(before, frame)
            before = replace(frame, columns={})
            yield frame


def check_follows(before: Frame, frame: Frame) -> None:
    """Refuse a frame that is not later than the one before, or lies in another box."""
    if frame.step <= before.step:
        rule = f"frames must rise in time: step {frame.step} comes after step {before.step} of {before.path}"
        raise InputError(frame.path, rule, frame.line)
    if not frame.box.same_as(before.box):
        raise InputError(frame.path, f"the box differs from that of {before.path}: all frames need one box", frame.line)
