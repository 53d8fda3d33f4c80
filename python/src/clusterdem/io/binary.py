"""LAMMPS' binary custom dumps (``dump custom`` to a file named ``*.bin``), from the revision with column names on (2020)."""

from __future__ import annotations

import math
import struct
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..errors import InputError
from ..frame import Box, Floats
from .header import LARGEST, MAX_CLUSTERS, Header

MAGIC = struct.pack("<q", -10) + b"DUMPCUSTOM"
"""Where a step number would stand its negative length, then the name of the format."""

LONGEST_TEXT = 1 << 16


def is_binary(path: str | Path) -> bool:
    """Whether a file begins as a binary dump does; a file that cannot be read is not one."""
    try:
        with open(path, "rb") as stream:
            return stream.read(len(MAGIC)) == MAGIC
    except (OSError, ValueError):
        return False


class BinarySource:
    """Reads frames one after the other; each holds a block of rows of every rank that wrote it.

    Parameters
    ----------
    stream : binary file
        An open file.
    path : str
        Name for messages.
    """

    def __init__(self, stream: BinaryIO, path: str) -> None:
        self._stream = stream
        self._blocks = 0
        self._size = stream.seek(0, 2)
        stream.seek(0)
        self.path = path

    @property
    def _left(self) -> int:
        """Bytes that have not been read."""
        return self._size - self._stream.tell()

    def _bytes(self, count: int) -> bytes:
        data = self._stream.read(count)
        if len(data) != count:
            raise InputError(self.path, "the file ends inside a frame")
        return data

    def _numbers(self, form: str) -> tuple[int, ...]:
        return struct.unpack("<" + form, self._bytes(struct.calcsize("<" + form)))

    def _text(self) -> str:
        (length,) = self._numbers("i")
        if not 0 <= length <= LONGEST_TEXT:
            raise InputError(self.path, f"a text of {length} bytes in a frame's header: the file is damaged")
        return self._bytes(length).decode("ascii", "replace")

    def read_header(self) -> Header | None:
        """A frame's header; None at the end of the file."""
        begin = self._stream.read(len(MAGIC))
        if not begin:
            return None
        if begin != MAGIC:
            raise InputError(self.path, "not a binary custom dump here: convert it by LAMMPS' tool binary2txt")
        endian, revision = self._numbers("ii")
        if endian != 1 or revision != 2:
            rule = f"revision {revision} of the binary format is not known: convert it by LAMMPS' tool binary2txt"
            raise InputError(self.path, rule)
        step, count = self._numbers("qq")
        if not 0 <= count <= MAX_CLUSTERS or step < 0:
            raise InputError(self.path, f"{count} clusters at step {step}: both must be 0 or more, and sane")
        (triclinic,) = self._numbers("i")
        if triclinic:
            raise InputError(self.path, "only an orthogonal box can be read")
        boundary = self._numbers("6i")
        bounds = struct.unpack("<6d", self._bytes(48))
        lo, hi = bounds[0::2], bounds[1::2]
        if not all(1e-6 <= b - a <= 1e6 and abs(a) <= 1e6 for a, b in zip(lo, hi)):
            raise InputError(self.path, "the box must be 1e-6 to 1e6 m long along x, y and z")
        (width,) = self._numbers("i")
        units = self._text()
        if units not in ("", "si"):
            raise InputError(self.path, f"units must be si, not {units[:20]!r}")
        time = math.nan
        if self._bytes(1) != b"\0":
            (time,) = struct.unpack("<d", self._bytes(8))
            if not abs(time) < LARGEST:
                raise InputError(self.path, "the time must be one finite number")
        names = tuple(self._text().split())
        (self._blocks,) = self._numbers("i")
        if len(names) != width or width < 1:
            raise InputError(self.path, f"{width} columns with {len(names)} names: the file is damaged")
        if 8 * width * count > self._left:
            rule = f"step {step} declares {count:,} rows of {width} numbers, the file holds {self._left:,} bytes more"
            raise InputError(self.path, rule)
        periodic = [boundary[2 * axis : 2 * axis + 2] == (0, 0) for axis in range(3)]
        box = Box((lo[0], lo[1], lo[2]), (hi[0], hi[1], hi[2]), (periodic[0], periodic[1], periodic[2]))
        return Header(step, time, count, box, names, 0, 0)

    def read_rows(self, header: Header, wanted: Sequence[int], finite: Collection[int] = ()) -> list[Floats]:
        """The wanted columns, by position, of which some must be finite; none wanted passes over the rows."""
        width = len(header.names)
        columns = [np.empty(header.count) for _ in wanted]
        at = 0
        for _ in range(self._blocks):
            (numbers,) = self._numbers("i")
            rows, rest = divmod(numbers, width)
            if 8 * numbers > self._left:
                raise InputError(self.path, "the file ends inside a frame")
            if numbers < 0 or rest or at + rows > header.count:
                raise InputError(self.path, f"a block of {numbers} numbers does not fit the frame: the file is damaged")
            if wanted:
                block = np.frombuffer(self._bytes(8 * numbers), "<f8").reshape(rows, width)
                for column, index in zip(columns, wanted):
                    column[at : at + rows] = block[:, index]
            else:
                self._stream.seek(8 * numbers, 1)
            at += rows
        if at != header.count:
            raise InputError(self.path, f"the frame holds {at} of its {header.count} rows")
        for column, index in zip(columns, wanted):
            if index in finite and not np.abs(column).max(initial=0.0) < LARGEST:  # also where a value is NaN
                rule = f"column {index + 1} ({header.names[index]}) must be finite and below {LARGEST:g}"
                raise InputError(self.path, rule)
        return columns
