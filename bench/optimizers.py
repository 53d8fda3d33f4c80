"""Which optimizer suits a calibration: python bench/optimizers.py [--trials 60] [--repeats 20]

A made-up loss of the kind that calibrations have, with known optimum: seven numbers in curved valleys (two enter as a
product), six choices of which some interact with numbers, differences over three orders of magnitude, noise of 15 %.
Every optimizer gets the same number of trials and the same start, some way off the optimum; compared is the loss
without noise at the point that each would name, the one with the least loss seen: median and quartiles over repeats.
Optuna is shown where it is installed (pip install optuna).
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable

import numpy as np
from clusterdem.studies.calibrate.search import KNOWN, STEP
from cmaes import CatCMA
from scipy.optimize import differential_evolution

NUMBERS, OPTIONS = 7, (2, 2, 2, 2, 2, 3)
NOISE = 0.15
BEST = np.array([0.35, 0.5, 0.6, 0.45, 0.3, 0.1, 0.55])
COSTS = (0.3, 3.0, 0.5, 1.0, 0.2, 0.1)

Evaluate = Callable[[np.ndarray, tuple[int, ...]], float]


def true_loss(x: np.ndarray, c: tuple[int, ...]) -> float:
    """0 at BEST with all choices 0; choice 1 moves where the first number is best."""
    apart = x - BEST
    apart[0] -= 0.15 * c[1]
    product = apart[0] + 0.5 * apart[1]  # both enter as one: a valley
    parts = [60 * product**2, 2 * apart[1] ** 2, 8 * (apart[2] - apart[0]) ** 2, *(3 * apart[3:] ** 2)]
    chosen = sum(cost for cost, option in zip(COSTS, c) if option)
    smooth = float(np.sum(parts)) + chosen
    return smooth + 20 * max(0.0, -product - 0.1)  # and a cliff on one side, where runs overrun


class Budget(Exception):
    """All trials are spent."""


class Trials:
    """Noisy answers, counted."""

    def __init__(self, count: int, seed: int) -> None:
        self.left, self.rng = count, np.random.default_rng(seed)
        self.least, self.named = float("inf"), float("inf")

    def __call__(self, x: np.ndarray, c: tuple[int, ...]) -> float:
        if not self.left:
            raise Budget
        self.left -= 1
        loss = true_loss(np.array(x, dtype=float), c)
        seen = loss * np.exp(NOISE * self.rng.standard_normal()) + 0.02 * self.rng.random()
        if seen < self.least:
            self.least, self.named = seen, loss
        return float(seen)


def start_of(seed: int) -> tuple[np.ndarray, tuple[int, ...]]:
    """A known point: numbers off by a fifth of their range, choices by chance."""
    rng = np.random.default_rng(1000 + seed)
    numbers = np.clip(BEST + 0.2 * rng.standard_normal(NUMBERS), 0, 1)
    return numbers, tuple(int(rng.integers(n)) for n in OPTIONS)


def random(evaluate: Evaluate, seed: int) -> None:
    """Points by chance"""
    evaluate(*start_of(seed))
    rng = np.random.default_rng(seed)
    while True:
        evaluate(rng.random(NUMBERS), tuple(int(rng.integers(n)) for n in OPTIONS))


def parzen(evaluate: Evaluate, seed: int) -> None:
    """Optuna's tree-structured Parzen estimator, multivariate"""
    import optuna

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    space = {f"x{i}": optuna.distributions.FloatDistribution(0, 1) for i in range(NUMBERS)}
    space |= {f"c{i}": optuna.distributions.CategoricalDistribution(range(n)) for i, n in enumerate(OPTIONS)}
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=seed, multivariate=True, n_startup_trials=10))
    numbers, chosen = start_of(seed)
    study.enqueue_trial({f"x{i}": x for i, x in enumerate(numbers)} | {f"c{i}": c for i, c in enumerate(chosen)})
    while True:
        trial = study.ask(space)
        x = np.array([trial.params[f"x{i}"] for i in range(NUMBERS)])
        study.tell(trial, evaluate(x, tuple(trial.params[f"c{i}"] for i in range(len(OPTIONS)))))


def evolution(evaluate: Evaluate, seed: int) -> None:
    """SciPy's differential evolution, small population, choices as rounded numbers"""

    def rounded(v: np.ndarray) -> float:
        choices = (min(int(u * n), n - 1) for u, n in zip(v[NUMBERS:], OPTIONS))
        return evaluate(v[:NUMBERS], tuple(choices))

    numbers, chosen = start_of(seed)
    first = np.concatenate([numbers, [(c + 0.5) / n for c, n in zip(chosen, OPTIONS)]])
    bounds = [(0, 1)] * len(first)
    differential_evolution(rounded, bounds, x0=first, popsize=1, maxiter=10**6, polish=False, tol=0, rng=seed)


def cma(evaluate: Evaluate, seed: int) -> None:
    """CMA-ES for numbers and choices (CatCMA), as `clusterdem calibrate` sets it"""
    numbers, chosen = start_of(seed)
    evaluate(numbers, chosen)
    likely = np.zeros((len(OPTIONS), max(OPTIONS)))
    for row, size, option in zip(likely, OPTIONS, chosen):
        row[:size] = (1 - KNOWN) / (size - 1)
        row[option] = KNOWN
    bounds = np.array([[0.0, 1.0]] * NUMBERS)
    optimizer = CatCMA(mean=numbers, sigma=STEP, bounds=bounds, cat_num=np.array(OPTIONS), cat_param=likely, seed=seed)
    while True:
        asked = [optimizer.ask() for _ in range(optimizer.population_size)]
        optimizer.tell([((x, c), evaluate(x, tuple(int(row.argmax()) for row in c))) for x, c in asked])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=60)
    parser.add_argument("--repeats", type=int, default=20)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    print("| optimizer | loss at the point it names: median | quartiles | s per trial |\n| --- | --- | --- | --- |")
    for method in (random, evolution, parzen, cma):
        losses, start = [], time.process_time()
        for seed in range(options.repeats):
            trials = Trials(options.trials, seed)
            try:
                method(trials, seed)
            except Budget:
                losses.append(trials.named)
            except ModuleNotFoundError:
                break
        if losses:
            low, middle, high = np.quantile(losses, [0.25, 0.5, 0.75])
            each = (time.process_time() - start) / options.repeats / options.trials
            print(f"| {method.__doc__} | {middle:.2f} | {low:.2f} to {high:.2f} | {each:.4f} |")


if __name__ == "__main__":
    main()
