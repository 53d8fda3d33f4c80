"""Lacey's mixing index of two kinds of clusters over time.

Writes to DIR mixing.csv (a row per frame: the share of the kind, occupied sampling cells, clusters per cell, the variance of the
share between cells with its values where segregated and where mixed by chance, and the index) and mixing.png. The index is 0
where no cell holds both kinds and 1 where they lie by chance; it depends on the cells, which --grid sets.
"""

from __future__ import annotations

import argparse
from dataclasses import astuple, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..analysis.grid import cell_of
from ..analysis.mixing import Lacey, lacey
from ..errors import ArgumentError, InputError
from ..frame import Frame
from ..io.output import write_csv
from ..io.parallel import over_frames
from ..plot.mixing import draw_mixing
from ..plot.style import save
from .common import add_any_cells, add_dumps, any_grid_for, check_any_grid, finish, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--type", type=int, nargs="+", metavar="T", help="the kind: clusters of these atom types")
    kind.add_argument(
        "--above",
        nargs=2,
        metavar=("COLUMN", "VALUE"),
        help="the kind: clusters of which a column is above a value (SI units)",
    )
    add_any_cells(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("mixing"), metavar="DIR", help="folder for the results (default mixing)"
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def _kind(options: argparse.Namespace) -> tuple[str, float]:
    """The column that tells the kinds apart, and the value above which it is the one."""
    if options.above is None:
        return "type", float("nan")
    column, text = options.above
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        raise ArgumentError("above", f"needs a column and a number, not {column} {text}")
    return column, value


def run(options: argparse.Namespace) -> None:
    check_any_grid(options)
    column, value = _kind(options)

    def of_kind(frame: Frame) -> NDArray[np.bool_]:
        if column not in frame:
            raise InputError(frame.path, f"no column {column} of numbers, which tells the kinds apart", frame.line)
        if options.above is None:
            return np.isin(np.rint(frame[column]), options.type)
        return frame[column] > value

    def work(frame: Frame) -> Lacey:
        grid = any_grid_for(options, frame)
        return lacey(of_kind(frame), cell_of(grid, *grid.places(frame)))

    found = over_frames(options.dumps, work, ("x", "y", "z", column), options.dt, options.rho)
    if found.root and found.heads:
        out: Path = options.out
        if all(not one.segregated > 0 for one in found.values):
            chosen = f"type {' '.join(map(str, options.type))}" if options.above is None else f"{column} > {value:g}"
            raise ArgumentError(
                "type" if options.above is None else "above", f"{chosen} holds of every cluster or of none"
            )
        names = [field.name for field in fields(Lacey)]
        rows = [(head.step, head.time, *astuple(one)) for head, one in zip(found.heads, found.values)]
        tell(write_csv(out / "mixing.csv", ["step", "time", *names], rows))
        if not options.no_figures:
            times = np.array([head.time for head in found.heads])
            steps = np.array([head.step for head in found.heads])
            tell(save(draw_mixing(times, steps, found.values), out / "mixing.png"))
    finish(found)
