"""What the commands that run studies share: their options, and what ends them without a run."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..errors import ArgumentError
from ..studies.launch import check_launcher
from ..studies.runs import Missing
from ..studies.schema import Schema


class _Print(argparse.Action):
    """An option that prints something, and that is all."""

    def __init__(self, *, const: Callable[[], str], **given: Any) -> None:
        super().__init__(nargs=0, const=const, **given)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(self.const(), end="")
        parser.exit()


def add_study(
    parser: argparse.ArgumentParser, out: str, example: str, schema: Schema, template: Callable[[], str]
) -> None:
    """The study file and how its runs are made; ``example`` are variables of a short trial."""
    parser.add_argument("study", type=Path, metavar="STUDY.toml", help="the study file")
    parser.add_argument(
        "--out", type=Path, default=Path(out), metavar="DIR", help=f"folder for results and runs (default {out})"
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="runs at a time (default: as many as the cores hold)")
    parser.add_argument("--lmp", metavar="PATH", help="LAMMPS (default: CLUSTERDEM_LMP, or lmp beside this command)")
    parser.add_argument("--ranks", type=int, metavar="N", help="MPI ranks of a run, in place of the study's")
    parser.add_argument(
        "--launcher",
        metavar="WORDS",
        help="what starts a run, such as 'srun -n {np}': {np} is replaced by the ranks, {name} by the run's name, "
        "{folder} by its folder (default: mpirun -np {np} where ranks are more than 1)",
    )
    parser.add_argument(
        "--var",
        nargs=2,
        action="append",
        default=[],
        metavar=("NAME", "VALUE"),
        help=f"a variable of every run, over the study's: --var {example} for a short trial",
    )
    parser.add_argument(
        "--dry-run", action="store_true", help="print the commands of the runs that are missing; run and write nothing"
    )
    parser.add_argument("--template", action=_Print, const=template, help="print a study that runs as it is")
    parser.add_argument(
        "--schema",
        action=_Print,
        const=lambda: json.dumps(schema, indent=2, ensure_ascii=False) + "\n",
        help="print the JSON schema by which study files are checked",
    )


def check_options(options: argparse.Namespace, *counts: str) -> None:
    """Refuse counts below one, and launchers that are none."""
    for name in ("jobs", "ranks", *counts):
        if getattr(options, name) is not None and getattr(options, name) < 1:
            raise ArgumentError(name, f"must be 1 or more, not {getattr(options, name)}")
    if options.launcher is not None:
        check_launcher(options.launcher)


def jobs_of(options: argparse.Namespace, ranks: int) -> int:
    """Runs at a time."""
    return options.jobs or max(1, len(os.sched_getaffinity(0)) // ranks)


def tell_missing(carry_out: Callable[[], object], rest: str) -> None:
    """Print the commands of the runs that a study would do next; ``rest`` says what may follow them."""
    try:
        carry_out()
    except Missing as missing:
        print(f"# {missing}{rest}")
        for run in missing.runs:
            print(f"# seed {run.seed}, {run.setting.axis}: {run.setting.name}\n{run.line}")
    else:
        print("# all runs are done")
