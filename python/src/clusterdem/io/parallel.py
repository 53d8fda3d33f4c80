"""Work on every frame, spread over MPI ranks where ``mpirun`` started several."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from tqdm import tqdm

from ..errors import ArgumentError, InputError
from ..frame import Frame
from .reader import check_same_box, is_later, natural_order, read_file

T = TypeVar("T")
LAUNCHED = ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK")


def communicator() -> Any | None:
    """The world communicator of a run under ``mpirun`` with several ranks, else None."""
    if not any(name in os.environ for name in LAUNCHED):
        return None
    try:
        from mpi4py import MPI
    except ImportError as error:
        raise ArgumentError("ranks", "several ranks need the package mpi4py: pip install mpi4py") from error
    return MPI.COMM_WORLD if MPI.COMM_WORLD.size > 1 else None


@dataclass
class Gathered(Generic[T]):
    """What came out of all frames, in order of time.

    Parameters
    ----------
    heads : list of Frame
        The frames without their columns.
    values : list
        What the work returned for each.
    error : InputError or ArgumentError or None
        What ended the reading early; the frames before it are kept.
    root : bool
        Whether this is the rank that holds them and writes what concerns all frames.
    """

    heads: list[Frame] = field(default_factory=list)
    values: list[T] = field(default_factory=list)
    error: InputError | ArgumentError | None = None
    root: bool = True


def over_frames(
    paths: Sequence[str | Path],
    work: Callable[[Frame], T],
    columns: Collection[str] | None = None,
    dt: float | None = None,
    density: float | None = None,
    one_box: str = "",
) -> Gathered[T]:
    """Apply ``work`` to each frame, holding one frame per rank at a time.

    Parameters
    ----------
    paths : sequence of str or Path
        Dump files; taken in natural order.
    work : callable
        Turns a frame into something small that can be sent between ranks.
    columns, dt, density
        As in :func:`clusterdem.read_file`.
    one_box : str
        Who needs one box for all frames, such as "maps need"; empty if nobody does.

    Returns
    -------
    Gathered
        Complete on the root rank; the others hold the error only.
    """
    comm = communicator()
    rank, size = (comm.rank, comm.size) if comm else (0, 1)
    files = natural_order(paths)
    found: list[tuple[tuple[int, int], Frame, T]] = []
    failed: tuple[tuple[int, int], InputError | ArgumentError] | None = None
    bar = tqdm(files, unit="file", disable=rank > 0 or not sys.stderr.isatty(), leave=False, file=sys.stderr)
    before: Frame | None = None
    for number, path in enumerate(bar):
        key = (number, -1)
        try:
            own = (rank - number) % size
            for index, frame in enumerate(read_file(path, columns, share=(own, size), dt=dt, density=density)):
                key = (number, own + index * size)
                if before is not None:
                    if not is_later(before, frame):
                        continue
                    if one_box:
                        check_same_box(before, frame, one_box)
                before = frame.head
                found.append((key, before, work(frame)))
        except (InputError, ArgumentError) as error:
            failed = ((number, key[1] + 1), error)
            break
        except BaseException as error:
            if comm is not None:  # the other ranks wait for this one
                print(f"clusterdem: rank {rank}: {type(error).__name__}: {error}", file=sys.stderr, flush=True)
                comm.Abort(130 if isinstance(error, KeyboardInterrupt) else 1)
            raise
    if comm is not None:
        gathered = comm.gather((found, failed))
        if rank == 0:
            found = sorted((item for part, _ in gathered for item in part), key=lambda item: item[0])
            failures = [failure for _, failure in gathered if failure is not None]
            failed = min(failures, key=lambda failure: failure[0]) if failures else None
        else:
            found = []
    result: Gathered[T] = Gathered(error=failed[1] if failed else None, root=rank == 0)
    for key, head, value in found:
        if failed is not None and key >= failed[0]:
            break
        if result.heads:
            try:
                if not is_later(result.heads[-1], head):
                    continue
                if one_box:
                    check_same_box(result.heads[-1], head, one_box)
            except InputError as error:
                result.error = error
                break
        result.heads.append(head)
        result.values.append(value)
    if comm is not None:
        result.error, kept = comm.bcast((result.error, len(result.heads)))
        if kept == 0 and result.error is not None:
            raise result.error
    elif result.error is not None and not result.heads:
        raise result.error
    return result


def size_range(dumps: Sequence[str | Path], density: float | None = None) -> tuple[float, float]:
    """Smallest and largest diameter of all frames (m), on every rank; infinity and 0 where there are no clusters."""
    found = over_frames(
        dumps,
        lambda frame: (float(frame.diameter.min(initial=np.inf)), float(frame.diameter.max(initial=0.0))),
        (),
        density=density,
    )
    low, high = min((low for low, _ in found.values), default=np.inf), max((up for _, up in found.values), default=0.0)
    comm = communicator()
    known: tuple[float, float] = comm.bcast((low, high)) if comm else (low, high)
    return known
