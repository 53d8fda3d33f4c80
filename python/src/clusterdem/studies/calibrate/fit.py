"""A calibration carried out: starts, search, neighbourhood of the best point, confirmation."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ...errors import InputError
from ...frame import Floats
from .identify import Identified, identify
from .local import Neighbourhood, explore, polish
from .model import Model
from .parameters import Choice, Parameter, Point
from .score import Yardstick, all_targets, spread_of, yardstick
from .search import Trial, best_of, search, try_points
from .study import Calibration


@dataclass(frozen=True)
class Confirmed:
    """A point run again in the last stage.

    Parameters
    ----------
    name : str
        What it is.
    point : Point
        The values.
    samples : ndarray, shape (seeds, M)
        Numbers.
    loss, error : float
        At the mean over seeds, and the standard error by leaving out one seed at a time.
    """

    name: str
    point: Point
    samples: Floats
    loss: float
    error: float


@dataclass
class Fit:
    """What came out.

    Parameters
    ----------
    study : Calibration
        What was asked.
    spread : ndarray, shape (M,)
        Standard deviation of deviations between seeds, in the search.
    scale : Yardstick
        What trials were held against.
    trials : list of Trial
        All, the starts first.
    best : Trial
        The best.
    near : Neighbourhood or None
        Around the best trial of the search.
    identified : Identified or None
        What the data tell.
    confirmed : list of Confirmed
        Points run again; the spread of their seeds is ``final_spread``, their yardstick ``final``.
    """

    study: Calibration
    spread: Floats
    scale: Yardstick
    trials: list[Trial]
    best: Trial
    near: Neighbourhood | None = None
    identified: Identified | None = None
    confirmed: list[Confirmed] = field(default_factory=list)
    final: Yardstick | None = None


def middle(parameters: tuple[Parameter, ...]) -> Point:
    """The middle of every range and the first option of every choice."""
    return {p.name: p.options[0] if isinstance(p, Choice) else p.value(0.5) for p in parameters}


def jackknife(scale: Yardstick, samples: Floats) -> float:
    """Standard error of the loss, by leaving out one seed at a time."""
    count = len(samples)
    left = np.array([scale.loss(np.delete(samples, seed, axis=0)) for seed in range(count)])
    return float(np.sqrt((count - 1) / count * ((left - left.mean()) ** 2).sum()))


def carry_out(study: Calibration, model: Model) -> Fit:
    """Do all stages; what has been run before is not run again."""
    begun = time.monotonic()

    def told(trials: Sequence[Trial]) -> None:
        """A line per generation, also where nobody looks on: a study runs for a night."""
        done, took = len(trials), time.monotonic() - begun
        left = took / done * max(0, study.search.trials - done)
        best = best_of(trials).loss
        text = f"{done} of {study.search.trials} trials, best loss {best:.4g}, {_duration(took)} gone, {_duration(left)} left"
        print(text, file=sys.stderr, flush=True)

    named = list(study.starts.items()) or [("middle", middle(study.parameters))]
    starts = try_points(model, study.search, named, 0)
    if all(np.isnan(start.stacked).all() for start in starts) and model.blamed():
        raise InputError(study.path, f"no start gives a number: {model.blamed()}")
    spread = spread_of(all_targets(study), [start.stacked for start in starts])
    scale = yardstick(study, spread)
    trials = search(model, study.parameters, study.search, scale, starts, told)
    fit = Fit(study, spread, scale, trials, best_of(trials))
    _look_around(fit, model)
    _confirm(fit, model)
    return fit


def _duration(seconds: float) -> str:
    """A time as people say it."""
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def _look_around(fit: Fit, model: Model) -> None:
    stage, parameters = fit.study.local, fit.study.parameters
    if stage is None:
        return
    near = explore(model, parameters, stage, fit.scale, fit.best.point)
    here = fit.scale.loss_of(near.residuals.mean(axis=0))
    for number in range(1, stage.polish + 1):
        steps = polish(model, parameters, stage, fit.scale, near, len(fit.trials))
        fit.trials += steps
        better = min(steps, key=lambda trial: trial.loss)
        if better.loss >= here:
            break
        fit.best, here = better, better.loss
        if number < stage.polish:  # the next step starts from there
            near = explore(model, parameters, stage, fit.scale, fit.best.point)
    fit.near = near
    fit.identified = identify(fit.near, fit.scale, parameters)


def _confirm(fit: Fit, model: Model) -> None:
    stage, study = fit.study.confirm, fit.study
    if stage is None:
        return
    candidates = [("the fit", fit.best.point)]
    ranked = sorted((t for t in fit.trials if t.whole and t.name not in stage.starts), key=lambda trial: trial.loss)
    for trial in ranked:
        if len(candidates) < stage.best and trial.point not in [point for _, point in candidates]:
            candidates.append((f"number {trial.number}", trial.point))
    candidates += [(name, study.starts[name]) for name in stage.starts]
    answers = model.observe([(point, seed) for _, point in candidates for seed in stage.seeds], stage)
    stacks = np.array(answers).reshape(len(candidates), len(stage.seeds), -1)
    fit.final = yardstick(study, spread_of(all_targets(study), list(stacks)))
    for (name, point), samples in zip(candidates, stacks):
        fit.confirmed.append(Confirmed(name, point, samples, fit.final.loss(samples), jackknife(fit.final, samples)))
