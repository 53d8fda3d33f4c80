"""What accuracy each second buys: run settings of an input, weigh error against core-seconds.

STUDY.toml names a LAMMPS input script, its switches (variables with their values, the most careful first) and the
seeds. Every distinct run is done once, several at a time; an interrupted study goes on where it was. Writes to DIR
NAME.csv and NAME.md, the table, and NAME.png, error against core-seconds; NAME is the study's. With --tolerance also
NAME.in, an input with the cheapest setting that keeps every observable within it; where axes are changed one at a time,
the cheap settings are then combined, axis by axis, as far as the tolerance holds.
"""

from __future__ import annotations

import argparse
import sys

from ..errors import InputError
from ..plot.style import save
from ..studies.engine import find_engine
from ..studies.runs import only_one
from ..studies.template import TRADE, filled
from ..studies.trade.answer import in_words, write_answer
from ..studies.trade.campaign import Campaign
from ..studies.trade.figure import draw_pareto
from ..studies.trade.report import write_report, write_table
from ..studies.trade.schema import SCHEMA
from ..studies.trade.study import read_study
from ..studies.trade.weigh import cheapest
from .common import positive, tell
from .studying import add_study, check_options, jobs_of, tell_missing


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_study(parser, "trade", "tend 0.002", SCHEMA, lambda: filled(TRADE))
    parser.add_argument(
        "--tolerance", type=positive, metavar="SHARE", help="name the cheapest setting within this error, such as 0.05"
    )
    parser.add_argument("--seeds", type=int, metavar="N", help="seeds 1 to N in place of the study's")


def run(options: argparse.Namespace) -> None:
    check_options(options)
    study = read_study(
        options.study, dict(options.var), seeds=options.seeds, ranks=options.ranks, launcher=options.launcher
    )
    engine, out = find_engine(options.lmp), options.out
    campaign = Campaign(study, engine, (out / "runs").absolute(), jobs_of(options, study.ranks), options.dry_run)

    def carry_out() -> None:
        campaign.carry_out(campaign.planned())
        if options.tolerance and not study.product:
            campaign.combine(options.tolerance)

    if options.dry_run:
        tell_missing(carry_out, "; with a tolerance, settings that hold alone are run together after these")
        return
    with only_one(out / "runs"):
        carry_out()
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
