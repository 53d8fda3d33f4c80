"""What is kept of a run's dumps: the columns that a study observes, of every frame, in one small file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...frame import Box, Frame
from ...io.output import atomic
from ...observables import columns_of
from ...primary import primary_beside
from ...run import Run
from ..runs import Keeping

FRAMES = "frames.npz"


def write_frames(path: Path, frames: Iterable[Frame]) -> int:
    """Write frames to an .npz file; how many."""
    arrays: dict[str, np.ndarray] = {}
    count = 0
    for frame in frames:
        arrays[f"when{count}"] = np.array([frame.step, frame.time])
        arrays[f"box{count}"] = np.array([frame.box.lo, frame.box.hi, frame.box.periodic], dtype=float)
        arrays |= {f"column{count} {name}": values for name, values in frame.columns.items()}
        count += 1
    with atomic(path) as name:
        np.savez_compressed(name, **arrays)  # type: ignore[arg-type]
    return count


def read_frames(path: Path) -> list[Frame]:
    """The frames of :func:`write_frames`; the log beside the file tells their primary particles."""
    frames: list[Frame] = []
    primary = primary_beside(path)
    with np.load(path) as data:
        while f"when{len(frames)}" in data:
            number = len(frames)
            step, time = data[f"when{number}"]
            lo, hi, periodic = data[f"box{number}"]
            box = Box(tuple(map(float, lo)), tuple(map(float, hi)), tuple(map(bool, periodic)))  # type: ignore[arg-type]
            prefix = f"column{number} "
            columns = {name.removeprefix(prefix): data[name] for name in data if name.startswith(prefix)}
            frames.append(Frame(int(step), float(time), box, columns, str(path), primary=primary))
    return frames


def keeping_of(observables: Sequence[str]) -> Keeping:
    """What a trade keeps of its runs; another set of columns is another kind of run."""
    columns = columns_of(observables)

    def keep(found: Run) -> None:
        frames = list(found.frames(("y", *columns)))
        if len(frames) < 2:
            raise InputError(found.path, "holds no frame after the start")
        if any(np.isnan(frame.time) for frame in frames):
            rule = "frames hold no time, by which runs are compared: dump_modify … time yes"
            raise InputError(found.dumps[0], rule)
        write_frames(found.path / FRAMES, frames)

    return Keeping(f"frames 2: {' '.join(sorted(columns))}", keep)
