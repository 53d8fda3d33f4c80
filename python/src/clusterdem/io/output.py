"""Whole files or none: every output is written under a temporary name, then renamed."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError


@contextmanager
def atomic(path: str | Path) -> Iterator[Path]:
    """A temporary path beside ``path`` that takes its name if the block ends well and is removed if not.

    Parameters
    ----------
    path : str or Path
        The file to make; missing folders above it are made.

    Yields
    ------
    Path
        The name to write to; it ends like ``path``.
    """
    path = Path(path)
    temporary = path.with_name(f".tmp-{os.getpid()}-{path.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(path, f"cannot be written: {error.strerror or error}") from error
    finally:
        with suppress(OSError):
            temporary.unlink()


def write_text(path: str | Path, text: str) -> Path:
    """Write a text file (UTF-8)."""
    with atomic(path) as name:
        name.write_text(text, encoding="utf-8")
    return Path(path)


def write_csv(path: str | Path, heading: Sequence[str], rows: Iterable[Sequence[object]]) -> Path:
    """Write a CSV file; floats keep all their digits."""
    with atomic(path) as name, open(name, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heading)
        writer.writerows(rows)
    return Path(path)


def write_npz(path: str | Path, arrays: Mapping[str, NDArray[np.generic] | float | int]) -> Path:
    """Write arrays to an .npz file; the same arrays give the same bytes."""
    with atomic(path) as name:
        np.savez(name, **{key: np.asarray(value) for key, value in arrays.items()})  # type: ignore[arg-type]
    return Path(path)
