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
from ...observables import find
from ...run import Run
from ..engine import Engine
from ..runs import Failure, Keeping, Setting, StudyRun, frames_of, perform, plan
from .parameters import Point, described, fill
from .study import Calibration, Case, Stage
from .targets import KEPT, numbers_of, read_off, without_frame

NUMBERS = "numbers.json"


class Model(Protocol):
    """Anything that can be fitted."""

    def observe(self, wanted: Sequence[tuple[Point, int]], stage: Stage) -> list[Floats]:
        """Numbers for the targets of all cases, shape (M,), at points with seeds; NaN where there are none."""

    def blamed(self) -> str:
        """Why numbers are not there; empty if nothing failed."""


def keeping_of(study: Calibration) -> Keeping:
    """What a calibration keeps of its runs: every quantity of every frame, a few kB; other size classes are other runs."""
    own = {target.quantity for case in study.cases for target in case.targets} - set(KEPT)
    names = (*KEPT, *sorted(own))

    def keep(found: Run) -> None:
        frames = frames_of(found, names)
        write_text(found.path / NUMBERS, json.dumps(numbers_of(frames, names, study.how)) + "\n")

    borders = " ".join(f"{border:g}" for border in study.how.borders)
    sources = "".join(f"; {name} = {find(name).source}" for name in names if find(name).source)
    return Keeping(f"numbers 2: {' '.join(names)}; classes {borders}; plane {study.how.plane}{sources}", keep)


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
    dry : bool
        Whether missing runs are only told, by :class:`clusterdem.studies.runs.Missing`.
    failures : dict of str to Failure
        Runs that failed so far, by key.
    used : set of str
        Keys of the runs looked at so far.
    """

    study: Calibration
    engine: Engine
    folder: Path
    jobs: int
    dry: bool = False
    failures: dict[str, Failure] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    def observe(self, wanted: Sequence[tuple[Point, int]], stage: Stage) -> list[Floats]:
        """Numbers at points with seeds; runs that are not there yet are done."""
        runs = [[self.planned(case, point, seed, stage) for case in self.study.cases] for point, seed in wanted]
        every = [run for row in runs for run in row]
        self.used |= {run.key for run in every}
        self.failures |= perform(every, self.jobs, quiet=True, dry=self.dry)
        return [np.concatenate([self.read(case, run) for case, run in zip(self.study.cases, row)]) for row in runs]

    def planned(self, case: Case, point: Point, seed: int, stage: Stage) -> StudyRun:
        """The run of a case at a point."""
        variables = fill(case.variables | stage.variables, point)
        task = replace(case, seeds=(seed,))
        setting = Setting(case.name, described(point), variables)
        limit = case.limit or stage.limit
        return plan(task, [setting], self.engine, self.folder, keeping_of(self.study), limit)[0]

    def read(self, case: Case, run: StudyRun) -> Floats:
        """The numbers of a run; NaN of one that took too long or failed."""
        if not run.done:
            return np.full(len(case.targets), np.nan)
        numbers = json.loads((run.folder / NUMBERS).read_text())
        for target in without_frame(case.targets, numbers):
            rule = f"case {case.name!r}: its run has no frame at {target.time:g} s ({run.folder})"
            raise InputError(self.study.path, rule)
        return read_off(case.targets, numbers, case.solids)

    def blamed(self) -> str:
        """The words of the first run that failed, not by taking too long; empty without one."""
        return next((failure.text for failure in self.failures.values() if not failure.run.overran), "")
