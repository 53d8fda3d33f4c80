"""A run's clusters, sizes and densest cells beside the paper's numbers and the prototype's.

Prints a table of the solids in the domain, N(t), mean diameter, the paper's four size classes (percent of clusters by
number) and the largest cell fraction, each with the difference to the published value and to reading A of the model.
Frames count for the time that they are nearest to, within 1 % of it. Where the domain holds less solids than the case,
numbers of clusters are scaled to the case's.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from ..errors import ArgumentError, InputError
from ..io.output import write_text
from ..io.parallel import over_frames
from ..published.cases import CASES
from ..published.compare import as_text, compare, moment_of
from .common import add_density, add_dumps, finish, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_density(parser)
    parser.add_argument("--case", required=True, choices=sorted(CASES), help="the paper's case")
    parser.add_argument(
        "--rows", nargs="+", default=["paper", "row A"], metavar="ROW", help="sources: paper, 'row A' … 'row E'"
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="also write the table to this file")


def run(options: argparse.Namespace) -> None:
    known = [row.name for row in CASES[options.case].rows]
    unknown = [name for name in options.rows if name not in known]
    if unknown:
        raise ArgumentError("rows", f"{options.case} has no {unknown[0]!r}; it has {', '.join(known)}")
    found = over_frames(options.dumps, lambda frame: moment_of(frame), ("n", "type"), options.dt, options.rho)
    if found.root and found.heads:
        for head in found.heads:
            if math.isnan(head.time):
                raise InputError(head.path, "holds no time to compare at: give --dt", head.line)
        text = as_text(compare(found.values, options.case, options.rows))
        print(text, end="")
        if options.out is not None:
            tell(write_text(options.out, text))
    finish(found)
