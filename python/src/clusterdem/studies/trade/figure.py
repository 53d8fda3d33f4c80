"""The Pareto figure: error against core-seconds, the spread between seeds as a grey band."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from ...observables import find
from ...plot.style import COLOURS, WIDTH, new_figure, styled
from .errors import Error
from .weigh import Weighed, front

MARKS = "osD^v<>PX*"
DECADES = 2.5
"""Decades below the spread that a panel shows; smaller errors stand on its lower edge."""


def draw_pareto(weighed: Sequence[Weighed], names: Sequence[str], title: str, tolerance: float | None = None) -> Figure:
    """One panel per observable; numbers are those of the table, the line joins settings that no other beats."""
    axes_of = list(dict.fromkeys(_axis(w) for w in weighed))
    columns = min(2, len(names))
    rows = math.ceil(len(names) / columns)
    with styled():
        figure = new_figure(WIDTH, 2.0 * rows + 0.9)
        panels = figure.subplots(rows, columns, squeeze=False, sharex=True).ravel()
        for panel, name in zip(panels, names):
            _panel(panel, weighed, name, axes_of)
            if tolerance is not None:
                panel.axhline(100 * tolerance, color="0.4", linewidth=0.7, linestyle="--", zorder=1)
        for panel in panels[len(names) :]:
            panel.set_visible(False)
        for panel in panels[max(0, len(names) - columns) : len(names)]:
            panel.set_xlabel("core-seconds")
            panel.tick_params(labelbottom=True)
        handles = [
            Line2D([], [], linestyle="", marker=_mark(i), color=_colour(i), label=axis, markersize=4)
            for i, axis in enumerate(axes_of)
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
        figure.suptitle(title, fontsize=8)
    return figure


def _axis(w: Weighed) -> str:
    return "combinations" if " + " in w.setting.axis else w.setting.axis


def _mark(axis: int) -> str:
    return MARKS[axis % len(MARKS)]


def _colour(axis: int) -> str:
    palette = ("#000000", *COLOURS[:-1], "#8C564B", "#7F7F7F")
    return palette[axis % len(palette)]


def _panel(panel: Axes, weighed: Sequence[Weighed], name: str, axes_of: Sequence[str]) -> None:
    errors: dict[int, Error] = {}
    for number, w in enumerate(weighed):
        error = w.errors[name]
        if error is not None and w.costs and math.isfinite(error.value):
            errors[number] = error
    if not errors:
        panel.text(0.5, 0.5, f"{find(name).label}: cannot be compared", ha="center", transform=panel.transAxes)
        return
    spread = errors[0].spread if 0 in errors else 0.0
    drawn = [error.value + max(error.uncertainty, 0.0) for error in errors.values() if math.isfinite(error.value)]
    largest = max([spread, *(value for value in drawn if math.isfinite(value))]) or 1e-3
    floor = (spread or largest) / 10**DECADES
    panel.axhspan(100 * floor, 100 * spread, color="0.9", zorder=0, linewidth=0)
    shown = {number: max(error.value, floor) for number, error in errors.items()}
    line = front(weighed, shown)
    panel.plot(
        [weighed[n].core_seconds for n in line], [100 * shown[n] for n in line], color="0.55", linewidth=0.8, zorder=1
    )
    for number, error in errors.items():
        w, value = weighed[number], shown[number]
        x, axis = w.core_seconds, axes_of.index(_axis(w))
        costs = [cost.core_seconds for cost in w.costs.values()]
        below = min(error.uncertainty, value - floor) if error.uncertainty > 0 else 0.0
        above = error.uncertainty if error.uncertainty > 0 else 0.0
        panel.errorbar(
            [x],
            [100 * value],
            xerr=[[x - min(costs)], [max(costs) - x]],
            yerr=[[100 * below], [100 * above]],
            marker=_mark(axis),
            color=_colour(axis),
            markersize=4,
            elinewidth=0.6,
            zorder=2,
            clip_on=False,
        )
        if value == floor and number not in line:
            continue  # a crowd on the lower edge: no two could be told apart
        panel.annotate(
            str(number), (x, 100 * value), xytext=(3, 3), textcoords="offset points", fontsize=6, annotation_clip=False
        )
    panel.set_xscale("log")
    panel.set_yscale("log")
    panel.set_ylim(100 * floor, 200 * largest)
    panel.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    for axis_of_panel in (panel.xaxis, panel.yaxis):
        axis_of_panel.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis_of_panel.set_minor_formatter(NullFormatter())
    panel.set_ylabel(f"{find(name).label}: error (%)")
