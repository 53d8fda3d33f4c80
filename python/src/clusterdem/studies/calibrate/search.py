"""The global search: CMA-ES for numbers and choices together (CatCMA) proposes, runs answer.

A run costs seconds to minutes and answers with noise, losses differ by orders of magnitude, parameters are numbers and
choices together. CMA-ES compares ranks only, so it minds neither; it learns along which combinations of numbers the loss
does not change, which is what a size law's constant and a drag law make; CatCMA adds a probability to every option of
every choice, learned from the same ranks. It begins around the best of the known points. bench/optimizers.py shows it
against Optuna's Parzen estimator, differential evolution and chance.

A generation is asked at once and told in order, so that the same file and the same answers give the same trials: an
interrupted search repeats its questions, finds the answers among the finished runs and goes on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from cmaes import CatCMA

from ...frame import Floats
from .model import Model
from .parameters import Parameter, Point, Real, choices, reals, units
from .score import Yardstick
from .study import Search

SEED = 1
"""Of the sampler."""

STEP = 0.1
"""Standard deviation of the first generation, as a share of the ranges."""

KNOWN = 0.8
"""Probability in the first generation of the options that the best start has."""

LEAST_NUMBERS, LEAST_CHOICES = 2, 1
"""Fewest that CatCMA takes; a study with fewer gets some that do nothing."""


@dataclass
class Trial:
    """A point that was tried.

    Parameters
    ----------
    number : int
        In order, from 0.
    point : Point
        The values.
    name : str
        The start's name, or how it came about.
    samples : dict of int to ndarray
        Numbers by seed.
    loss : float
        At the mean over those seeds.
    whole : bool
        Whether all seeds have been run.
    """

    number: int
    point: Point
    name: str
    samples: dict[int, Floats] = field(default_factory=dict)
    loss: float = float("inf")
    whole: bool = False

    @property
    def stacked(self) -> Floats:
        """Numbers, shape (seeds, M)."""
        return np.stack(list(self.samples.values()))


def best_of(trials: Sequence[Trial]) -> Trial:
    """The trial with the least loss of those with all seeds."""
    return min((trial for trial in trials if trial.whole), key=lambda trial: trial.loss)


def try_points(model: Model, stage: Search, points: Sequence[tuple[str, Point]], first: int) -> list[Trial]:
    """Points with all seeds, not scored yet."""
    trials = [Trial(first + number, point, name) for number, (name, point) in enumerate(points)]
    _add(model, stage, trials, stage.seeds)
    return trials


def _add(model: Model, stage: Search, trials: Sequence[Trial], seeds: Sequence[int]) -> None:
    wanted = [(trial, seed) for trial in trials for seed in seeds]
    answers = model.observe([(trial.point, seed) for trial, seed in wanted], stage)
    for (trial, seed), numbers in zip(wanted, answers):
        trial.samples[seed] = numbers
    for trial in trials:
        trial.whole = all(seed in trial.samples for seed in stage.seeds)


def search(
    model: Model,
    parameters: Sequence[Parameter],
    stage: Search,
    yardstick: Yardstick,
    starts: Sequence[Trial],
    told: Callable[[Sequence[Trial]], None] = lambda trials: None,
) -> list[Trial]:
    """Trials in order, the starts first.

    Parameters
    ----------
    model : Model
        What answers.
    parameters : sequence of Parameter
        What is fitted.
    stage : Search
        How many trials.
    yardstick : Yardstick
        What answers are held against.
    starts : sequence of Trial
        Points already tried with all seeds.
    told : callable
        Called with all trials so far after each generation.
    """
    trials = list(starts)
    for trial in trials:
        trial.loss = yardstick.loss(trial.stacked)
    told(trials)
    sampler = _sampler(parameters, best_of(trials).point, stage.population)
    while len(trials) < stage.trials:
        drawn = [sampler.ask() for _ in range(sampler.population_size)]
        batch = [
            Trial(len(trials) + index, _point(parameters, *one), f"trial {len(trials) + index}")
            for index, one in enumerate(drawn[: stage.trials - len(trials)])
        ]
        _add(model, stage, batch, stage.seeds[:1])
        for trial in batch:
            trial.loss = yardstick.loss(trial.stacked)
        bar = float(np.quantile([trial.loss for trial in trials + batch], stage.promote))
        promising = [trial for trial in batch if trial.loss <= bar]
        _add(model, stage, promising, stage.seeds[1:])
        for trial in batch:
            trial.loss = yardstick.loss(trial.stacked)
        trials += batch
        told(trials)
        if len(batch) == len(drawn):  # else the trials are spent
            sampler.tell([(one, trial.loss) for one, trial in zip(drawn, batch)])
    return trials


def _sampler(parameters: Sequence[Parameter], point: Point, population: int | None) -> CatCMA:
    numbers = np.full(max(LEAST_NUMBERS, len(reals(parameters))), 0.5)
    numbers[: len(reals(parameters))] = units(parameters, point)
    sizes = [len(one.options) for one in choices(parameters)] or [2] * LEAST_CHOICES
    chosen = [one.options.index(str(point[one.name])) for one in choices(parameters)] or [0] * LEAST_CHOICES
    likely = np.zeros((len(sizes), max(sizes)))
    for row, size, option in zip(likely, sizes, chosen):
        row[:size] = (1 - KNOWN) / (size - 1)
        row[option] = KNOWN
    return CatCMA(
        mean=numbers,
        sigma=STEP,
        bounds=np.array([[0.0, 1.0]] * len(numbers)),
        cat_num=np.array(sizes),
        cat_param=likely,
        seed=SEED,
        population_size=population,
    )


def _point(parameters: Sequence[Parameter], numbers: Floats, chosen: Floats) -> Point:
    place = dict(zip((real.name for real in reals(parameters)), numbers))
    option = dict(zip((one.name for one in choices(parameters)), chosen.argmax(axis=1)))
    return {
        p.name: p.value(float(place[p.name])) if isinstance(p, Real) else p.options[int(option.get(p.name, 0))]
        for p in parameters
    }
