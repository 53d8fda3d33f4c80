"""One self-contained HTML page about a run: maps, sizes, non-uniformity, ledger, timing, comparison.

RUNDIR holds the dumps NAME.STEP.dump and, where the engine wrote them, NAME.N.txt and NAME.log; a file command.txt
there is quoted. Writes RUNDIR/report.html unless --out says otherwise.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..published.numbers import CASES
from ..run import find_run
from .common import add_density, positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("rundir", type=Path, metavar="RUNDIR", help="folder of the run")
    parser.add_argument("--name", help="what the run's files begin with (default: found)")
    parser.add_argument("--case", choices=sorted(CASES), help="published case to compare with (default: by the name)")
    parser.add_argument(
        "--grid", type=int, nargs=2, default=(30, 30), metavar=("NX", "NZ"), help="cells along x and z (default 30 30)"
    )
    parser.add_argument("--dt", type=positive, metavar="S", help="timestep (s), for dumps that hold no time")
    parser.add_argument("--out", type=Path, metavar="FILE", help="the page (default RUNDIR/report.html)")
    add_density(parser)


def run(options: argparse.Namespace) -> None:
    from ..report.page import write_report  # brings MDAnalysis, which takes a second to import

    folder = find_run(options.rundir, options.name)
    path, error = write_report(
        folder, options.out, shape=tuple(options.grid), rho_p=options.rho, case=options.case, dt=options.dt
    )
    tell(path)
    if error is not None:
        raise error
