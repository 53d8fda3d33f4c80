"""Writes gas fields as legacy VTK files, laid out as VTK's own writers and `clusterdem gas` do it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

Axes = Sequence[np.ndarray]
TITLE = "clusterdem gas; SI units (m, s, m/s, kg/m^3, m^2/s)"


def write_field(
    path: Path,
    axes: Axes,
    velocity: Callable | np.ndarray,
    time: float | None = None,
    binary: bool = True,
    kind: str = "double",
    title: str = TITLE,
    **arrays: Callable | np.ndarray,
) -> None:
    """Values as functions of x, y, z, or as arrays of one row per point, x fastest."""
    axes = [np.asarray(a, dtype=float) for a in axes]
    z, y, x = (a.ravel() for a in np.meshgrid(*axes[::-1], indexing="ij"))
    count = len(x)

    def numbers(values) -> bytes:
        values = np.asarray(values, dtype=float)
        if binary:
            return values.astype(">f8" if kind == "double" else ">f4").tobytes() + b"\n"
        return (" ".join(f"{v:.17g}" for v in values.ravel()) + "\n").encode()

    def table(values, width) -> np.ndarray:
        given = values(x, y, z) if callable(values) else values
        if isinstance(given, tuple):
            given = np.stack([np.broadcast_to(g, count) for g in given], axis=1)
        return np.broadcast_to(np.asarray(given, dtype=float), (count, width) if width > 1 else (count,))

    text = [
        f"# vtk DataFile Version 3.0\n{title}\n{'BINARY' if binary else 'ASCII'}\nDATASET RECTILINEAR_GRID\n".encode()
    ]
    if time is not None:
        moment = np.array([time], dtype=">f8").tobytes() + b"\n" if binary else f"{time!r}\n".encode()
        text += [b"FIELD FieldData 1\nTIME 1 1 double\n", moment]
    text.append(f"DIMENSIONS {' '.join(str(len(a)) for a in axes)}\n".encode())
    for name, a in zip("XYZ", axes, strict=True):
        text += [f"{name}_COORDINATES {len(a)} {kind}\n".encode(), numbers(a)]
    text += [f"POINT_DATA {count}\nVECTORS velocity {kind}\n".encode(), numbers(table(velocity, 3))]
    for name, values in arrays.items():
        if name == "fluctuation":
            text += [f"VECTORS {name} {kind}\n".encode(), numbers(table(values, 3))]
        else:
            text += [f"SCALARS {name} {kind} 1\nLOOKUP_TABLE default\n".encode(), numbers(table(values, 1))]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"".join(text))


def uneven(lo: float, hi: float, n: int, seed: int = 1) -> np.ndarray:
    """N coordinates from lo to hi, gaps up to 30 times as wide as others."""
    gaps = np.cumsum(np.random.default_rng(seed).uniform(0.1, 3.0, n - 1))
    return lo + (hi - lo) * np.concatenate([[0.0], gaps / gaps[-1]])
