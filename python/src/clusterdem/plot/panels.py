"""Panels of one box side by side, or one above the other where the box is flat, with room for titles, ticks and a colour bar."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from .style import WIDTH, new_figure

FLAT = 2.5
"""Boxes wider than this times their height are drawn one above the other."""

TALLEST = 7.0
"""Most height of panels (inch)."""

LEFT, TOP, BOTTOM, BAR, GAP = 0.65, 0.42, 0.72, 1.15, 0.16
"""Room (inch) for the upright axis, the titles, the other axis with a note, the colour bar, and between panels."""

SLOT = 0.85
"""Least width of a panel with its title (inch)."""


@dataclass(frozen=True)
class Panels:
    """A figure with its panels.

    Parameters
    ----------
    figure : Figure
        The figure, laid out by hand, so that no text meets another however the box is shaped.
    axes : sequence of Axes
        The panels, in order.
    bar : Axes
        Where the colour bar goes.
    horizontal : bool
        Whether the colour bar lies below the panels.
    """

    figure: Figure
    axes: Sequence[Axes]
    bar: Axes
    horizontal: bool


def panels_for(count: int, lx: float, lz: float, bar: float = BAR, apart: float = 0.0) -> Panels:
    """Panels of a box of ``lx`` by ``lz``, any unit.

    ``bar`` is the room for an upright colour bar, ``apart`` what panels need between them besides their titles (inch), where each
    has ticks of its own.
    """
    if lx > FLAT * lz:
        return _rows(count, lx, lz, 0.5 + apart, own=apart > 0)
    return _columns(count, lx, lz, bar, GAP + apart, own=apart > 0)


def _axes(figure: Figure, x: float, y: float, width: float, height: float) -> Axes:
    total_x, total_y = figure.get_size_inches()
    return figure.add_axes((x / total_x, y / total_y, width / total_x, height / total_y))


def _columns(count: int, lx: float, lz: float, room: float, gap: float, own: bool) -> Panels:
    slot = min((WIDTH - LEFT - room) / count, 2.2 if count < 3 else 1.75)
    width = slot - gap
    if width * lz / lx > TALLEST:
        width = TALLEST * lx / lz
    height, slot = width * lz / lx, max(width + gap, SLOT + gap - GAP)
    bar_height = min(max(height, 1.5), 4.0)
    tall = max(height, bar_height)
    figure = new_figure(LEFT + count * slot + room, tall + TOP + BOTTOM, layout=None)
    bottom = BOTTOM + (tall - height) / 2
    axes = [_axes(figure, LEFT + k * slot + (slot - gap - width) / 2, bottom, width, height) for k in range(count)]
    # more room than usual is for labels on the left of the bar
    bar = _axes(
        figure,
        LEFT + count * slot + 0.05 + max(room - BAR - 0.25, 0.0),
        BOTTOM + (tall - bar_height) / 2,
        0.11,
        bar_height,
    )
    _ticks(axes, width, height)
    if not own:
        for axis in axes[1:]:
            axis.tick_params(labelleft=False)
    return Panels(figure, axes, bar, False)


def _rows(count: int, lx: float, lz: float, between: float, own: bool) -> Panels:
    width = WIDTH - LEFT - 0.25
    height = width * lz / lx
    most = (8.5 - BOTTOM - 0.6) / count - between
    if height > most:
        height, width = most, most * lx / lz
    figure = new_figure(LEFT + width + 0.25, count * (height + between) + BOTTOM + 0.75, layout=None)
    low = BOTTOM + 0.75
    axes = [_axes(figure, LEFT, low + (count - 1 - k) * (height + between), width, height) for k in range(count)]
    bar_width = min(width, 4.0)
    bar = _axes(figure, LEFT + (width - bar_width) / 2, BOTTOM, bar_width, 0.1)
    _ticks(axes, width, height)
    if not own:
        for axis in axes[:-1]:
            axis.tick_params(labelbottom=False)
    return Panels(figure, axes, bar, True)


def _ticks(axes: Sequence[Axes], width: float, height: float) -> None:
    """So many ticks as there is room for."""
    for axis in axes:
        axis.tick_params(direction="out", length=2.5)
        axis.xaxis.set_major_locator(MaxNLocator(max(1, int(width / 0.7)), steps=[1, 2, 2.5, 5, 10]))
        corner = "lower" if height < 0.6 else None  # of a low panel the lowest label would meet those of the other axis
        axis.yaxis.set_major_locator(MaxNLocator(max(1, int(height / 0.35)), steps=[1, 2, 2.5, 5, 10], prune=corner))
        for side in ("top", "right"):
            axis.spines[side].set_visible(True)


def label_ends(axis: Axes, low: float, high: float) -> None:
    """Only the ends of the lower axis, their labels turned away from each other where the panel is narrow."""
    width = axis.bbox.width / axis.figure.dpi  # inch
    axis.set_xticks([low, high])
    labels = axis.get_xticklabels()
    outward = width < 0.6
    labels[0].set_horizontalalignment("right" if outward else "left")
    labels[1].set_horizontalalignment("left" if outward else "right")


def bar_ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Round numbers from low to high, two at least: the ends where no two round ones lie between."""
    ticks = [float(tick) for tick in MaxNLocator(most).tick_values(low, high) if low <= tick <= high]
    return ticks if len(ticks) > 1 else [low, high]


def write_ticks(bar: Any, ticks: Sequence[float]) -> None:
    """The ticks of a colour bar, as short as tells them apart."""
    digits = next((d for d in range(3, 9) if len({f"{tick:.{d}g}" for tick in ticks}) == len(ticks)), 9)
    bar.set_ticks(list(ticks), labels=[f"{tick:.{digits}g}".replace("-", "−") for tick in ticks])
    bar.minorticks_off()
