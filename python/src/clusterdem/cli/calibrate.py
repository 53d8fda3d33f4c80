"""Fit numbers and choices of an input to observed numbers; tell what the data determine and what not.

STUDY.toml names LAMMPS input scripts, what was observed of each, and the parameters with their ranges or choices. Every
distinct run is done once, several at a time; an interrupted study goes on where it was. Writes to DIR NAME.md, the fit
with its uncertainty and what the data cannot tell apart; NAME.csv, the trials; NAME.png; NAME is the study's.
"""

from __future__ import annotations

import argparse

from ..plot.style import save
from ..studies.calibrate.figure import draw_fit
from ..studies.calibrate.fit import carry_out
from ..studies.calibrate.model import EngineModel
from ..studies.calibrate.report import write_report, write_trials
from ..studies.calibrate.schema import SCHEMA
from ..studies.calibrate.study import read_calibration
from ..studies.engine import find_engine
from ..studies.runs import only_one
from ..studies.template import CALIBRATE, filled
from .common import tell
from .studying import add_study, check_options, jobs_of, tell_missing


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_study(parser, "calibrate", "height 0.1", SCHEMA, lambda: filled(CALIBRATE))
    parser.add_argument("--trials", type=int, metavar="N", help="trials of the search, in place of the study's")


def run(options: argparse.Namespace) -> None:
    check_options(options, "trials")
    study = read_calibration(
        options.study, dict(options.var), options.trials, ranks=options.ranks, launcher=options.launcher
    )
    engine, jobs = find_engine(options.lmp), jobs_of(options, study.cases[0].ranks)
    model = EngineModel(study, engine, (options.out / "runs").absolute(), jobs, options.dry_run)
    if options.dry_run:
        tell_missing(lambda: carry_out(study, model), "; which ones follow depends on what these give")
        return
    with only_one(options.out / "runs"):
        fit = carry_out(study, model)
    stem = options.out / study.path.stem
    tell(
        write_trials(stem.with_name(f"{stem.name}.csv"), fit),
        write_report(stem.with_name(f"{stem.name}.md"), fit, model),
        save(draw_fit(fit), stem.with_name(f"{stem.name}.png")),
    )
