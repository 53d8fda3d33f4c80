"""The rows of a frame: text to columns, fast where the text is regular."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
import polars as pl

from ..errors import InputError
from ..frame import Floats, Words
from .header import LARGEST, number


def parse_rows(
    block: bytes,
    count: int,
    names: Sequence[str],
    wanted: Sequence[int],
    path: str,
    first: int,
    words: Collection[int] = (),
    loose: Collection[int] = (),
) -> list[Floats | Words]:
    """Turn a block of rows into columns.

    Parameters
    ----------
    block : bytes
        The rows.
    count : int
        How many there must be.
    names : sequence of str
        The columns' names: as many words per row.
    wanted : sequence of int
        The columns to return, by position.
    path, first : str, int
        The file and the line of the first row, for messages.
    words : collection of int
        Those of the wanted that hold words, not numbers.
    loose : collection of int
        Those of the wanted whose values need not be finite.

    Returns
    -------
    list of ndarray, shape (count,)
        The wanted columns: float64, every value finite but for the loose ones, or str.

    Raises
    ------
    InputError
        At the first row that breaks a rule.
    """
    columns = _fast(block, count, len(names), wanted, words, loose) if block.endswith(b"\n") and count else None
    return columns if columns is not None else _careful(block, count, names, wanted, path, first, words, loose)


def hold_words(block: bytes, candidates: Sequence[int]) -> list[int]:
    """Which of the candidate columns hold words, by the first row."""
    row = block[: block.find(b"\n")].split()
    return [index for index in candidates if index < len(row) and not _is_number(row[index])]


def _is_number(word: bytes) -> bool:
    try:
        number(word)
    except ValueError:
        return False
    return True


def _name(index: int) -> str:
    return f"column_{index + 1}"


def _fast(
    block: bytes, count: int, width: int, wanted: Sequence[int], words: Collection[int], loose: Collection[int]
) -> list[Floats | Words] | None:
    """Rows with one blank between numbers and maybe one at the end; None if anything looks unusual."""
    # the last field is read besides: a short row shows there as a null, a long one as an error or as no null
    ragged = block[: block.find(b"\n")].rstrip(b"\r").endswith(b" ")
    last = width - 1 + ragged
    keep = {*wanted, last}
    schema = {_name(i): pl.Float64 if i in keep and i not in words else pl.String for i in range(last + 1)}
    if ragged:
        schema[_name(last)] = pl.Float64
    names = [_name(i) for i in sorted(keep)]
    try:
        table = pl.read_csv(block, has_header=False, separator=" ", schema=schema, columns=names, quote_char=None)
    except pl.exceptions.PolarsError:
        return None
    if table.height != count or table[_name(last)].null_count() != (count if ragged else 0):
        return None
    columns: list[Floats | Words] = []
    for i in wanted:
        column = table[_name(i)]
        if column.null_count():
            return None
        if i in words:
            columns.append(column.to_numpy().astype(np.str_))
            continue
        values = column.to_numpy()
        if i not in loose and not np.abs(values).max() < LARGEST:  # also where a value is NaN
            return None
        columns.append(values)
    return columns


def _careful(
    block: bytes,
    count: int,
    names: Sequence[str],
    wanted: Sequence[int],
    path: str,
    first: int,
    words: Collection[int],
    loose: Collection[int],
) -> list[Floats | Words]:
    """Row by row, any white space, naming the first line that breaks a rule."""
    lines = block.splitlines() if b"\r" in block else block.split(b"\n")
    while lines and not lines[-1].strip():  # blank lines at the end of a file, or between frames
        lines.pop()
    found: list[list[float] | list[str]] = [[] for _ in wanted]
    for row, line in enumerate(lines[:count]):
        fields = line.split()
        if len(fields) != len(names):
            raise InputError(path, f"a row must hold {len(names)} numbers, not {len(fields)}", first + row)
        for column, i in zip(found, wanted):
            column.append(_value(fields[i], i, names, path, first + row, i in words, i in loose))  # type: ignore[arg-type]
    if len(lines) < count:
        raise InputError(path, f"the frame ends after {len(lines)} of {count} rows", first + max(len(lines) - 1, 0))
    if len(lines) > count:
        raise InputError(path, f"the frame holds more than its {count} rows", first + count)
    if count and not block.endswith(b"\n"):
        raise InputError(path, "the last row is half-written: no end of line", first + count - 1)
    return [
        np.array(column, np.str_) if i in words else np.array(column, np.float64) for column, i in zip(found, wanted)
    ]


def _value(field: bytes, i: int, names: Sequence[str], path: str, line: int, word: bool, loose: bool) -> float | str:
    if word:
        return field.decode("utf-8", "replace")
    try:
        value = number(field)
    except ValueError:
        raise InputError(path, f"column {i + 1} ({names[i]}) must be a number", line) from None
    if not loose and not abs(value) < LARGEST:
        raise InputError(path, f"column {i + 1} ({names[i]}) must be finite and below {LARGEST:g}", line)
    return value
