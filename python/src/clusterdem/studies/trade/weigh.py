"""Every setting weighed: its cost, its errors, and the cheapest one that is accurate enough."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...errors import InputError
from ..runs import Cost, Failure, Run, Setting, read_cost
from .errors import Error, errors_of
from .frames import read_frames
from .observables import Observed, observe
from .settings import REFERENCE
from .study import FEWEST_SEEDS, Study

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

    def within(self, tolerance: float) -> bool:
        """Whether all runs finished and every observable keeps the tolerance."""
        known = [error for error in self.errors.values() if error is not None]
        return not self.failures and len(known) == len(self.errors) and all(e.counted <= tolerance for e in known)


def weigh(
    study: Study, runs: Sequence[Run], failures: Mapping[str, Failure], observed: dict[str, Observed]
) -> list[Weighed]:
    """Weigh all settings of the runs against the first, the reference.

    Parameters
    ----------
    study : Study
        What to observe.
    runs : sequence of Run
        Those of the reference first.
    failures : mapping of str to Failure
        Runs that failed, by key.
    observed : dict of str to Observed
        What has been observed so far, by key; runs that are missing here are read and added.
    """
    by_setting: dict[str, list[Run]] = {}
    for run in runs:
        by_setting.setdefault(f"{run.setting.axis}: {run.setting.name}", []).append(run)
    weighed: list[Weighed] = []
    reference: dict[int, Observed] = {}
    for group in by_setting.values():
        done = [run for run in group if run.key not in failures]
        for run in done:
            if run.key not in observed:
                observed[run.key] = observe(read_frames(run.folder / "frames.npz"), study.observables, study.cell)
        found = {run.seed: observed[run.key] for run in done}
        failed = tuple(failures[run.key] for run in group if run.key in failures)
        if not weighed:
            reference = found
            if len(reference) < FEWEST_SEEDS:
                raise InputError(
                    study.path,
                    f"the reference has {len(reference)} finished runs, it needs {FEWEST_SEEDS}"
                    + "".join(f"; {failure.text}" for failure in failed[:1]),
                )
        errors = errors_of(found, reference, study.observables)
        weighed.append(Weighed(group[0].setting, {run.seed: read_cost(run) for run in done}, errors, failed))
    return weighed


def cheapest(weighed: Sequence[Weighed], tolerance: float) -> Weighed:
    """The setting of the fewest core-seconds within the tolerance (the reference always is).

    Where the clock cannot tell settings from it, the one with the fewest changes.
    """
    accurate = [w for w in weighed if w is weighed[0] or w.within(tolerance)]
    least = min(accurate, key=lambda w: w.core_seconds)
    return min((w for w in accurate if not least.cheaper_than(w)), key=lambda w: (w.changes, w.core_seconds))


def front(weighed: Sequence[Weighed], error: Mapping[int, float]) -> list[int]:
    """Numbers of the settings that no other beats in both cost and error (the Pareto front), cheapest first."""
    chosen: list[int] = []
    least = float("inf")
    for number in sorted(error, key=lambda number: (weighed[number].core_seconds, error[number])):
        if error[number] < least:
            chosen.append(number)
            least = error[number]
    return chosen
