"""Lines of a plain or packed file (.gz, .bz2, .xz, .zst), in bulk, with the line number kept."""

from __future__ import annotations

import bz2
import lzma
import os
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, cast

import zstandard

from ..errors import InputError

CHUNK = 1 << 22
"""Bytes read at a time (compressed files, and what is too large to be read at once)."""

PIECE = 1 << 14
"""Compressed bytes unpacked at a time: what a damaged place can take along of what lies before it."""

AT_ONCE = 1 << 25
"""A plain file up to this many bytes is read at once: one frame, as a rule."""


def find(text: bytes, mark: bytes, start: int) -> int:
    """Like ``text.find(mark, start)``, 20 times as fast where the mark's first letter is rare."""
    at = text.find(mark[:1], start)
    while at >= 0 and not text.startswith(mark, at):
        at = text.find(mark[:1], at + 1)
    return at


class Broken(Exception):
    """Compressed data that are cut or damaged."""


class Unpacked:
    """A packed stream that gives all that can be unpacked before it says that the rest is broken.

    Parameters
    ----------
    raw : binary file
        The compressed bytes.
    begin : callable
        Makes an unpacker; a file may hold several packed parts, one after the other.
    kind : str
        For messages.
    """

    def __init__(self, raw: IO[bytes], begin: Callable[[], Any], kind: str) -> None:
        self._raw = raw
        self._begin = begin
        self._kind = kind
        self._unpacker = begin()
        self._rest = b""
        self._touched = False
        self._error: Broken | None = None

    def read(self, size: int) -> bytes:
        """Some ``size`` bytes, more or less; none at the end."""
        parts: list[bytes] = []
        length = 0
        while length < size and self._error is None:
            piece = self._rest or self._raw.read(PIECE)
            self._rest = b""
            if not piece:
                if self._touched and not self._unpacker.eof:
                    self._error = Broken(f"the {self._kind} data are cut at byte {self._raw.tell():,}")
                break
            if self._unpacker.eof:
                self._unpacker = self._begin()
            try:
                self._touched = True
                parts.append(self._unpacker.decompress(piece))
            except (zlib.error, zstandard.ZstdError, lzma.LZMAError, OSError) as error:
                self._error = Broken(f"the {self._kind} data are damaged before byte {self._raw.tell():,}: {error}")
                break
            self._rest = self._unpacker.unused_data if self._unpacker.eof else b""
            length += len(parts[-1])
        if not length and self._error is not None:
            raise self._error
        return b"".join(parts)


class LineSource:
    """Reads single lines and blocks of lines from a byte stream.

    Parameters
    ----------
    stream : binary file
        Where the bytes come from.
    path : str
        Name for messages.
    chunk : int
        Bytes to read at a time; -1 for all at once.

    Attributes
    ----------
    line : int
        Lines read so far.
    broken : str
        Why nothing comes any more, where that is not the end of the file.
    """

    def __init__(self, stream: IO[bytes], path: str, chunk: int = CHUNK) -> None:
        self._stream = stream
        self._chunk = chunk
        self._buffer = b""
        self._at = 0
        self.path = path
        self.line = 0
        self.broken = ""

    def _more(self) -> bytes:
        """What comes next; nothing at the end of the file, or where it is cut or damaged, which ``broken`` then tells."""
        try:
            return self._stream.read(self._chunk)
        except (OSError, Broken) as error:
            self.broken = f"cannot be read to its end: {error}"
            return b""

    def readline(self) -> bytes:
        """The next line without its end-of-line bytes; ``b""`` and no advance at the end of the file."""
        end = self._buffer.find(b"\n", self._at)
        while end < 0:
            more = self._more()
            if not more:
                end = len(self._buffer)
                if end == self._at:
                    return b""
                break
            self._buffer, self._at = self._buffer[self._at :] + more, 0
            end = self._buffer.find(b"\n")
        line = self._buffer[self._at : end]
        self._at = min(end + 1, len(self._buffer))
        self.line += 1
        return line.rstrip(b"\r")

    def at_end(self) -> bool:
        """Whether no byte is left."""
        if self._at == len(self._buffer):
            self._buffer, self._at = self._more(), 0
        return not self._buffer

    def read_until(self, mark: bytes, lines: int, keep: bool = True) -> bytes:
        """Everything up to ``mark`` or the end of the file, not counted but taken for ``lines`` lines.

        Parameters
        ----------
        mark : bytes
            Where to stop; it stays in the stream.
        lines : int
            What the line number grows by.
        keep : bool
            False to pass over the bytes instead of returning them.
        """
        pieces: list[bytes] = []
        while not self.at_end():
            end = find(self._buffer, mark, self._at)
            if end < 0:
                more = self._more()
                # the mark may straddle two reads
                end = len(self._buffer) - (len(mark) - 1 if more else 0)
                found = False
            else:
                more, found = b"", True
            end = max(end, self._at)
            if keep:
                pieces.append(self._buffer[self._at : end])
            self._buffer, self._at = (self._buffer, end) if found else (self._buffer[end:] + more, 0)
            if found or not more:
                break
        self.line += lines
        return b"".join(pieces)


PACKED: tuple[tuple[bytes, str, Callable[[], Any]], ...] = (
    (b"\x1f\x8b", "gzip", lambda: zlib.decompressobj(31)),
    (b"BZh", "bzip2", bz2.BZ2Decompressor),
    (b"\xfd7zXZ\x00", "xz", lzma.LZMADecompressor),
    (b"\x28\xb5\x2f\xfd", "zstd", lambda: zstandard.ZstdDecompressor().decompressobj()),
)
"""First bytes of packed files, their kind, and what unpacks them."""

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
"""Some editors put it before a text."""


@contextmanager
def open_lines(path: str | Path) -> Iterator[LineSource]:
    """Open a file for reading by lines; packed ones are told by their first bytes.

    Parameters
    ----------
    path : str or Path
        The file.

    Yields
    ------
    LineSource
    """
    name = str(path)
    try:
        raw = open(path, "rb", buffering=0)
    except IsADirectoryError as error:
        raise InputError(name, "is a directory, not a dump file") from error
    except (OSError, ValueError) as error:
        raise InputError(name, f"cannot be opened: {getattr(error, 'strerror', None) or error}") from error
    with raw:
        try:
            magic = raw.read(6)
            raw.seek(len(BYTE_ORDER_MARK) if magic.startswith(BYTE_ORDER_MARK) else 0)
        except OSError as error:
            raise InputError(name, f"cannot be read: {error.strerror}") from error
        chunk = CHUNK
        for first, kind, begin in PACKED:
            if magic.startswith(first):
                stream: IO[bytes] = cast(IO[bytes], Unpacked(raw, begin, kind))
                break
        else:
            stream = raw
            chunk = -1 if os.fstat(raw.fileno()).st_size <= AT_ONCE else CHUNK
        source = LineSource(stream, name, chunk)
        yield source
        if source.broken:
            raise InputError(name, source.broken, source.line)
