"""Averages over time as an option of the commands whose numbers they are of."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence

import numpy as np

from ..analysis.averages import TimeAverage, check_blocks
from ..errors import ArgumentError
from ..frame import Floats, Frame


def add_average(parser: argparse.ArgumentParser) -> None:
    """The number of blocks, and the time from which on frames count."""
    parser.add_argument(
        "--average",
        type=int,
        metavar="BLOCKS",
        help="also averages over the frames, with a standard error from so many blocks of frames in a row",
    )
    parser.add_argument("--since", type=float, metavar="S", help="average over the frames from this time on (s)")


def check_average(options: argparse.Namespace) -> None:
    """Refuse what can be no average before anything is read."""
    if options.average is not None:
        check_blocks(options.average)
    elif options.since is not None:
        raise ArgumentError("since", f"{options.since:g} s is for averages: give --average too")


def averaged(options: argparse.Namespace, heads: Sequence[Frame]) -> list[int]:
    """Numbers of the frames that averages are over.

    Raises
    ------
    ArgumentError
        If frames hold no time and one is asked for, or there are fewer of them than blocks.
    """
    chosen = list(range(len(heads)))
    if options.since is not None:
        if any(np.isnan(head.time) for head in heads):
            raise ArgumentError("since", "frames hold no time: give --dt")
        slack = 1e-9 * max(abs(head.time) for head in heads)  # times are products of steps, with their rounding
        chosen = [number for number in chosen if heads[number].time >= options.since - slack]
    check_blocks(options.average, len(chosen))
    return chosen


def columns_of(found: Mapping[str, TimeAverage]) -> dict[str, Floats]:
    """Averages as columns of a table: each with its standard error behind it, ``NAME_error``."""
    return {
        key: values for name, one in found.items() for key, values in ((name, one.mean), (f"{name}_error", one.error))
    }


def label_of(heads: Sequence[Frame]) -> str:
    """Which frames an average is over, for a figure."""
    return f"{len(heads)} frames, {heads[0].label} to {heads[-1].label.removeprefix('t = ')}"
