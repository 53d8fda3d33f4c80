"""Dump files to frames, one at a time."""

from __future__ import annotations

import logging
import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..frame import Box, Floats, Frame, Words
from ..primary import Primary, primary_beside
from .binary import BinarySource, is_binary
from .header import LARGEST, Header, read_header
from .rows import hold_words, parse_rows
from .streams import LineSource, open_lines

notes = logging.getLogger("clusterdem")
"""What a reader should know though nothing is wrong; the command line prints it as notes."""

BREAKMERGE = ("n", "d", "l", "N_st", "N_cc", "N_smf")
DRAG = ("ug_x", "ug_y", "ug_z", "fd_x", "fd_y", "fd_z", "Re", "tau")
ALIASES = {
    **{f"f_{fix}[{i}]": name for fix in ("bm", "size") for i, name in enumerate(BREAKMERGE, 1)},
    **{f"f_drag[{i}]": name for i, name in enumerate(DRAG, 1)},
}
"""Plain names of the raw output columns of the fixes with the ids ``bm`` or ``size``, and ``drag``."""


@dataclass(frozen=True)
class Column:
    """Where a quantity stands in a row, what makes it SI, ``value * factor + shift``, and the side that it is wrapped into."""

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


ALWAYS = ("x", "z", "diameter")
"""Besides ``mass``, or the ``density`` that it follows from."""

FINITE = (*ALWAYS, "y", "vx", "vy", "vz")
"""What must be finite, of the columns that nobody asked for by name; others may hold NaN."""


def _layout(header: Header, path: str, density: float | None) -> dict[str, Column]:
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
    if "mass" not in layout and "density" not in layout and density is None:
        rule = "no column mass, nor density, from which it would follow: give the spheres' density (--density KG/M3)"
        raise InputError(path, rule, header.names_line)
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
    """Refuse what no cluster can be: without mass or size, larger than the box, or a box's length away from it."""
    largest = sorted(frame.box.lengths)[1]  # the thickness of a slab may be less
    for name, most, limit in (("mass", LARGEST, ""), ("diameter", largest, ", and smaller than the box")):
        wrong = np.flatnonzero(~((frame[name] > 1 / LARGEST) & (frame[name] < most)))
        if len(wrong):
            raise InputError(frame.path, f"{name} must be positive{limit}", frame.first_row + int(wrong[0]))
    for axis, letter in enumerate("xyz"):
        if letter in frame and not frame.box.periodic[axis]:
            lo, hi, length = frame.box.lo[axis], frame.box.hi[axis], frame.box.lengths[axis]
            values = frame[letter]
            out = np.flatnonzero((values < lo - length) | (values > hi + length))
            if len(out):
                raise InputError(frame.path, f"{letter} lies far outside the box", frame.first_row + int(out[0]))


class _TextFrames:
    """The frames of a text dump, one after the other."""

    def __init__(self, source: LineSource) -> None:
        self._source = source

    @property
    def broken(self) -> str:
        """Why the file gives no more, where that is not its end."""
        return self._source.broken

    def header(self) -> Header | None:
        return read_header(self._source)

    def rows(self, header: Header, wanted: Sequence[int], finite: Collection[int]) -> dict[int, Floats | Words]:
        first = header.names_line + 1
        loose = [index for index in wanted if index not in finite]
        block = self._source.read_until(b"ITEM:", header.count)
        words = hold_words(block, loose)
        found = parse_rows(block, header.count, header.names, wanted, self._source.path, first, words, loose)
        return dict(zip(wanted, found))

    def skip(self, header: Header) -> None:
        self._source.read_until(b"ITEM:", header.count, keep=False)


class _BinaryFrames:
    """The frames of a binary dump, one after the other."""

    broken = ""

    def __init__(self, source: BinarySource) -> None:
        self._source = source

    def header(self) -> Header | None:
        return self._source.read_header()

    def rows(self, header: Header, wanted: Sequence[int], finite: Collection[int]) -> dict[int, Floats | Words]:
        return dict(zip(wanted, self._source.read_rows(header, wanted, finite)))

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
    frames: _TextFrames | _BinaryFrames,
    header: Header,
    columns: Collection[str] | None,
    path: str,
    density: float | None,
) -> Frame:
    layout = _layout(header, path, density)
    mass = "mass" if "mass" in layout else "density"
    if columns is not None:
        layout = {name: column for name, column in layout.items() if name in (*ALWAYS, mass) or name in columns}
    finite = {layout[name].index for name in (*FINITE, mass, *(columns or ())) if name in layout}
    raw = frames.rows(header, sorted({column.index for column in layout.values()}), finite)
    values: dict[str, Floats] = {}
    texts: dict[str, Words] = {}
    for name, column in layout.items():
        found = raw[column.index]
        if found.dtype.kind == "f":
            values[name] = _values(column, found)  # type: ignore[arg-type]
        else:
            texts[name] = found  # type: ignore[assignment]
    if "mass" not in values:
        # of a dump that tells no mass the spheres are of the given density
        values["mass"] = values.get("density", density) * np.pi / 6 * values["diameter"] ** 3  # type: ignore[operator]
    if "y" not in layout and (columns is None or "y" in columns):
        values["y"] = np.full(header.count, (header.box.lo[1] + header.box.hi[1]) / 2)
    frame = Frame(header.step, header.time, header.box, values, path, header.line, header.names_line + 1, texts)
    _check(frame)
    return frame


