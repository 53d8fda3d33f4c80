"""What is kept of a run's dumps: positions, diameters and masses of every frame, in one small file."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...frame import Box, Frame
from ...io.output import atomic
from ...io.reader import read_dumps
from ...run import RunFolder
from ..runs import Keeping

COLUMNS = ("x", "z", "diameter", "mass")


def write_frames(path: Path, frames: Iterable[Frame]) -> int:
    """Write frames to an .npz file; how many."""
    arrays: dict[str, np.ndarray] = {}
    count = 0
    for frame in frames:
        arrays[f"when{count}"] = np.array([frame.step, frame.time])
        arrays[f"box{count}"] = np.array([frame.box.lo, frame.box.hi, frame.box.periodic], dtype=float)
        arrays |= {f"{name}{count}": frame[name] for name in COLUMNS}
        count += 1
    with atomic(path) as name:
        np.savez_compressed(name, **arrays)  # type: ignore[arg-type]
    return count


def read_frames(path: Path) -> list[Frame]:
    """The frames of :func:`write_frames`."""
    frames: list[Frame] = []
    with np.load(path) as data:
        while f"when{len(frames)}" in data:
            number = len(frames)
            step, time = data[f"when{number}"]
            lo, hi, periodic = data[f"box{number}"]
            box = Box(tuple(map(float, lo)), tuple(map(float, hi)), tuple(map(bool, periodic)))  # type: ignore[arg-type]
            columns = {name: data[f"{name}{number}"] for name in COLUMNS}
            frames.append(Frame(int(step), float(time), box, columns, str(path)))
    return frames


def _keep(found: RunFolder) -> None:
    if write_frames(found.path / "frames.npz", read_dumps(found.dumps, columns=())) < 2:
        raise InputError(found.dumps[0], "holds no frame after the start")


KEEPING = Keeping(1, _keep)
"""Of a trade's runs."""
