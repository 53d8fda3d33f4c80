"""Clusters as tables, one CSV or Parquet file per frame, with step and time as the first columns.

One file per frame keeps memory at one frame; polars, pandas and DuckDB read DIR/*.parquet as one table.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..frame import Frame
from ..io.output import atomic
from ..io.parallel import over_frames
from .common import add_dumps, finish, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument("--format", choices=("csv", "parquet"), default="csv", help="kind of table (default csv)")
    parser.add_argument(
        "--out", type=Path, default=Path("table"), metavar="DIR", help="folder for the results (default table)"
    )


def run(options: argparse.Namespace) -> None:
    def work(frame: Frame) -> Path:
        path: Path = options.out / f"clusters.{frame.step:010d}.{options.format}"
        with atomic(path) as name:
            table = frame.to_polars()
            if options.format == "csv":
                table.write_csv(name)
            else:
                table.write_parquet(name)
        return path

    found = over_frames(options.dumps, work, None, options.dt, options.rho)
    if found.root:
        tell(*found.values)
    finish(found)
