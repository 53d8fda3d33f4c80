"""The global search: Optuna's tree-structured Parzen estimator proposes, runs answer.

Why this one: a run costs seconds to minutes and tells its answer with noise, and parameters are numbers and choices
together. CMA-ES and differential evolution need hundreds of runs for ten parameters and know no choices, a Gaussian
process knows neither choices nor many dimensions well. The estimator ranks trials, so it minds neither noise nor
losses that differ by orders of magnitude, and it takes known points as a start.

It is asked in batches and told in order, so that the same file and the same answers give the same trials: an interrupted
search repeats its questions, finds the answers among the finished runs and goes on.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .model import Model
from .parameters import Choice, Parameter, Point, Real, units
from .score import Yardstick
from .study import Search

if TYPE_CHECKING:
    from optuna.distributions import BaseDistribution

SEED = 1
"""Of the sampler."""

EXPLORE = 10
"""Trials drawn at random before the estimator has something to go by; the starts count."""


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
    told: Callable[[Trial], None] = lambda trial: None,
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
        Called with every finished trial.
    """
    try:
        import optuna
    except ModuleNotFoundError as error:
        raise InputError("calibrate", "needs Optuna: pip install 'clusterdem[calibrate]'") from error
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    space = {p.name: _distribution(p) for p in parameters}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # options of the sampler that may change in a later version; it is pinned
        sampler = optuna.samplers.TPESampler(seed=SEED, multivariate=True, n_startup_trials=EXPLORE, constant_liar=True)
        asked = optuna.create_study(sampler=sampler)
        trials = list(starts)
        for trial in trials:
            trial.loss = yardstick.loss(trial.stacked)
            at = _asked_at(parameters, trial.point)
            asked.add_trial(optuna.trial.create_trial(params=at, distributions=space, value=trial.loss))
            told(trial)
        while len(trials) < stage.trials:
            drawn = [asked.ask(space) for _ in range(min(stage.batch, stage.trials - len(trials)))]
            batch = [
                Trial(len(trials) + index, _point(parameters, one.params), f"trial {len(trials) + index}")
                for index, one in enumerate(drawn)
            ]
            _add(model, stage, batch, stage.seeds[:1])
            bar = float(np.quantile([trial.loss for trial in trials], stage.promote)) if trials else float("inf")
            promising = [trial for trial in batch if yardstick.loss(trial.stacked) <= bar]
            _add(model, stage, promising, stage.seeds[1:])
            for trial, one in zip(batch, drawn):
                trial.loss = yardstick.loss(trial.stacked)
                asked.tell(one, trial.loss)
                told(trial)
            trials += batch
    return trials


def _distribution(parameter: Parameter) -> BaseDistribution:
    from optuna.distributions import CategoricalDistribution, FloatDistribution

    if isinstance(parameter, Choice):
        return CategoricalDistribution(parameter.options)
    return FloatDistribution(0.0, 1.0)


def _point(parameters: Sequence[Parameter], drawn: dict[str, float | str]) -> Point:
    return {p.name: p.value(float(drawn[p.name])) if isinstance(p, Real) else drawn[p.name] for p in parameters}


def _asked_at(parameters: Sequence[Parameter], point: Point) -> dict[str, float | str]:
    places = iter(units(parameters, point))
    return {p.name: float(next(places)) if isinstance(p, Real) else point[p.name] for p in parameters}
