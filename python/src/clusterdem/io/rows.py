"""The rows of a frame: text to float64 columns, fast where the text is regular."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import polars as pl

from ..errors import InputError
from ..frame import Floats
from .header import LARGEST, number


def parse_rows(
    block: bytes, count: int, names: Sequence[str], wanted: Sequence[int], path: str, first: int
) -> list[Floats]:
    """Turn a block of rows into columns.

    Parameters
    ----------
    block : bytes
        The rows.
    count : int
        How many there must be.
    names : sequence of str
        The columns' names: as many numbers per row.
    wanted : sequence of int
        The columns to return, by position.
    path, first : str, int
        The file and the line of the first row, for messages.

    Returns
    -------
    list of ndarray, shape (count,), float64
        The wanted columns, every value finite.
    """
    columns = _fast(block, count, len(names), wanted) if block.endswith(b"\n") else None
    return columns if columns is not None else _careful(block, count, names, wanted, path, first)


def _name(index: int) -> str:
    return f"column_{index + 1}"


def _fast(block: bytes, count: int, width: int, wanted: Sequence[int]) -> list[Floats] | None:
    """Rows with one blank between numbers and maybe one at the end; None if anything looks unusual."""
    # the last field is read besides: a short row shows there as a null, a long one as an error or as no null
    ragged = block[: block.find(b"\n")].rstrip(b"\r").endswith(b" ")
    last = width - 1 + ragged
    keep = {*wanted, last}
    schema = {_name(i): pl.Float64 if i in keep else pl.String for i in range(last + 1)}
    names = [_name(i) for i in sorted(keep)]
    try:
        table = pl.read_csv(block, has_header=False, separator=" ", schema=schema, columns=names, quote_char=None)
    except pl.exceptions.PolarsError:
        return None
    if table.height != count or table[_name(last)].null_count() != (count if ragged else 0):
        return None
    columns = []
    for i in wanted:
        column = table[_name(i)]
        if column.null_count():
            return None
        values = column.to_numpy()
        if not np.abs(values).max() < LARGEST:  # also where a value is NaN
            return None
        columns.append(values)
    return columns


def _careful(
    block: bytes, count: int, names: Sequence[str], wanted: Sequence[int], path: str, first: int
) -> list[Floats]:
    """Row by row, any white space, naming the first line that breaks a rule."""
    lines = block.splitlines() if b"\r" in block else block.split(b"\n")
    if lines and not lines[-1]:
        lines.pop()
    columns = [np.empty(min(count, len(lines))) for _ in wanted]
    for row, line in enumerate(lines[:count]):
        words = line.split()
        if len(words) != len(names):
            raise InputError(path, f"a row must hold {len(names)} numbers, not {len(words)}", first + row)
        for column, i in zip(columns, wanted):
            try:
                value = number(words[i])
            except ValueError:
                raise InputError(path, f"column {i + 1} ({names[i]}) must be a number", first + row) from None
            if not abs(value) < LARGEST:
                raise InputError(path, f"column {i + 1} ({names[i]}) must be finite and below {LARGEST:g}", first + row)
            column[row] = value
    if len(lines) < count:
        raise InputError(path, f"the frame ends after {len(lines)} of {count} rows", first + max(len(lines) - 1, 0))
    if len(lines) > count:
        raise InputError(path, f"the frame holds more than its {count} rows", first + count)
    if not block.endswith(b"\n"):
        raise InputError(path, "the last row is half-written: no end of line", first + count - 1)
    return columns
