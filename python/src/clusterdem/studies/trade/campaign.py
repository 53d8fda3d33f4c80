"""A study being carried out: its settings run and weighed, then combined as far as the tolerance allows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from ..engine import Engine
from ..runs import Failure, Setting, StudyRun, perform, plan
from .frames import keeping_of
from .observe import Observed
from .settings import settings_of, together
from .study import Study
from .weigh import Weighed, cheapest, weigh


@dataclass
class Campaign:
    """Runs of a study and what came out.

    Parameters
    ----------
    study, engine : Study, Engine
        What to run, and with what.
    folder : Path
        Where runs are kept.
    jobs : int
        Runs at a time.
    dry : bool
        Whether missing runs are only told, by :class:`clusterdem.studies.runs.Missing`.
    """

    study: Study
    engine: Engine
    folder: Path
    jobs: int
    dry: bool = False
    runs: list[StudyRun] = field(default_factory=list)
    failures: dict[str, Failure] = field(default_factory=dict)
    weighed: list[Weighed] = field(default_factory=list)
    observed: dict[str, Observed] = field(default_factory=dict)

    def planned(self) -> list[StudyRun]:
        """The runs of all settings that the study names."""
        return self._plan(settings_of(self.study))

    def _plan(self, settings: Iterable[Setting]) -> list[StudyRun]:
        return plan(self.study, settings, self.engine, self.folder, keeping_of(self.study.observables))

    def carry_out(self, runs: Iterable[StudyRun]) -> None:
        """Do runs, and weigh all settings so far."""
        new = list(runs)
        self.failures |= perform(new, self.jobs, dry=self.dry)
        self.runs += new
        self.weighed = weigh(self.study, self.runs, self.failures, self.observed)

    def combine(self, tolerance: float) -> None:
        """Join the axes' cheap settings, one axis after the other, each as far as the tolerance holds.

        What is accurate alone need not be together: rare checks and long steps each cost little, both a lot. So every
        combination is run. The axis that saves most comes first; of each axis the cheapest setting that holds is kept.
        """
        alone = [w for w in self.weighed[1:] if w.within(tolerance) and w.cheaper_than(self.weighed[0])]
        alone.sort(key=lambda w: w.core_seconds)
        kept: list[Setting] = []
        for axis in dict.fromkeys(w.setting.axis for w in alone):
            for candidate in (w.setting for w in alone if w.setting.axis == axis):
                if not kept:
                    kept.append(candidate)
                    break
                joined = together(self.study, [*kept, candidate])
                self.carry_out(self._plan([joined]))
                if cheapest(self.weighed, tolerance) is self.weighed[-1]:
                    kept.append(candidate)
                    break
