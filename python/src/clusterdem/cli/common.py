"""Options and endings that several commands share."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ..analysis.grid import RHO_P
from ..io.parallel import Gathered


def positive(text: str) -> float:
    """A number above zero, for argparse."""
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError("must be a positive number")
    return value


def add_dumps(parser: argparse.ArgumentParser) -> None:
    """The dump files and what is needed to read them."""
    parser.add_argument(
        "dumps", nargs="+", metavar="DUMP", help="dump files (text, .gz and .zst too, or binary), any order"
    )
    parser.add_argument("--dt", type=positive, metavar="S", help="timestep (s), for dumps that hold no time")


def add_density(parser: argparse.ArgumentParser) -> None:
    """The density of the primary particles."""
    parser.add_argument(
        "--rho", type=positive, default=RHO_P, metavar="KG/M3", help="density of the primary particles (default 2000)"
    )


def add_grid(parser: argparse.ArgumentParser) -> None:
    """The grid and how clusters are put on it."""
    parser.add_argument(
        "--grid", type=int, nargs=2, default=(30, 30), metavar=("NX", "NZ"), help="cells along x and z (default 30 30)"
    )
    parser.add_argument(
        "--deposit",
        choices=("nearest", "overlap"),
        default="nearest",
        help="a cluster's mass to its centre's cell, or to each cell its exact share (default nearest)",
    )


def tell(*paths: Path) -> None:
    """Print written paths, one a line."""
    for path in paths:
        print(path)


def finish(gathered: Gathered[Any]) -> None:
    """Raise what ended the reading early, now that the finished frames are written."""
    if gathered.error is not None:
        raise gathered.error
