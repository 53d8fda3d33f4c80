"""How many groups hold so many clusters or more."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from ..analysis.groups import Groups
from .maps import panels_of
from .style import new_figure, styled


def draw_groups(groups: Sequence[Groups], labels: Sequence[str]) -> Figure:
    """Groups of at least so many clusters, a line per frame, on logarithmic axes.

    Parameters
    ----------
    groups : sequence of Groups
        Those of each frame.
    labels : sequence of str
        The frames' names.
    """
    chosen = panels_of(len(groups))
    colours = colormaps["viridis"](np.linspace(0.0, 0.88, len(chosen)))
    plain = FuncFormatter(lambda value, _: f"{value:,.0f}")
    with styled():
        figure = new_figure(4.6, 2.6)
        axis = figure.subplots()
        largest, most = 1, 1
        for colour, number in zip(colours, chosen):
            sizes = np.sort(groups[number].clusters)
            different, at = np.unique(sizes, return_index=True)
            at_least = len(sizes) - at
            if len(sizes):
                largest, most = max(largest, int(sizes[-1])), max(most, len(sizes))
            axis.plot(
                different, at_least, "o-", color=colour, markersize=2.5, drawstyle="steps-pre", label=labels[number]
            )
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlim(0.9, 1.2 * max(largest, 8))
        axis.set_ylim(0.8, 1.5 * max(most, 8))
        for side in (axis.xaxis, axis.yaxis):
            side.set_major_formatter(plain)
            side.set_minor_locator(NullLocator())
        if largest < 30:
            axis.set_xticks([1, 2, 5, 10, 20])
            axis.set_xlim(0.9, 1.2 * max(largest, 8))
        else:
            axis.xaxis.set_major_locator(LogLocator(10))
        axis.set_xlabel("clusters in a group")
        axis.set_ylabel("groups of so many or more")
        figure.legend(loc="outside right upper", frameon=False)
    return figure
