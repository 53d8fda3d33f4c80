"""The figure of a calibration: trials, targets, parameters, and what cannot be told apart."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...plot.style import COLOURS, WIDTH, new_figure, styled
from .fit import Fit
from .parameters import reals, text_of, units

FARTHEST = 12.0
"""Errors beyond which a target's deviation stands on the panel's edge."""


def draw_fit(fit: Fit) -> Figure:
    """Four panels: loss over trials; deviations of the targets; places of the parameters; correlation of their errors."""
    targets = len(fit.scale.targets)
    with styled():
        figure = new_figure(WIDTH, 3.0 + max(2.4, 0.16 * targets))
        top, bottom = figure.subplots(2, 2, height_ratios=[2.4, max(2.4, 0.16 * targets)])
        _trials(top[0], fit)
        _correlation(top[1], fit)
        _targets(bottom[0], fit)
        _parameters(bottom[1], fit)
        figure.suptitle(f"{fit.study.path.stem}: calibration", fontsize=8)
    return figure


def _trials(panel: Axes, fit: Fit) -> None:
    for whole, face, label in ((False, "white", "first seed only"), (True, COLOURS[0], "all seeds")):
        chosen = [trial for trial in fit.trials if trial.whole is whole]
        panel.plot(
            [trial.number for trial in chosen],
            [trial.loss for trial in chosen],
            "o",
            markersize=3.5,
            color=COLOURS[0],
            markerfacecolor=face,
            label=label,
        )
    for trial in fit.trials:
        if trial.name in fit.study.starts:
            panel.annotate(trial.name, (trial.number, trial.loss), (3, 2), textcoords="offset points", fontsize=7)
    panel.plot(fit.best.number, fit.best.loss, "*", color=COLOURS[1], markersize=9, label="the fit")
    panel.set_yscale("log")
    panel.set_xlabel("trial")
    panel.set_ylabel("loss")
    panel.legend(frameon=False, ncols=3, loc="lower left", bbox_to_anchor=(-0.1, 1.0), columnspacing=1.0)


def _targets(panel: Axes, fit: Fit) -> None:
    labels = [f"{case.name} {target.label}" for case in fit.study.cases for target in case.targets]
    rows = np.arange(len(labels))
    shown = [(c.name, fit.final.residuals(c.samples.mean(axis=0))) for c in fit.confirmed] if fit.final else []
    if not shown:
        shown = [("the fit", fit.scale.residuals(fit.best.stacked.mean(axis=0)))]
    for index, (name, residuals) in enumerate(shown):
        place = np.clip(residuals, -FARTHEST, FARTHEST)
        label = name if name == "the fit" or name not in fit.study.starts else f"start {name}"
        panel.plot(place, rows, "os^Dv"[index % 5], color=COLOURS[(1 - index) % 7], markersize=3.5, label=label)
    panel.axvspan(-1, 1, color="0.9", zorder=0, linewidth=0)
    panel.set_yticks(rows, labels)
    panel.invert_yaxis()
    panel.set_xlabel("deviation from what was observed, in its errors")
    panel.legend(frameon=False)


def _parameters(panel: Axes, fit: Fit) -> None:
    names = reals(fit.study.parameters)
    rows = np.arange(len(names))
    whole = sorted((t for t in fit.trials if t.whole), key=lambda trial: -trial.loss)
    places = np.array([units(fit.study.parameters, trial.point) for trial in whole]).reshape(len(whole), len(names))
    losses = np.log10([trial.loss for trial in whole])
    for row in rows:
        drawn = panel.scatter(places[:, row], np.full(len(whole), row), c=losses, cmap="viridis_r", s=10, linewidths=0)
    here = units(fit.study.parameters, fit.best.point)
    width = fit.identified.deviation if fit.identified else np.zeros(len(names))
    panel.errorbar(here, rows + 0.22, xerr=width, fmt="*", color=COLOURS[1], markersize=7, linewidth=0.9)
    ends = [f"{one.name}\n{text_of(one.low)} … {text_of(one.high)}{' (log)' if one.log else ''}" for one in names]
    panel.set_yticks(rows, ends)
    panel.set_ylim(len(names) - 0.4, -0.6)
    panel.set_xlim(-0.03, 1.03)
    panel.set_xlabel("place in the range; star: the fit ± its deviation")
    if len(names):
        panel.figure.colorbar(drawn, ax=panel, label="log₁₀ loss of trials", shrink=0.8)


def _correlation(panel: Axes, fit: Fit) -> None:
    found = fit.identified
    if found is None or not found.names:
        panel.set_visible(False)
        return
    image = panel.imshow(found.correlation, cmap="RdBu_r", vmin=-1, vmax=1)
    rows = range(len(found.names))
    for i in rows:
        for j in range(i):
            value = found.correlation[i, j]
            panel.text(
                j, i, f"{value:+.2f}", ha="center", va="center", fontsize=5, color="w" if abs(value) > 0.6 else "k"
            )
    panel.set_xticks(rows, found.names, rotation=45, ha="right")
    panel.set_yticks(rows, found.names)
    panel.set_title("correlation of errors")
    panel.figure.colorbar(image, ax=panel, shrink=0.8)
