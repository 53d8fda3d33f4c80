"""Tables over time that the engine writes (``fix ave/time``), and event rates from them."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .header import number
from .streams import open_lines


def read_series(path: str | Path, needed: Collection[str] = ()) -> dict[str, Floats]:
    """Read a table: comment lines first, the last of them names the columns.

    Parameters
    ----------
    path : str or Path
        The file.
    needed : collection of str
        Columns that must be there.

    Returns
    -------
    dict of str to ndarray, shape (T,)
        Columns by name; a half-written last line is left out.
    """
    names: list[str] = []
    rows: list[list[float]] = []
    with open_lines(path) as source:
        while not source.at_end():
            text = source.readline()
            if text.startswith(b"#"):
                names = text[1:].decode("utf-8", "replace").split()
                continue
            words = text.split()
            if not words:
                continue
            if len(words) != len(names):
                if source.at_end():
                    break
                rule = f"a row must hold {len(names)} numbers, as the heading names, not {len(words)}"
                raise InputError(source.path, rule, source.line)
            try:
                rows.append([number(word) for word in words])
            except ValueError:
                raise InputError(source.path, "every word of a row must be a number", source.line) from None
    if not rows:
        raise InputError(path, "holds no row of numbers")
    for name in needed:
        if name not in names:
            raise InputError(path, f"no column {name}")
    columns = np.array(rows).T
    return dict(zip(names, columns))


def event_rates(series: dict[str, Floats], names: tuple[str, ...] = ("breakups", "merges")) -> dict[str, Floats]:
    """Events per second from running totals.

    Parameters
    ----------
    series : dict of str to ndarray, shape (T,)
        With ``time`` (s) and the totals.
    names : tuple of str
        The totals' names.

    Returns
    -------
    dict of str to ndarray, shape (T − 1,)
        ``time``, the middle of each interval (s), and each rate (1/s).
    """
    span = np.diff(series["time"])
    middle = series["time"][:-1] + span / 2
    keep = span > 0
    rates = {"time": middle[keep]}
    for name in names:
        if name in series:
            rates[name] = np.diff(series[name])[keep] / span[keep]
    return rates
