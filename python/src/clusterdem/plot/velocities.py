"""Histograms of velocities; means and the granular temperature over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..analysis.velocities import Moments
from ..frame import Floats
from .maps import panels_of
from .sizes import time_axis
from .style import COLOURS, WIDTH, new_figure, styled

WORDS = {"n": "by number", "m": "by mass"}


def draw_velocities(
    edges: Sequence[Floats], histograms: Sequence[Sequence[tuple[Floats, Floats]]], labels: Sequence[str], axes: str
) -> Figure:
    """Histograms, a line per frame, a column per axis, by number above and by mass below.

    Parameters
    ----------
    edges : sequence over axes of ndarray, shape (B + 1,)
        Bin borders (m/s).
    histograms : sequence over frames of sequences over axes of (by_number, by_mass), each shape (B + 2,)
        Percent per bin, below all and above all of them first and last.
    labels : sequence of str
        The frames' names.
    axes : str
        The axes.
    """
    chosen = panels_of(len(histograms))
    colours = colormaps["viridis"](np.linspace(0.0, 0.88, len(chosen)))
    with styled():
        figure = new_figure(min(WIDTH, 2.0 + 2.4 * len(axes)), 3.9)
        panels = figure.subplots(2, len(axes), sharex="col", sharey=True, squeeze=False)
        for which, words in enumerate(WORDS.values()):
            for column, axis in enumerate(axes):
                panel = panels[which][column]
                for colour, number in zip(colours, chosen):
                    shares = histograms[number][column][which][1:-1]
                    panel.stairs(shares, edges[column], color=colour, label=labels[number], linewidth=1.1)
                panel.margins(x=0)
                panel.set_ylim(bottom=0)
                if which == 1:
                    panel.set_xlabel(f"$v_{axis}$ (m/s)")
                if column == 0:
                    panel.set_ylabel(f"share per bin (% {words})")
        figure.legend(*panels[0][0].get_legend_handles_labels(), loc="outside right upper", frameon=False)
    return figure


def draw_temperature(
    times: Floats, steps: NDArray[np.int64], found: Sequence[Mapping[str, Moments]], axes: str
) -> Figure:
    """Mean velocities with the standard deviation to both sides, and the granular temperature.

    Parameters
    ----------
    times, steps : ndarray, shape (F,)
        Times (s) and steps of the frames.
    found : sequence of mapping of str to Moments
        The moments of each frame, by number (n) and by mass (m).
    axes : str
        The axes.
    """
    t, label = time_axis(times, steps)
    with styled():
        figure = new_figure(WIDTH, 2.5)
        mean, temperature = figure.subplots(1, 2)
        for number, axis in enumerate(axes):
            values = np.array([one["n"].mean[number] for one in found])
            width = np.sqrt([one["n"].variance[number] for one in found])
            colour = COLOURS[number]
            mean.plot(t, values, "o-", color=colour, markersize=3, label=f"$v_{axis}$, ± standard deviation")
            mean.fill_between(t, values - width, values + width, color=colour, alpha=0.15, linewidth=0)
        mean.set_ylabel("mean velocity by number (m/s)")
        for (key, words), colour, mark in zip(WORDS.items(), COLOURS[2:], "^v"):
            temperature.plot(
                t, [one[key].temperature for one in found], mark + "-", color=colour, markersize=3, label=words
            )
        temperature.set_ylabel("granular temperature (m²/s²)")
        temperature.set_ylim(bottom=0)
        temperature.ticklabel_format(axis="y", scilimits=(-3, 4))
        for panel in (mean, temperature):
            panel.set_xlabel(label)
            panel.legend(frameon=False)
    return figure
