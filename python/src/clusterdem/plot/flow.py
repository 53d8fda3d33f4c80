"""Mass flow through a plane over time."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.figure import Figure

from ..analysis.flow import Section
from ..frame import Floats
from .style import COLOURS, WIDTH, new_figure, styled

PARTS = {"up": (COLOURS[0], "-"), "down": (COLOURS[1], "-"), "net": (COLOURS[6], ":")}


def draw_flow(times: Floats, table: Mapping[str, Floats], section: Section) -> Figure:
    """The flow by the slab, a point per frame, and by crossings, a step per interval.

    Parameters
    ----------
    times : ndarray, shape (F,)
        Times of the frames (s).
    table : mapping of str to ndarray, shape (F,)
        slab_up, slab_down, slab_net, crossed_up, crossed_down, crossed_net (kg/s); the crossings end at their frame.
    section : Section
        The plane.
    """
    with styled():
        figure = new_figure(WIDTH, 2.6)
        panels = figure.subplots(1, 2, sharey=True)
        for part, (colour, line) in PARTS.items():
            panels[0].plot(
                1e3 * times, table[f"slab_{part}"], "o", linestyle=line, color=colour, markersize=3, label=part
            )
            if len(times) > 1:
                crossed = table[f"crossed_{part}"][1:]
                panels[1].stairs(
                    crossed, 1e3 * times, color=colour, baseline=None, linestyle=line, label=part, linewidth=1.2
                )
        for panel, words in zip(panels, ("momentum in the slab", "clusters that crossed between frames")):
            panel.axhline(0.0, color="0.6", linewidth=0.6, zorder=0)
            panel.set_title(words)
            panel.set_xlabel("time (ms)")
        panels[0].set_ylabel(f"mass flow through {section.axis} = {1e3 * section.place:.4g} mm (kg/s)")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right upper", frameon=False)
    return figure
