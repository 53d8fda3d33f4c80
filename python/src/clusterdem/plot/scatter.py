"""Clusters drawn as discs of their true size."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Colormap, ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ..errors import InputError
from ..frame import Floats, Frame
from .panels import label_ends, panels_for
from .style import counted, styled

ON_WHITE = ListedColormap(colormaps["viridis_r"](np.linspace(0.15, 1.0, 256)))
"""Viridis without its lightest end, which would vanish on white."""

Window = tuple[float, float, float, float]

MOST_TICKS = 8


@dataclass(frozen=True)
class Colouring:
    """What colours the discs: label of the bar, colours, and their scale."""

    label: str
    colours: str | Colormap
    norm: Normalize


def colouring_of(low: float, high: float, by: str) -> Colouring:
    """A colour scale for ``diameter``, ``vx``, ``vy``, ``vz`` or ``speed`` from low to high (µm or m/s)."""
    if not low <= high:  # no clusters
        low, high = 1.0, 10.0
    if not high - low > 1e-6 * abs(high):  # all alike: a scale about the one value
        low, high = low - 0.05 * abs(low) - 1e-9, high + 0.05 * abs(high) + 1e-9
    if by == "diameter":
        return Colouring("cluster diameter (µm)", ON_WHITE, LogNorm(low, high))
    label = "speed (m/s)" if by == "speed" else f"$v_{by[1:]}$ (m/s)"
    return Colouring(label, ON_WHITE, Normalize(low, high))


def round_ticks(norm: Normalize) -> list[float]:
    """At most :data:`MOST_TICKS` round numbers within a logarithmic scale, at least its ends."""
    assert norm.vmin is not None and norm.vmax is not None
    low, high = float(norm.vmin), float(norm.vmax)
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    for steps in ((1, 2, 3, 4, 5, 6, 8), (1, 2, 4, 6), (1, 3), (1,)):
        ticks = [step * 10.0**decade for decade in decades for step in steps]
        ticks = [tick for tick in ticks if low <= tick <= high]
        if len(ticks) <= MOST_TICKS:
            break
    return ticks if len(ticks) > 1 else [float(f"{low:.3g}"), float(f"{high:.3g}")]


def colour_bar(figure: Figure, discs: Any, axes: Any, colours: Colouring) -> None:
    """The colour bar of discs."""
    _label(figure.colorbar(discs, ax=axes, aspect=30, pad=0.02), colours)


def _label(bar: Any, colours: Colouring) -> None:
    bar.set_label(colours.label)
    if isinstance(colours.norm, LogNorm):
        ticks = round_ticks(colours.norm)
        bar.set_ticks(ticks, labels=[f"{t:g}" for t in ticks])
        bar.minorticks_off()


def quantity(frame: Frame, by: str) -> Floats:
    """The values that colour the discs, shape (N,): µm or m/s."""
    if by == "diameter":
        return 1e6 * frame.diameter
    needed = [name for name in ("vx", "vy", "vz") if name in frame] if by == "speed" else [by]
    if not needed or any(name not in frame for name in needed):
        raise InputError(frame.path, f"no columns {'vx, vy, vz' if by == 'speed' else by} to colour by", frame.line)
    return np.sqrt(sum(frame[name] ** 2 for name in needed)) if by == "speed" else frame[by]


def draw_discs(axis: Axes, frame: Frame, colours: Colouring, by: str, window: Window, plane: str = "xz") -> Any:
    """Discs of true size inside a window (x0, x1, z0, z1 in m, of the plane's axes); small ones over large ones."""
    x0, x1, z0, z1 = window
    r = frame.diameter / 2
    u, v = frame[plane[0]], frame[plane[1]]
    inside = (u > x0 - r) & (u < x1 + r) & (v > z0 - r) & (v < z1 + r)
    order = np.flatnonzero(inside)[np.argsort(-frame.diameter[inside], kind="stable")]
    size = 1e3 * frame.diameter[order]
    discs = EllipseCollection(
        size,
        size,
        np.zeros(len(order)),
        units="xy",
        offsets=1e3 * np.stack([u[order], v[order]], axis=1),
        offset_transform=axis.transData,
        cmap=colours.colours,
        norm=colours.norm,
        linewidths=0.0,
        rasterized=True,
    )
    discs.set_array(quantity(frame, by)[order])
    axis.add_collection(discs)
    axis.set_xlim(1e3 * x0, 1e3 * x1)
    axis.set_ylim(1e3 * z0, 1e3 * z1)
    axis.set_aspect("equal")
    axis.set_xlabel(f"{plane[0]} (mm)")
    for side in ("top", "right"):
        axis.spines[side].set_visible(True)
    return discs


def whole(frame: Frame, plane: str = "xz") -> Window:
    """The box as a window (m)."""
    i, k = ("xyz".index(axis) for axis in plane)
    return (frame.box.lo[i], frame.box.hi[i], frame.box.lo[k], frame.box.hi[k])


def fullest_window(frame: Frame, share: float = 0.1, plane: str = "xz") -> Window:
    """A window of the box's shape (m) where clusters are: in the middle, or where most are if the middle holds less than half as many."""
    x0, x1, z0, z1 = whole(frame, plane)
    parts = round(1 / share)
    count, first, second = np.histogram2d(frame[plane[0]], frame[plane[1]], (parts, parts), ((x0, x1), (z0, z1)))
    x, z, w, h = (x0 + x1) / 2, (z0 + z1) / 2, share * (x1 - x0) / 2, share * (z1 - z0) / 2
    middle = np.sum((np.abs(frame[plane[0]] - x) <= w) & (np.abs(frame[plane[1]] - z) <= h))
    i, k = np.unravel_index(np.argmax(count), count.shape)
    if 2 * middle >= count[i, k]:
        return (x - w, x + w, z - h, z + h)
    return (float(first[i]), float(first[i + 1]), float(second[k]), float(second[k + 1]))


def draw_scatter(frame: Frame, by: str = "diameter", window: Window | None = None, plane: str = "xz") -> Figure:
    """The whole box and, beside it, a window in which single clusters can be told apart.

    Parameters
    ----------
    frame : Frame
        The clusters.
    by : str
        ``diameter``, ``vx``, ``vy``, ``vz`` or ``speed``.
    window : (x0, x1, z0, z1), optional
        The window (m); by default one in the middle of the box, or where most clusters are.
    plane : str
        The two axes that are drawn.
    """
    window = window or fullest_window(frame, plane=plane)
    values = quantity(frame, by)
    colours = colouring_of(float(values.min(initial=np.inf)), float(values.max(initial=-np.inf)), by)
    lx, lz = (frame.box.lengths["xyz".index(axis)] for axis in plane)
    with styled():
        panels = panels_for(2, lx, lz, apart=0.4)
        left, right = panels.axes
        draw_discs(left, frame, colours, by, whole(frame, plane), plane)
        discs = draw_discs(right, frame, colours, by, window, plane)
        x0, x1, z0, z1 = (1e3 * edge for edge in window)
        left.add_patch(Rectangle((x0, z0), x1 - x0, z1 - z0, fill=False, edgecolor="#D55E00", linewidth=1.0))
        for spine in right.spines.values():
            spine.set_edgecolor("#D55E00")
        left.set_ylabel(f"{plane[1]} (mm)")
        between = "\n" if lz > lx else ", "
        left.set_title(f"{frame.label}{between}{counted(len(frame), 'cluster')}")
        right.set_title(f"the window,{' ' if between == ', ' else between}true sizes")
        if not panels.horizontal:
            label_ends(left, *left.get_xlim())
            label_ends(right, *right.get_xlim())
        _label(
            panels.figure.colorbar(
                discs, cax=panels.bar, orientation="horizontal" if panels.horizontal else "vertical"
            ),
            colours,
        )
    return panels.figure
