"""What a run is held against: observed numbers with their errors and weights."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...analysis.grid import RHO_P
from ...analysis.nonuniformity import strips
from ...analysis.sizes import CLASS_NAMES, class_shares
from ...frame import Floats, Frame
from ...io.start import D_P
from ...published.numbers import CASES, END

EQUAL, BELOW, ABOVE = "value", "below", "above"
STRIPS = 6
RANGE = 1e3
"""Ratios further from 1 than this count as this much."""

ERROR = {True: 0.10, False: 3.0}
"""Error of an observed number that does not tell its own: relative, or in percentage points. Published numbers come
from one run of a program with details of its own; where fragments are placed alone is worth 10 % in N."""


@dataclass(frozen=True)
class Quantity:
    """Something to be observed.

    Parameters
    ----------
    label : str
        Its name in tables.
    unit : str
        The unit of its observed numbers.
    parts : tuple of str
        Names of its numbers; empty where it is a single one.
    relative : bool
        Whether ratios count, or differences.
    measure : callable
        Its numbers in one frame, shape (M,).
    """

    label: str
    unit: str
    parts: tuple[str, ...]
    relative: bool
    measure: Callable[[Frame], Floats]


def _clusters(frame: Frame) -> Floats:
    return np.array([len(frame) / frame.mass.sum()])  # per kg of solids, so that parts of a domain compare


def _sauter(frame: Frame) -> Floats:
    return np.array([(frame.diameter**3).sum() / (frame.diameter**2).sum()])


QUANTITIES = {
    "clusters": Quantity("N", "", (), True, _clusters),
    "mean_diameter": Quantity("mean d", "m", (), True, lambda frame: np.array([frame.diameter.mean()])),
    "sauter_diameter": Quantity("Sauter d", "m", (), True, _sauter),
    "size_classes": Quantity("share", "%", CLASS_NAMES, False, lambda frame: np.array(class_shares(frame.diameter))),
    "strip_diameter": Quantity(
        "mean d in strip",
        "m",
        tuple(f"{strip}" for strip in range(1, STRIPS + 1)),
        True,
        lambda frame: np.nan_to_num(strips(frame, STRIPS).diameter),
    ),
}
"""By the name that a study file uses."""

Numbers = dict[str, list[list[float]]]
"""What is kept of a run: ``times`` of its frames after the start, and every quantity, shape (frames, M)."""


def numbers_of(frames: Sequence[Frame]) -> Numbers:
    """All quantities of a run's frames after the start."""
    later = frames[1:]
    numbers: Numbers = {"times": [[frame.time] for frame in later]}
    for name, quantity in QUANTITIES.items():
        numbers[name] = [[float(value) for value in quantity.measure(frame)] for frame in later]
    return numbers


@dataclass(frozen=True)
class Target:
    """One observed number.

    Parameters
    ----------
    quantity : str
        Key of :data:`QUANTITIES`.
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
    """

    quantity: str
    time: float
    part: int
    value: float
    kind: str = EQUAL
    error: float = 0.1
    weight: float = 1.0

    @property
    def label(self) -> str:
        """Its name in tables."""
        quantity = QUANTITIES[self.quantity]
        part = f" {quantity.parts[self.part]}" if quantity.parts else ""
        return f"{quantity.label}{part}({self.time:g})"

    def deviation(self, number: float) -> float:
        """How far a run's number is from it: the logarithm of the ratio, or the difference; 0 within a bound."""
        if QUANTITIES[self.quantity].relative:
            apart = math.log(min(max(number / self.value, 1 / RANGE), RANGE))
        else:
            apart = number - self.value
        if self.kind == BELOW:
            return max(apart, 0.0)
        return min(apart, 0.0) if self.kind == ABOVE else apart


def read_off(targets: Sequence[Target], numbers: Numbers, solids: float | None) -> Floats:
    """A run's number for every target; NaN where it has no frame at that time.

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
        frame = int(np.argmin(np.abs(times - target.time)))
        if math.isclose(times[frame], target.time, rel_tol=0.01):
            factor = (solids or 1.0) if target.quantity == "clusters" else 1.0
            found[index] = factor * numbers[target.quantity][frame][target.part]
    return found


def deviations(targets: Sequence[Target], numbers: Floats) -> Floats:
    """Deviation of every number from its target, shape (M,)."""
    return np.array([target.deviation(number) for target, number in zip(targets, numbers)])


def evenly(targets: Sequence[Target]) -> list[Target]:
    """Each quantity counts alike, however many numbers it has."""
    count = {name: sum(target.quantity == name for target in targets) for name in QUANTITIES}
    return [replace(target, weight=target.weight / count[target.quantity]) for target in targets]


def published_targets(case: str) -> list[Target]:
    """What the paper prints of a case; for case 3 also what it says in words of centre and walls."""
    paper = CASES[case].rows[0]
    targets = [Target("clusters", time, 0, span[0]) for time, span in paper.count.items()]
    if paper.mean:
        targets.append(Target("mean_diameter", END, 0, paper.mean[0]))
    targets += [Target("size_classes", END, part, span[0]) for part, span in enumerate(paper.classes)]
    for part, (kind, limit) in CASES[case].bounds.items():
        targets.append(Target("strip_diameter", END, part, limit, kind))
    return evenly([replace(t, error=ERROR[QUANTITIES[t.quantity].relative]) for t in targets])


def published_solids(case: str) -> float:
    """Mass of the primary particles of a published case (kg)."""
    return CASES[case].particles * math.pi / 6 * D_P**3 * RHO_P
