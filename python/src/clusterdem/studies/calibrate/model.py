"""What is being fitted, seen from the fit: a point and a seed go in, numbers beside the observed ones come out."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from ...errors import InputError
from ...frame import Floats
from ...io.output import write_text
from ...io.reader import read_dumps
from ...run import RunFolder
from ..engine import Engine
from ..runs import Failure, Keeping, Run, Setting, perform, plan
from .parameters import Point, described, fill
from .study import Calibration, Case, Stage
from .targets import numbers_of, read_off

NUMBERS = "numbers.json"


class Model(Protocol):
    """Anything that can be fitted."""

    def observe(self, wanted: Sequence[tuple[Point, int]], stage: Stage) -> list[Floats]:
        """Numbers for the targets of all cases, shape (M,), at points with seeds; NaN where there are none."""


def _keep(found: RunFolder) -> None:
    frames = list(read_dumps(found.dumps, columns=()))
    if len(frames) < 2:
        raise InputError(found.dumps[0], "holds no frame after the start")
    write_text(found.path / NUMBERS, json.dumps(numbers_of(frames)) + "\n")


KEEPING = Keeping("numbers 1", _keep)
"""Of a calibration's runs: every quantity of every frame, a few kB."""


@dataclass
class EngineModel:
    """The model that LAMMPS runs.

    Parameters
    ----------
    study : Calibration
        Its cases and parameters.
    engine : Engine
        What runs it.
    folder : Path
        Where runs are kept.
    jobs : int
        Runs at a time.
    failures : dict of str to Failure
        Runs that failed so far, by key.
    used : set of str
        Keys of the runs looked at so far.
    """

    study: Calibration
    engine: Engine
    folder: Path
    jobs: int
    failures: dict[str, Failure] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    def observe(self, wanted: Sequence[tuple[Point, int]], stage: Stage) -> list[Floats]:
        """Numbers at points with seeds; runs that are not there yet are done."""
        runs = [[self.planned(case, point, seed, stage) for case in self.study.cases] for point, seed in wanted]
        every = [run for row in runs for run in row]
        self.used |= {run.key for run in every}
        self.failures |= perform(every, self.jobs, quiet=True)
        return [np.concatenate([self.read(case, run) for case, run in zip(self.study.cases, row)]) for row in runs]

    def planned(self, case: Case, point: Point, seed: int, stage: Stage) -> Run:
        """The run of a case at a point."""
        variables = fill(case.variables | stage.variables, point)
        task = replace(case, seeds=(seed,))
        setting = Setting(case.name, described(point), variables)
        return plan(task, [setting], self.engine, self.folder, KEEPING, stage.limit)[0]

    def read(self, case: Case, run: Run) -> Floats:
        """The numbers of a run."""
        if not run.done:
            if not run.overran:  # whatever it is, it would be so again and again
                raise InputError(self.study.path, f"a run failed: {self.failures[run.key].text}")
            return np.full(len(case.targets), np.nan)
        found = read_off(case.targets, json.loads((run.folder / NUMBERS).read_text()), case.solids)
        for target, number in zip(case.targets, found):
            if np.isnan(number):
                rule = f"case {case.name!r}: its run has no frame at {target.time:g} s ({run.folder})"
                raise InputError(self.study.path, rule)
        return found
