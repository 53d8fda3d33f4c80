"""Start positions of a case in one data file that LAMMPS and LIGGGHTS read alike.

In LAMMPS `-in inputs/case1.in -var start_file FILE`, in LIGGGHTS `-in inputs/liggghts/case1.in -var start_file FILE`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..io.start import write_start
from .common import tell

CLUSTERS = {"case1": 5000, "case2": 7750, "case3": 7750}
"""Of 400 particles each, in the paper."""


def _natural(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be a whole number above zero")
    return value


def _length(text: str) -> float:
    value = float(text)
    if not 1e-6 <= value <= 1e6:
        raise argparse.ArgumentTypeError("must be a length from 1e-6 to 1e6 m")
    return value


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--case", choices=sorted(CLUSTERS), default="case1", help="whose solids (default case1)")
    parser.add_argument("--seed", type=_natural, default=1, help="of the places (default 1)")
    parser.add_argument("--n", type=_natural, default=400, help="particles in a cluster (default 400)")
    parser.add_argument("--clusters", type=_natural, help="how many (default: those of the case, in particles)")
    parser.add_argument(
        "--box", type=_length, nargs=3, default=(0.3, 0.003, 0.6), metavar=("X", "Y", "Z"),
        help="lengths of the box (m) (default 0.3 0.003 0.6)",
    )  # fmt: skip
    parser.add_argument(
        "--out", type=Path, default=Path("start.data"), metavar="FILE", help="the data file (default start.data)"
    )


def run(options: argparse.Namespace) -> None:
    count = options.clusters or max(1, round(CLUSTERS[options.case] * 400 / options.n))
    tell(write_start(options.out, count, options.n, tuple(options.box), options.seed))
