"""Every setting weighed: its cost, its errors, and the cheapest one that is accurate enough."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...errors import InputError
from ...times import same_times
from ..runs import Cost, Failure, Setting, StudyRun, read_cost
from .errors import Error, errors_of
from .frames import FRAMES, read_frames
from .observe import Observed, observe
from .schema import FEWEST_SEEDS
from .settings import REFERENCE
from .study import Study

WORTH = 0.02
"""Share of the core-seconds that a change must save; less is the clock's noise."""


@dataclass(frozen=True)
class Weighed:
    """A setting with what it costs and how far it is from the reference.

    Parameters
    ----------
    setting : Setting
        The setting.
    costs : dict of int to Cost
        Of its finished runs, by seed.
    errors : dict of str to Error or None
        By observable; None where the two cannot be compared.
    failures : tuple of Failure
        Its runs that failed.
    """

    setting: Setting
    costs: dict[int, Cost]
    errors: dict[str, Error | None]
    failures: tuple[Failure, ...]

    @property
    def core_seconds(self) -> float:
        """Median over seeds; infinite where no run finished."""
        return statistics.median(cost.core_seconds for cost in self.costs.values()) if self.costs else float("inf")

    @property
    def wall(self) -> float:
        """Median over seeds (s)."""
        return statistics.median(cost.wall for cost in self.costs.values()) if self.costs else float("inf")

    @property
    def changes(self) -> int:
        """On how many axes it leaves the reference."""
        return 0 if self.setting.axis == REFERENCE else self.setting.axis.count(" + ") + 1

    def cheaper_than(self, other: Weighed) -> bool:
        """Whether it is so beyond the clock's noise: worth it in the median, and with every seed."""
        return self.core_seconds <= (1 - WORTH) * other.core_seconds and all(
            cost.core_seconds < other.costs[seed].core_seconds
            for seed, cost in self.costs.items()
            if seed in other.costs
        )

    def within(self, tolerance: float) -> bool | None:
        """Whether every observable keeps the tolerance; None where that cannot be told with these seeds.

        A setting with failed runs, or one that cannot be compared, does not.
        """
        if self.failures or not all(self.errors.values()):
            return False
        told = [error.within(tolerance) for error in self.errors.values() if error is not None]
        return False if False in told else None if None in told else True


def weigh(
    study: Study, runs: Sequence[StudyRun], failures: Mapping[str, Failure], observed: dict[str, Observed]
) -> list[Weighed]:
    """Weigh all settings of the runs against the first, the reference.

    Parameters
    ----------
    study : Study
        What to observe.
    runs : sequence of StudyRun
        Those of the reference first.
    failures : mapping of str to Failure
        Runs that failed, by key.
    observed : dict of str to Observed
        What has been observed so far, by key; runs that are missing here are read and added.
    """
    by_setting: dict[str, list[StudyRun]] = {}
    for run in runs:
        by_setting.setdefault(f"{run.setting.axis}: {run.setting.name}", []).append(run)
    weighed: list[Weighed] = []
    reference: dict[int, Observed] = {}
    how = study.how
    for group in by_setting.values():
        done = [run for run in group if run.key not in failures]
        if not weighed:
            how = study.how.settled([frame for run in done for frame in read_frames(run.folder / FRAMES)])
        for run in done:
            if run.key not in observed:
                observed[run.key] = observe(read_frames(run.folder / FRAMES), study.observables, how)
        found = {run.seed: observed[run.key] for run in done}
        failed = tuple(failures[run.key] for run in group if run.key in failures)
        if not weighed:
            reference = found
            if len(reference) < FEWEST_SEEDS:
                raise InputError(
                    study.path,
                    f"the reference has {len(reference)} finished runs, it needs {FEWEST_SEEDS}"
                    + "".join(f"; {f.run.setting.name}, seed {f.run.seed}: {f.reason}" for f in failed[:1]),
                )
            _check_times(study, reference)
        errors = errors_of(found, reference, study.observables)
        weighed.append(Weighed(group[0].setting, {run.seed: read_cost(run) for run in done}, errors, failed))
    return weighed


def _check_times(study: Study, reference: Mapping[int, Observed]) -> None:
    """Refuse a reference whose seeds have frames at other times: their spread would compare different moments."""
    (first, one), *others = reference.items()
    for seed, other in others:
        if not same_times(one.times, other.times):
            there = [" ".join(f"{time:.6g}" for time in run.times[:3]) for run in (one, other)]
            rule = (
                f"the reference's seeds {first} and {seed} have frames at different times ({there[0]} … s, {there[1]} … s): "
                "dumps must come at the same times, not steps (dump_modify … every/time)"
            )
            raise InputError(study.path, rule)


def cheapest(weighed: Sequence[Weighed], tolerance: float) -> Weighed:
    """The setting of the fewest core-seconds within the tolerance (the reference always is).

    Where the clock cannot tell settings from it, the one with the fewest changes.
    """
    accurate = [w for w in weighed if w is weighed[0] or w.within(tolerance)]
    least = min(accurate, key=lambda w: w.core_seconds)
    return min((w for w in accurate if not least.cheaper_than(w)), key=lambda w: (w.changes, w.core_seconds))


def untold(weighed: Sequence[Weighed], answer: Weighed, tolerance: float) -> list[Weighed]:
    """Settings cheaper than the answer of which it cannot be told whether they keep the tolerance, cheapest first."""
    open_ones = [w for w in weighed[1:] if w.within(tolerance) is None and w.cheaper_than(answer)]
    return sorted(open_ones, key=lambda w: w.core_seconds)


def front(weighed: Sequence[Weighed], error: Mapping[int, float]) -> list[int]:
    """Numbers of the settings that no other beats in both cost and error (the Pareto front), cheapest first."""
    chosen: list[int] = []
    least = float("inf")
    for number in sorted(error, key=lambda number: (weighed[number].core_seconds, error[number])):
        if error[number] < least:
            chosen.append(number)
            least = error[number]
    return chosen
