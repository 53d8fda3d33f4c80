"""What a run is held against: observed numbers with their errors and weights."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...frame import Floats, Frame
from ...observables import How, find
from ...published.cases import CASES, CLASS_BORDERS, END
from ...times import nearest
from .schema import ABOVE, BELOW, EQUAL

RANGE = 1e3
"""Ratios further from 1 than this count as this much."""

ERROR = {True: 0.10, False: 3.0}
"""Error of an observed number that does not tell its own: relative, or in percentage points. Published numbers come
from one run of a program with details of its own; where fragments are placed alone is worth 10 % in N."""


KEPT = (
    "clusters",
    "mean_diameter",
    "sauter_diameter",
    "mass_mean_diameter",
    "smallest_diameter",
    "largest_diameter",
    "size_classes",
    "strip_diameter",
)
"""Observables that are kept of every run, beside those that targets name."""

Numbers = dict[str, list[list[float]]]
"""What is kept of a run: ``times`` of its frames after the start, and every quantity, shape (frames, M)."""


def numbers_of(frames: Sequence[Frame], names: Sequence[str], how: How) -> Numbers:
    """Observables of a run's frames after the start."""
    later = frames[1:]
    numbers: Numbers = {"times": [[frame.time] for frame in later]}
    for name in names:
        numbers[name] = [find(name)(frame, how).tolist() for frame in later]
    return numbers


@dataclass(frozen=True)
class Target:
    """One observed number.

    Parameters
    ----------
    quantity : str
        Name in the registry :mod:`clusterdem.observables`.
    time : float
        When it was observed (s).
    part : int
        Which of the quantity's numbers, from 0.
    value : float
        The number; ``clusters`` are those of the case's whole mass of solids.
    kind : str
        ``value``, or ``below`` or ``above`` where only a bound is known.
    error : float
        Standard deviation: a share of 1, or percentage points.
    weight : float
        How many observations it counts for.
    part_name : str
        Name of that number, where the quantity has several.
    """

    quantity: str
    time: float
    part: int
    value: float
    kind: str = EQUAL
    error: float = 0.1
    weight: float = 1.0
    part_name: str = ""

    @property
    def label(self) -> str:
        """Its name in tables."""
        part = f" {self.part_name}" if self.part_name else ""
        return f"{find(self.quantity).label}{part}({self.time:g})"

    def deviation(self, number: float) -> float:
        """How far a run's number is from it: the logarithm of the ratio, or the difference; 0 within a bound."""
        if find(self.quantity).relative:
            apart = math.log(min(max(number / self.value, 1 / RANGE), RANGE))
        else:
            apart = number - self.value
        if self.kind == BELOW:
            return max(apart, 0.0)
        return min(apart, 0.0) if self.kind == ABOVE else apart


def without_frame(targets: Sequence[Target], numbers: Numbers) -> list[Target]:
    """Targets of whose time a run has no frame (:mod:`clusterdem.times`)."""
    times = np.array(numbers["times"])[:, 0]
    return [target for target in targets if nearest(times, target.time) is None]


def read_off(targets: Sequence[Target], numbers: Numbers, solids: float | None) -> Floats:
    """A run's number for every target; NaN where there is no frame at that time, or nothing to measure in it.

    Parameters
    ----------
    targets : sequence of Target
        What was observed.
    numbers : Numbers
        What is kept of the run.
    solids : float or None
        Mass of solids (kg) to which observed clusters belong.
    """
    times = np.array(numbers["times"])[:, 0]
    found = np.full(len(targets), np.nan)
    for index, target in enumerate(targets):
        frame = nearest(times, target.time)
        if frame is not None:
            factor = (solids or 1.0) if target.quantity == "clusters" else 1.0
            found[index] = factor * numbers[target.quantity][frame][target.part]
    return found


def deviations(targets: Sequence[Target], numbers: Floats) -> Floats:
    """Deviation of every number from its target, shape (M,)."""
    return np.array([target.deviation(number) for target, number in zip(targets, numbers)])


def evenly(targets: Sequence[Target]) -> list[Target]:
    """Each quantity counts alike, however many numbers it has."""
    count = Counter(target.quantity for target in targets)
    return [replace(target, weight=target.weight / count[target.quantity]) for target in targets]


def published_targets(case: str) -> list[Target]:
    """What the paper prints of a case; for case 3 also what it says in words of centre and walls."""
    paper = CASES[case].rows[0]
    targets = [Target("clusters", time, 0, span[0]) for time, span in paper.count.items()]
    if paper.mean:
        targets.append(Target("mean_diameter", END, 0, paper.mean[0]))
    how = How(borders=CLASS_BORDERS)
    classes, strips = (find(name).parts(how) for name in ("size_classes", "strip_diameter"))
    for part, span in enumerate(paper.classes):
        targets.append(Target("size_classes", END, part, span[0], part_name=classes[part]))
    for part, (kind, limit) in CASES[case].bounds.items():
        targets.append(Target("strip_diameter", END, part, limit, kind, part_name=strips[part]))
    return evenly([replace(t, error=ERROR[find(t.quantity).relative]) for t in targets])
