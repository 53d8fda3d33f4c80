"""The report of a calibration: the fit, its uncertainty, what the data tell, the targets, the trials."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ...frame import Floats
from ...io.output import write_csv, write_text
from ...observables import find
from .fit import Fit
from .identify import PRIOR, combination, in_words
from .model import EngineModel
from .parameters import Choice, Real, fill, text_of
from .schema import BELOW, EQUAL
from .targets import Target

MOST_FAILURES = 5
"""Failed runs that are quoted."""


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _table(heading: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    return [_row(heading), _row(["---"] * len(heading)), *(_row(row) for row in rows), ""]


def _shown(target: Target, value: float) -> str:
    if np.isnan(value):
        return "none"
    if find(target.quantity).unit == "m":
        return f"{1e6 * value:.0f} µm"
    unit = find(target.quantity).unit
    return f"{value:,.0f}" if target.quantity == "clusters" else f"{value:.3g}{' ' + unit if unit else ''}"


def _observed(target: Target) -> str:
    text = _shown(target, target.value)
    return text if target.kind == EQUAL else f"{'<' if target.kind == BELOW else '>'} {text}"


def _with_spread(target: Target, samples: Floats) -> str:
    mean = _shown(target, float(samples.mean()))
    if np.isnan(samples).any() or len(samples) < 2:
        return mean
    spread = float(samples.std(ddof=1))
    if target.quantity == "clusters":
        return f"{mean} ± {spread:,.0f}"
    return f"{mean} ± {1e6 * spread if find(target.quantity).unit == 'm' else spread:.2g}"


def _fit_rows(fit: Fit) -> list[list[str]]:
    rows, found = [], fit.identified
    for parameter in fit.study.parameters:
        value = fit.best.point[parameter.name]
        if isinstance(parameter, Choice):
            rows.append([parameter.name, str(value), "", "", "", ", ".join(parameter.options)])
            continue
        row = [parameter.name, text_of(value), "", "", ""]
        if found is not None:
            index = found.names.index(parameter.name)
            here = parameter.unit(float(value))
            row[2] = _interval(parameter, here, float(found.deviation[index]))
            row[3] = _interval(parameter, here, float(found.scatter[index]))
            row[4] = f"{100 * found.deviation[index] / PRIOR:.0f} %"
        rows.append([*row, f"{text_of(parameter.low)} to {text_of(parameter.high)}{', log' if parameter.log else ''}"])
    return rows


def _interval(parameter: Real, here: float, width: float) -> str:
    return " to ".join(text_of(float(f"{parameter.value(here + side * width):.3g}")) for side in (-1, 1))


def _choices(fit: Fit) -> list[str]:
    rows = []
    for parameter in fit.study.parameters:
        if not isinstance(parameter, Choice):
            continue
        for option in parameter.options:
            trials = [t for t in fit.trials if t.point[parameter.name] == option]
            whole = [trial.loss for trial in trials if trial.whole]
            least = f"{min(whole):.3f}" if whole else f"none with all seeds, of {len(trials)}"
            flip = "the fit" if fit.best.point[parameter.name] == option else ""
            for one in fit.near.flips if fit.near else ():
                if (one.parameter, one.option) == (parameter.name, option):
                    flip = f"{one.change:+.3f} ± {one.error:.3f}"
                    flip += "" if abs(one.change) > 2 * one.error else " (cannot be told)"
            rows.append([parameter.name, option, str(len(trials)), least, flip if fit.near else ""])
    if not rows:
        return []
    said = (
        "Choices: the least loss among the trials with each option, and what changing it alone does to the loss at the "
        "best trial of the search (± standard error over seeds)."
    )
    return [said, "", *_table(["choice", "option", "trials", "least loss", "changed alone"], rows)]


def _targets(fit: Fit) -> list[str]:
    columns = [("the fit, in the search", fit.best.stacked, fit.scale)]
    for c in fit.confirmed:
        name = f"start {c.name}" if c.name in fit.study.starts else c.name
        columns.append((f"{name}, confirmed", c.samples, fit.final or fit.scale))
    rows, begin = [], 0
    for case in fit.study.cases:
        part = slice(begin, begin + len(case.targets))
        for index, target in enumerate(case.targets, begin):
            row = [case.name, target.label, _observed(target)]
            rows.append(row + [_with_spread(target, samples[:, index]) for _, samples, _ in columns])
        losses = [f"{scale.loss_part(samples, part):.3f}" for _, samples, scale in columns]
        rows.append([case.name, "*loss*", "", *losses])
        begin = part.stop
    losses = [f"{fit.best.loss:.3f}", *(f"{c.loss:.3f} ± {c.error:.3f}" for c in fit.confirmed)]
    rows.append(["all", "*loss*", "", *losses])
    return _table(["case", "target", "observed", *(name for name, _, _ in columns)], rows)


def _told(fit: Fit) -> list[str]:
    found = fit.identified
    if found is None or not found.names:
        return []
    lines = ["## What the data tell of the parameters", "", *(f"- {sentence}" for sentence in in_words(found)), ""]
    rows = [
        [f"{d.singular:.3g}", f"{d.noise:.2g}", combination(d, found.names), "yes" if d.known else "no"]
        for d in found.directions
    ]
    lines += _table(["singular value", "noise", "combination (ranges)", "told"], rows)
    lines.append(
        f"Mean square residual per degree of freedom, by which deviations are widened: {found.misfit:.2f}. A singular "
        "value counts residuals, in units of their errors, per range of the combination; *noise* is what the seeds' scatter "
        "alone would make of it, and has been taken off."
    )
    return [*lines, ""]


def _commands(fit: Fit) -> list[str]:
    stage = fit.study.confirm or fit.study.search
    lines = ["To run the fit:", "", "```"]
    for case in fit.study.cases:
        words = [
            word for pair in fill(case.variables | stage.variables, fit.best.point).items() for word in ("-var", *pair)
        ]
        lines.append(f"lmp -in {case.input.name} {shlex.join(words)}")
    return [*lines, "```", ""]


def _failures(model: EngineModel) -> list[str]:
    """Runs that failed: each a trial as bad as can be."""
    if not model.failures:
        return []
    lines = ["", "## Runs that failed", "", "Each counts as far off as can be.", ""]
    for failure in list(model.failures.values())[:MOST_FAILURES]:
        lines += ["```", failure.text, "```", ""]
    more = len(model.failures) - MOST_FAILURES
    return [*lines, f"… and {more} more."] if more > 0 else lines


def as_markdown(fit: Fit, model: EngineModel) -> str:
    """The report."""
    study = fit.study
    promoted = sum(trial.whole for trial in fit.trials)
    lines = [
        f"# {study.path.stem}: calibration",
        "",
        f"{model.engine.version}; {', '.join(case.input.name for case in study.cases)}; {len(fit.trials)} trials, "
        f"{promoted} of them with all {len(study.search.seeds)} seeds; {len(model.used)} runs. Loss: weighted mean over "
        "the targets of soft_l1 of the deviation in units of its error (of the observation and of one seed).",
        "",
        "## The fit",
        "",
        f"Number {fit.best.number} ({fit.best.name}), loss {fit.best.loss:.3f} in the search.",
        "",
        *_table(
            ["parameter", "fit", "deviation by misfit", "error by seeds", "of its range stays open", "looked in"],
            _fit_rows(fit),
        ),
        "Both intervals are one standard deviation to either side, within the range: *by misfit* from the curvature about "
        "the best trial and what no point explains, *by seeds* how far other seeds would move the fit.",
        "",
        *_choices(fit),
        *_commands(fit),
        *_told(fit),
        "## Targets",
        "",
        *_targets(fit),
        "± is the standard deviation between seeds.",
        *_failures(model),
    ]
    return "\n".join(lines).rstrip() + "\n"


def write_report(path: Path, fit: Fit, model: EngineModel) -> Path:
    """The report as Markdown."""
    return write_text(path, as_markdown(fit, model))


def write_trials(path: Path, fit: Fit) -> Path:
    """The trials as CSV: values, loss, numbers as means over seeds."""
    names = [parameter.name for parameter in fit.study.parameters]
    labels = [f"{case.name} {target.label}" for case in fit.study.cases for target in case.targets]
    rows = []
    for trial in fit.trials:
        numbers = trial.stacked.mean(axis=0)
        rows.append(
            [trial.number, trial.name, trial.loss, len(trial.samples), *(trial.point[n] for n in names), *numbers]
        )
    return write_csv(path, ["number", "name", "loss", "seeds", *names, *labels], rows)
