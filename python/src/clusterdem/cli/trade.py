"""What accuracy each second buys: run settings of an input, weigh error against core-seconds.

STUDY.toml names a LAMMPS input script, its switches (variables with their values, the most careful first) and the
seeds. Every distinct run is done once, several at a time; an interrupted study goes on where it was. Writes to DIR
NAME.csv and NAME.md, the table, and NAME.png, error against core-seconds; NAME is the study's. With --tolerance also
NAME.in, an input with the cheapest setting that keeps every observable within it; where axes are changed one at a time,
the cheap settings are then combined, axis by axis, as far as the tolerance holds.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from ..errors import ArgumentError, InputError
from ..plot.style import save
from ..studies.engine import find_engine
from ..studies.runs import only_one
from ..studies.trade.answer import in_words, write_answer
from ..studies.trade.campaign import Campaign
from ..studies.trade.figure import draw_pareto
from ..studies.trade.report import write_report, write_table
from ..studies.trade.study import read_study
from ..studies.trade.weigh import cheapest
from .common import positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("study", type=Path, metavar="STUDY.toml", help="the study file")
    parser.add_argument(
        "--tolerance", type=positive, metavar="SHARE", help="name the cheapest setting within this error, such as 0.05"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("trade"), metavar="DIR", help="folder for results and runs (default trade)"
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="runs at a time (default: as many as the cores hold)")
    parser.add_argument("--lmp", metavar="PATH", help="LAMMPS (default: CLUSTERDEM_LMP, or lmp beside this command)")
    parser.add_argument(
        "--var",
        nargs=2,
        action="append",
        default=[],
        metavar=("NAME", "VALUE"),
        help="a variable of every run, over the study's: --var tend 0.002 for a short trial",
    )
    parser.add_argument("--seeds", type=int, metavar="N", help="seeds 1 to N in place of the study's")
    parser.add_argument("--dry-run", action="store_true", help="say what would be run, and run nothing")


def run(options: argparse.Namespace) -> None:
    if options.jobs is not None and options.jobs < 1:
        raise ArgumentError("jobs", "must be 1 or more")
    study, engine, out = (
        read_study(options.study, dict(options.var), options.seeds),
        find_engine(options.lmp),
        options.out,
    )
    jobs = options.jobs or max(1, len(os.sched_getaffinity(0)) // study.ranks)
    campaign = Campaign(study, engine, (out / "runs").absolute(), jobs)
    planned = campaign.planned()
    if options.dry_run:
        for one in planned:
            print(f"{'done   ' if one.done else 'missing'}  seed {one.seed}  {one.setting.axis}: {one.setting.name}")
        return
    with only_one(out / "runs"):
        campaign.carry_out(planned)
        if options.tolerance and not study.product:
            campaign.combine(options.tolerance)
    weighed, failures = campaign.weighed, campaign.failures
    stem, words = out / study.path.stem, ""
    if options.tolerance:
        answer = cheapest(weighed, options.tolerance)
        words = in_words(weighed, answer, options.tolerance)
        tell(write_answer(stem.with_name(f"{stem.name}.in"), study, answer, words))
    tell(
        write_table(stem.with_name(f"{stem.name}.csv"), weighed, study.observables),
        write_report(stem.with_name(f"{stem.name}.md"), study, engine, weighed, words),
    )
    title = f"{study.path.stem}: grey, the spread between seeds; numbers as in the table"
    if options.tolerance:
        title += "; dashed, the tolerance"
    figure = draw_pareto(weighed, study.observables, title, options.tolerance)
    tell(save(figure, stem.with_name(f"{stem.name}.png")))
    if words:
        print(words)
    if failures:
        for failure in failures.values():
            print(failure.text, file=sys.stderr)
        rule = f"{len(failures)} of {len(campaign.runs)} runs failed; the others are in the table"
        raise InputError(study.path, rule)
