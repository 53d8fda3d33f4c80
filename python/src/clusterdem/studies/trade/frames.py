"""What is kept of a run's dumps: the columns that a study observes, of every frame, in one small file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from ...frame import Box, Frame
from ...io.output import atomic
from ...observables import columns_of, find
from ...primary import primary_beside
from ...run import Run
from ..runs import Keeping, frames_of

FRAMES = "frames.npz"


def write_frames(path: Path, frames: Iterable[Frame]) -> int:
    """Write frames to an .npz file; how many."""
    arrays: dict[str, np.ndarray] = {}
    count = 0
    for frame in frames:
        arrays[f"when{count}"] = np.array([frame.step, frame.time])
        arrays[f"box{count}"] = np.array([frame.box.lo, frame.box.hi, frame.box.periodic], dtype=float)
        arrays |= {f"run{count} {name}": np.array(number) for name, number in frame.run.items()}
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
            columns, run = (
                {name.removeprefix(prefix): data[name] for name in data if name.startswith(prefix)}
                for prefix in (f"column{number} ", f"run{number} ")
            )
            of_run = {name: float(value) for name, value in run.items()}
            frames.append(Frame(int(step), float(time), box, columns, str(path), primary=primary, run=of_run))
    return frames


def keeping_of(observables: Sequence[str]) -> Keeping:
    """What a trade keeps of its runs; another set of columns is another kind of run."""
    columns = columns_of(observables)
    of_run = sorted({name for own in observables for name in find(own).of_run})

    def keep(found: Run) -> None:
        write_frames(found.path / FRAMES, frames_of(found, observables))

    run = f"; run {' '.join(of_run)}" if of_run else ""
    return Keeping(f"frames 2: {' '.join(sorted(columns))}{run}", keep)
