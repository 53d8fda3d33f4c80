"""The neighbourhood of a point: sensitivities by central differences with common seeds, and the step that they suggest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...frame import Floats
from .model import Model
from .parameters import Parameter, Point, choices, moved, units
from .score import Yardstick
from .search import Trial
from .study import Local

PRECISION = 12.0
"""Of what is known of a parameter without any data: that it lies in its range, evenly (variance 1/12)."""

TRUST = 0.25
"""Longest Gauss-Newton step along a parameter, as a share of its range."""


@dataclass(frozen=True)
class Flip:
    """Another option of a choice at the best point, all else unchanged.

    Parameters
    ----------
    parameter, option : str
        The choice and its other option.
    change : float
        What the loss gains or, below 0, falls by; mean over seeds.
    error : float
        Its standard error from the seeds' scatter.
    """

    parameter: str
    option: str
    change: float
    error: float


@dataclass(frozen=True)
class Neighbourhood:
    """What runs around a point say.

    Parameters
    ----------
    point : Point
        The point.
    residuals : ndarray, shape (seeds, M)
        At the point, in units of the errors.
    jacobian : ndarray, shape (seeds, M, P)
        Derivatives of the residuals by the places of the numbers in their ranges.
    flips : tuple of Flip
        Other options of the choices.
    """

    point: Point
    residuals: Floats
    jacobian: Floats
    flips: tuple[Flip, ...]


def explore(
    model: Model, parameters: Sequence[Parameter], stage: Local, yardstick: Yardstick, point: Point
) -> Neighbourhood:
    """Run the neighbours of a point: two per number, one per further option; every one with the same seeds."""
    here = units(parameters, point)
    pairs: list[tuple[Point, Point]] = []
    for index in range(len(here)):
        either = []
        for side in (-stage.step, stage.step):
            unit = here.copy()
            unit[index] = min(max(unit[index] + side, 0.0), 1.0)
            either.append(moved(parameters, point, unit))
        pairs.append((either[0], either[1]))
    asked_choices = choices(parameters) if stage.choices else []
    others = [(one, option) for one in asked_choices for option in one.options if option != point[one.name]]
    asked = [point, *(p for pair in pairs for p in pair), *(point | {one.name: option} for one, option in others)]
    answers = model.observe([(p, seed) for p in asked for seed in stage.seeds], stage)
    residuals = np.array([yardstick.residuals(numbers) for numbers in answers])
    residuals = residuals.reshape(len(asked), len(stage.seeds), -1)
    centre = residuals[0]
    jacobian = np.zeros((*centre.shape, len(here)))
    for index, (lower, upper) in enumerate(pairs):
        width = units(parameters, upper)[index] - units(parameters, lower)[index]
        jacobian[:, :, index] = (residuals[2 + 2 * index] - residuals[1 + 2 * index]) / width
    flips = []
    losses = np.array([yardstick.loss_of(r) for r in centre])
    for (one, option), after in zip(others, residuals[1 + 2 * len(pairs) :]):
        change = np.array([yardstick.loss_of(r) for r in after]) - losses
        flips.append(Flip(one.name, option, float(change.mean()), standard_error(change)))
    return Neighbourhood(point, centre, jacobian, tuple(flips))


def standard_error(samples: Floats) -> float:
    """Of the mean over the first axis."""
    return float(np.std(samples, ddof=1) / np.sqrt(len(samples)))


def weighted(near: Neighbourhood, yardstick: Yardstick, seeds: Sequence[int] | None = None) -> tuple[Floats, Floats]:
    """Jacobian and residuals whose sum of squares falls as the loss does; means over seeds (all by default)."""
    chosen = list(range(len(near.residuals))) if seeds is None else list(seeds)
    residuals = near.residuals[chosen].mean(axis=0)
    root = np.sqrt(yardstick.pull(near.residuals.mean(axis=0)))
    return root[:, None] * near.jacobian[chosen].mean(axis=0), root * residuals


def newton(near: Neighbourhood, yardstick: Yardstick, parameters: Sequence[Parameter], scale: float) -> Point:
    """The Gauss-Newton point, a share ``scale`` of the way; short in directions of which the data say little."""
    jacobian, residuals = weighted(near, yardstick)
    freedom = max(1, len(residuals) - jacobian.shape[1])
    noise = max(1.0, float(residuals @ residuals) / freedom)
    information = jacobian.T @ jacobian / noise + PRECISION * np.eye(jacobian.shape[1])
    step = -np.linalg.solve(information, jacobian.T @ residuals / noise)
    longest = float(np.abs(step).max(initial=0.0))
    step *= scale * min(1.0, TRUST / longest) if longest > 0 else 0.0
    return moved(parameters, near.point, units(parameters, near.point) + step)


def polish(
    model: Model,
    parameters: Sequence[Parameter],
    stage: Local,
    yardstick: Yardstick,
    near: Neighbourhood,
    number: int,
) -> list[Trial]:
    """Gauss-Newton steps of full, half and quarter length as trials, to be compared at the seeds of the stage."""
    points = [newton(near, yardstick, parameters, scale) for scale in (1.0, 0.5, 0.25)]
    answers = model.observe([(point, seed) for point in points for seed in stage.seeds], stage)
    trials = []
    for index, point in enumerate(points):
        samples = answers[index * len(stage.seeds) : (index + 1) * len(stage.seeds)]
        trial = Trial(number + index, point, "Gauss-Newton", dict(zip(stage.seeds, samples)), whole=True)
        trial.loss = yardstick.loss(trial.stacked)
        trials.append(trial)
    return trials
