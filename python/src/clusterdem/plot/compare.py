"""Two groups of runs over time, with the spread between the runs of each."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from ..comparison import Compared
from ..observables import find
from .style import COLOURS, WIDTH, new_figure, styled

MOST_PANELS = 9
UNITS = {"m": (1e6, "µm"), "kg": (1e3, "g")}
"""Factors to the units that figures have, and these."""

LEAST = 0.02
"""What a panel spans at least, as a share of its values."""


def draw_compared(compared: Compared, names: Sequence[str]) -> Figure:
    """A panel per observable of one number, the first nine: both groups' means, and the spread as a band.

    Parameters
    ----------
    compared : Compared
        The groups.
    names : sequence of str
        Their names.
    """
    single = [name for name, parts in compared.parts.items() if len(parts) == 1]
    shown = (single or list(compared.parts))[:MOST_PANELS]
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    times = 1e3 * np.array(compared.times)
    with styled():
        figure = new_figure(max(WIDTH * columns / 3, 3.4), 0.4 + 1.9 * rows)
        panels = figure.subplots(rows, columns, squeeze=False, sharex=True).ravel()
        for panel, name in zip(panels, shown):
            what = find(name)
            factor, unit = UNITS.get(what.unit, (1.0, what.unit))
            for group, colour, mark in zip(("first", "second"), COLOURS, "os"):
                mean = factor * np.array([getattr(one, group)[0] for one in compared.found[name]])
                spread = factor * np.array([getattr(one, f"{group}_spread")[0] for one in compared.found[name]])
                label = names[("first", "second").index(group)]
                panel.plot(times, mean, mark + "-", color=colour, markersize=3, label=label)
                panel.fill_between(times, mean - spread, mean + spread, color=colour, alpha=0.2, linewidth=0)
            low, high = panel.get_ylim()
            least = LEAST * max(abs(low), abs(high))
            if high - low < least:  # what differs by rounding alone looks alike
                panel.set_ylim((low + high - least) / 2, (low + high + least) / 2)
            words = [what.label, compared.parts[name][0]]
            panel.set_ylabel(" ".join(word for word in words if word) + (f" ({unit})" if unit else ""))
        for number, panel in enumerate(panels):
            panel.set_visible(number < len(shown))
            panel.xaxis.set_tick_params(labelbottom=number + columns >= len(shown))
            if number + columns >= len(shown):
                panel.set_xlabel("time (ms)")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2, frameon=False)
    return figure
