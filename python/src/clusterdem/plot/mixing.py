"""Lacey's index over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..analysis.mixing import Lacey
from ..frame import Floats
from .sizes import time_axis
from .style import COLOURS, new_figure, styled


def draw_mixing(times: Floats, steps: NDArray[np.int64], found: Sequence[Lacey]) -> Figure:
    """The index of each frame, with what is segregated and what is chance.

    Parameters
    ----------
    times, steps : ndarray, shape (F,)
        Times (s) and steps of the frames.
    found : sequence of Lacey
        The index of each.
    """
    t, label = time_axis(times, steps)
    index = np.array([one.index for one in found])
    with styled():
        figure = new_figure(4.2, 2.5)
        axis = figure.subplots()
        axis.plot(t, index, "o-", color=COLOURS[0], markersize=3)
        axis.axhline(1.0, color="0.4", linewidth=0.8, linestyle="--", label="mixed by chance")
        axis.axhline(0.0, color="0.4", linewidth=0.8, linestyle=":", label="segregated")
        known = index[np.isfinite(index)]
        axis.set_ylim(min(-0.05, 1.1 * known.min(initial=0.0)), max(1.15, 1.1 * known.max(initial=1.0)))
        axis.set_xlabel(label)
        axis.set_ylabel("Lacey's mixing index")
        figure.legend(*axis.get_legend_handles_labels(), loc="outside upper center", ncols=2, frameon=False)
    return figure
