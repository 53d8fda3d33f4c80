"""Figures of N(t), mean diameters, size classes and histograms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..analysis.sizes import CLASS_NAMES, Sizes
from ..frame import Floats
from .maps import panels_of
from .style import COLOURS, WIDTH, new_figure, styled


def time_axis(times: Floats, steps: NDArray[np.int64]) -> tuple[Floats, str]:
    """What to draw against: milliseconds, or steps where a time is unknown."""
    if np.isnan(times).any():
        return steps.astype(np.float64), "step"
    return 1e3 * times, "time (ms)"


def draw_sizes(times: Floats, steps: NDArray[np.int64], sizes: Sequence[Sizes]) -> Figure:
    """N(t), mean diameters and the four classes over time.

    Parameters
    ----------
    times, steps : ndarray, shape (F,)
        Times (s) and steps of the frames.
    sizes : sequence of Sizes, length F
        Their size statistics.
    """
    t, label = time_axis(times, steps)
    with styled():
        figure = new_figure(WIDTH, 2.4)
        number, mean, share = figure.subplots(1, 3)
        number.plot(t, [s.count / 1000 for s in sizes], "o-", color=COLOURS[0], markersize=3)
        number.set_ylabel("clusters (thousands)")
        number.set_ylim(0, 1.05e-3 * max(s.count for s in sizes))
        for values, name, colour, mark in (
            ([s.mean for s in sizes], "by number", COLOURS[0], "o"),
            ([s.sauter for s in sizes], "Sauter", COLOURS[1], "s"),
            ([s.mass_mean for s in sizes], "by mass", COLOURS[2], "^"),
        ):
            mean.plot(t, 1e6 * np.array(values), mark + "-", color=colour, label=name, markersize=3)
        mean.set_ylabel("mean diameter (µm)")
        mean.set_ylim(0, 1.08e6 * max(s.mass_mean for s in sizes))
        mean.legend(frameon=False, loc="lower left", ncols=1, handlelength=1.5)
        shares = np.array([s.classes for s in sizes])
        colours = colormaps["viridis"](np.linspace(0.1, 0.95, 4))
        base = np.zeros(len(t))
        for i, name in enumerate(CLASS_NAMES):
            label_i = name.replace("-", "–") + " µm"
            if len(t) > 1:
                share.fill_between(t, base, base + shares[:, i], color=colours[i], label=label_i, linewidth=0)
            else:
                share.bar([0.0], shares[:, i], bottom=base, color=colours[i], label=label_i)
            base = base + shares[:, i]
        share.set_ylabel("clusters (% by number)")
        share.set_ylim(0, 100)
        share.margins(x=0)
        figure.legend(*share.get_legend_handles_labels(), loc="outside lower right", ncols=4, frameon=False)
        for axis in (number, mean, share):
            axis.set_xlabel(label)
    return figure


def draw_histograms(edges: Floats, histograms: Sequence[tuple[Floats, Floats]], labels: Sequence[str]) -> Figure:
    """Fine histograms by number and by mass, a line per frame, with the paper's class borders.

    Parameters
    ----------
    edges : ndarray, shape (B + 1,)
        Bin borders (m).
    histograms : sequence of (by_number, by_mass), each shape (B,)
        Percent per bin.
    labels : sequence of str
        The frames' names.
    """
    with styled():
        figure = new_figure(WIDTH, 2.6)
        axes = figure.subplots(1, 2, sharex=True)
        chosen = panels_of(len(histograms))
        colours = colormaps["viridis"](np.linspace(0.0, 0.92, len(chosen)))
        for which, (axis, title) in enumerate(zip(axes, ("by number", "by mass"))):
            for colour, i in zip(colours, chosen):
                axis.stairs(histograms[i][which], 1e6 * edges, color=colour, label=labels[i], linewidth=1.1)
            for border in (300, 600, 900):
                axis.axvline(border, color="0.6", linewidth=0.6, linestyle=":", zorder=0)
            axis.set_xlabel("cluster diameter (µm)")
            axis.set_ylabel(f"share per bin (% {title})")
            axis.set_xlim(0, 1e6 * edges[-1])
            axis.set_yscale("log")
            axis.set_ylim(0.01, 110)
            axis.set_yticks([0.01, 0.1, 1, 10, 100], labels=["0.01", "0.1", "1", "10", "100"])
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside right upper", frameon=False)
    return figure
