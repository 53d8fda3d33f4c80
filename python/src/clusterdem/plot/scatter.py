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
from .style import new_figure, styled

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
    high = high if high > low else low + 1e-3 * abs(low) + 1e-9
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
    bar = figure.colorbar(discs, ax=axes, aspect=30, pad=0.02)
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


def middle_window(frame: Frame, share: float = 0.1, plane: str = "xz") -> Window:
    """A window of the box's shape in its middle (m)."""
    x0, x1, z0, z1 = whole(frame, plane)
    x, z, w, h = (x0 + x1) / 2, (z0 + z1) / 2, share * (x1 - x0) / 2, share * (z1 - z0) / 2
    return (x - w, x + w, z - h, z + h)


def draw_scatter(frame: Frame, by: str = "diameter", window: Window | None = None, plane: str = "xz") -> Figure:
    """The whole box and, beside it, a window in which single clusters can be told apart.

    Parameters
    ----------
    frame : Frame
        The clusters.
    by : str
        ``diameter``, ``vx``, ``vy``, ``vz`` or ``speed``.
    window : (x0, x1, z0, z1), optional
        The window (m); the middle of the box by default.
    plane : str
        The two axes that are drawn.
    """
    window = window or middle_window(frame, plane=plane)
    values = quantity(frame, by)
    colours = colouring_of(float(values.min(initial=np.inf)), float(values.max(initial=-np.inf)), by)
    lx, lz = (frame.box.lengths["xyz".index(axis)] for axis in plane)
    with styled():
        figure = new_figure(6.2, min(max(2.45 * lz / lx + 0.7, 2.5), 8.0), layout="compressed")
        left, right = figure.subplots(1, 2)
        draw_discs(left, frame, colours, by, whole(frame, plane), plane)
        discs = draw_discs(right, frame, colours, by, window, plane)
        x0, x1, z0, z1 = (1e3 * edge for edge in window)
        left.add_patch(Rectangle((x0, z0), x1 - x0, z1 - z0, fill=False, edgecolor="#D55E00", linewidth=1.0))
        for spine in right.spines.values():
            spine.set_edgecolor("#D55E00")
        left.set_ylabel(f"{plane[1]} (mm)")
        left.set_title(f"{frame.label}, {len(frame):,} clusters")
        right.set_title("the window, true sizes")
        colour_bar(figure, discs, [left, right], colours)
    return figure
