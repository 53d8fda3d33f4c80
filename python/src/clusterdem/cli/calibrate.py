"""Fit numbers and choices of an input to observed numbers; tell what the data determine and what not.

STUDY.toml names LAMMPS input scripts, what was observed of each, and the parameters with their ranges or choices. Every
distinct run is done once, several at a time; an interrupted study goes on where it was. Writes to DIR NAME.md, the fit
with its uncertainty and what the data cannot tell apart; NAME.csv, the trials; NAME.png; NAME is the study's.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from ..errors import ArgumentError
from ..plot.style import save
from ..studies.calibrate.figure import draw_fit
from ..studies.calibrate.fit import carry_out
from ..studies.calibrate.model import EngineModel
from ..studies.calibrate.report import write_report, write_trials
from ..studies.calibrate.study import read_calibration
from ..studies.engine import find_engine
from ..studies.runs import only_one
from .common import tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("study", type=Path, metavar="STUDY.toml", help="the study file")
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("calibrate"),
        metavar="DIR",
        help="folder for results and runs (default calibrate)",
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="runs at a time (default: as many as the cores hold)")
    parser.add_argument("--lmp", metavar="PATH", help="LAMMPS (default: CLUSTERDEM_LMP, or lmp beside this command)")
    parser.add_argument("--trials", type=int, metavar="N", help="trials of the search, in place of the study's")
    parser.add_argument(
        "--var",
        nargs=2,
        action="append",
        default=[],
        metavar=("NAME", "VALUE"),
        help="a variable of every run, over the study's: --var height 0.1 for a short trial",
    )


def run(options: argparse.Namespace) -> None:
    for name in ("jobs", "trials"):
        if getattr(options, name) is not None and getattr(options, name) < 1:
            raise ArgumentError(name, "must be 1 or more")
    study = read_calibration(options.study, dict(options.var), options.trials)
    engine = find_engine(options.lmp)
    ranks = study.cases[0].ranks
    jobs = options.jobs or max(1, len(os.sched_getaffinity(0)) // ranks)
    model = EngineModel(study, engine, (options.out / "runs").absolute(), jobs)
    with only_one(options.out / "runs"):
        fit = carry_out(study, model)
    stem = options.out / study.path.stem
    tell(
        write_trials(stem.with_name(f"{stem.name}.csv"), fit),
        write_report(stem.with_name(f"{stem.name}.md"), fit, model),
        save(draw_fit(fit), stem.with_name(f"{stem.name}.png")),
    )