def _cut(broken: str, whole: int, header: Header | None) -> str:
    """What a cut or damaged file still gave."""
    at = "" if header is None else f" in frame {whole + 1} (step {header.step})"
    return f"{broken}{at}; whole frames before that place: {whole}"


def _head_of(frames: _TextFrames | _BinaryFrames, header: Header, path: str) -> Frame:
    frames.skip(header)
    nothing = {name: np.empty(0) for name in ("mass", "diameter")}
    return Frame(header.step, header.time, header.box, nothing, path, header.line, header.names_line + 1)


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
    density: float | None = None,
    rows: bool = True,
) -> Iterator[Frame]:
    """The frames of one file, one at a time.

    Parameters
    ----------
    path : str or Path
        A LAMMPS or LIGGGHTS text dump, plain or packed (.gz, .bz2, .xz, .zst), or a binary one of LAMMPS.
    columns : collection of str, optional
        Columns to read besides x, z, mass and diameter; all by default, and y, of dumps without it the middle of the box.
        Absent ones are left out.
    share : (int, int), optional
        Of every ``share[1]`` frames only number ``share[0]`` is returned; the rest are passed over.
    dt : float, optional
        Step (s) that gives the time where the dump holds none.
    density : float, optional
        Density of the primary particles (kg/m³); by default what the run's log beside the dump tells. In a dump with neither mass nor
        density that of the spheres as well, which then are solid.
    rows : bool
        False for the heads alone: step, time, box and place of each frame, without clusters.

    Yields
    ------
    Frame
        Of frames that stand twice (one step, as a run that is continued writes it) the first; a note says so.

    Raises
    ------
    InputError
        Where the file breaks a rule; the frames before that place have been yielded.
    """
    name = str(path)
    primary = primary_beside(Path(path)) if density is None else Primary.of_density(density)
    with _open_frames(path) as frames:
        number, last, header = 0, None, None
        try:
            while (header := frames.header()) is not None:
                if header.cells is not None:
                    raise InputError(name, "holds cells, not clusters: clusterdem map reads such files", header.line)
                if last is not None and header.step < last:
                    rule = f"frames must rise in time: step {header.step} comes after step {last}"
                    raise InputError(name, rule, header.line or None)
                if header.step == last:
                    notes.warning("%s: step %d stands twice: the first is taken", name, last)
                    frames.skip(header)
                    continue
                last = header.step
                if number % share[1] == share[0]:
                    frame = (
                        _read_frame(frames, header, columns, name, density) if rows else _head_of(frames, header, name)
                    )
                    frame = replace(frame, primary=primary)
                    if dt is not None and np.isnan(frame.time):
                        frame = replace(frame, time=frame.step * dt)
                    yield frame
                else:
                    frames.skip(header)
                number += 1
        except InputError as error:
            if not frames.broken:
                raise
            raise InputError(name, _cut(frames.broken, number, header), error.line) from None
        if frames.broken:
            raise InputError(name, _cut(frames.broken, number, None))
        if number == 0:
            raise InputError(name, "is empty: a dump file must hold at least one frame", 1)


def read_dumps(
    paths: str | Path | Iterable[str | Path],
    columns: Collection[str] | None = None,
    *,
    dt: float | None = None,
    density: float | None = None,
) -> Iterator[Frame]:
    """The frames of one file or several, in natural order of their names; that time rises is checked.

    Parameters
    ----------
    paths : str or Path, or iterable of them
        The files.
    columns, dt, density
        As in :func:`read_file`.

    Yields
    ------
    Frame

    Examples
    --------
    >>> for frame in read_dumps("one.dump"):
    ...     print(frame.label, len(frame), f"{1e6 * frame.diameter.mean():.0f} µm, y = {frame.y[0]} m")
    t = 0 s 2 750 µm, y = 0.0015 m
    """
    before: Frame | None = None
    for path in natural_order([paths] if isinstance(paths, (str, Path)) else paths):
        for frame in read_file(path, columns, dt=dt, density=density):
            if before is None or is_later(before, frame):
                before = frame.head
                yield frame


def is_later(before: Frame, frame: Frame) -> bool:
    """Whether a frame is later than the one before; not if it is the same step again, of which a note tells.

    Raises
    ------
    InputError
        If it is earlier.
    """
    if frame.step < before.step:
        rule = f"frames must rise in time: step {frame.step} comes after step {before.step} of {before.path}"
        raise InputError(frame.path, rule, frame.line)
    if frame.step == before.step:
        notes.warning("%s: step %d stands in %s, too: that one is taken", frame.path, frame.step, before.path)
    return frame.step > before.step


def check_same_box(before: Frame, frame: Frame, who: str) -> None:
    """Refuse a frame in another box, for ``who`` needs one for all."""
    if not frame.box.same_as(before.box):
        rule = f"the box differs from that of {before.path or 'the frame before'}: {who} one box for all frames"
        raise InputError(frame.path, rule, frame.line)
