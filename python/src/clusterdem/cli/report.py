"""One self-contained HTML page about a run: maps, sizes, non-uniformity, ledger, timing, comparison.

RUN is the folder of a run, which holds the dumps NAME.STEP.dump and, where the engine wrote them, NAME.N.txt and NAME.log; a
file command.txt there is quoted. Or RUN… are dump files of any name. Writes report.html beside the dumps unless --out says
otherwise.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..errors import ArgumentError
from ..published.cases import CASES
from ..report.page import write_report
from ..run import Run
from .common import add_cells, add_density, columns_for, positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN", help="folder of the run, or its dump files")
    parser.add_argument("--name", help="what the run's files begin with (default: found)")
    parser.add_argument("--case", choices=sorted(CASES), help="published case to compare with (default: by the name)")
    add_cells(parser)
    parser.add_argument("--dt", type=positive, metavar="S", help="timestep (s), for dumps that hold no time")
    parser.add_argument("--out", type=Path, metavar="FILE", help="the page (default report.html beside the dumps)")
    add_density(parser)


def run(options: argparse.Namespace) -> None:
    columns_for(options.plane)  # refuses what is no plane
    if len(options.runs) == 1 and not options.runs[0].is_file():
        found = Run(options.runs[0], options.name, dt=options.dt, density=options.rho)
    elif options.name is not None:
        raise ArgumentError("name", "is for the folder of a run, not for dump files")
    else:
        found = Run.of_dumps(options.runs, dt=options.dt, density=options.rho)
    path, error = write_report(found, options.out, shape=tuple(options.grid), plane=options.plane, case=options.case)
    tell(path)
    if error is not None:
        raise error
