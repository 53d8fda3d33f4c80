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


@dataclass(frozen=True)
class Colouring:
    """What colours the discs: label of the bar, colours, and their scale."""

    label: str
    colours: str | Colormap
    norm: Normalize


def colouring_of(low: float, high: float, by: str) -> Colouring:
    """A colour scale for ``diameter``, ``vz``, ``vx`` or ``speed`` from low to high (µm or m/s)."""
    high = high if high > low else low + 1e-3 * abs(low) + 1e-9
    if by == "diameter":
        return Colouring("cluster diameter (µm)", ON_WHITE, LogNorm(low, high))
    label = {"vz": "$v_z$ (m/s)", "vx": "$v_x$ (m/s)", "speed": "speed (m/s)"}[by]
    return Colouring(label, ON_WHITE, Normalize(low, high))


def _within(value: float, norm: Normalize) -> bool:
    return norm.vmin is not None and norm.vmax is not None and norm.vmin <= value <= norm.vmax


def colour_bar(figure: Figure, discs: Any, axes: Any, colours: Colouring) -> None:
    """The colour bar of discs."""
    bar = figure.colorbar(discs, ax=axes, aspect=30, pad=0.02)
    bar.set_label(colours.label)
    if isinstance(colours.norm, LogNorm):
        ticks = [t for t in (100, 200, 300, 400, 600, 900, 1200, 1600) if _within(t, colours.norm)]
        bar.set_ticks(ticks, labels=[str(t) for t in ticks])
        bar.minorticks_off()


def quantity(frame: Frame, by: str) -> Floats:
    """The values that colour the discs, shape (N,): µm or m/s."""
    if by == "diameter":
        return 1e6 * frame.diameter
    if "vx" not in frame or "vz" not in frame:
        raise InputError(frame.path, "no columns vx and vz to colour by", frame.line)
    return np.hypot(frame["vx"], frame["vz"]) if by == "speed" else frame[by]


def draw_discs(axis: Axes, frame: Frame, colours: Colouring, by: str, window: Window) -> Any:
    """Discs of true size inside a window (x0, x1, z0, z1 in m); small ones over large ones."""
    x0, x1, z0, z1 = window
    r = frame.diameter / 2
    inside = (frame.x > x0 - r) & (frame.x < x1 + r) & (frame.z > z0 - r) & (frame.z < z1 + r)
    order = np.flatnonzero(inside)[np.argsort(-frame.diameter[inside], kind="stable")]
    size = 1e3 * frame.diameter[order]
    discs = EllipseCollection(
        size,
        size,
        np.zeros(len(order)),
        units="xy",
        offsets=1e3 * np.stack([frame.x[order], frame.z[order]], axis=1),
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
    axis.set_xlabel("x (mm)")
    for side in ("top", "right"):
        axis.spines[side].set_visible(True)
    return discs


def whole(frame: Frame) -> Window:
    """The box as a window (m)."""
    return (frame.box.lo[0], frame.box.hi[0], frame.box.lo[2], frame.box.hi[2])


def middle_window(frame: Frame, share: float = 0.1) -> Window:
    """A window of the box's shape in its middle (m)."""
    x0, x1, z0, z1 = whole(frame)
    x, z, w, h = (x0 + x1) / 2, (z0 + z1) / 2, share * (x1 - x0) / 2, share * (z1 - z0) / 2
    return (x - w, x + w, z - h, z + h)


def draw_scatter(frame: Frame, by: str = "diameter", window: Window | None = None) -> Figure:
    """The whole box and, beside it, a window in which single clusters can be told apart.

    Parameters
    ----------
    frame : Frame
        The clusters.
    by : str
        ``diameter``, ``vz``, ``vx`` or ``speed``.
    window : (x0, x1, z0, z1), optional
        The window (m); the middle of the box by default.
    """
    window = window or middle_window(frame)
    values = quantity(frame, by)
    colours = colouring_of(float(values.min()), float(values.max()), by)
    lx, _, lz = frame.box.lengths
    with styled():
        figure = new_figure(6.2, min(max(2.45 * lz / lx + 0.7, 2.5), 8.0), layout="compressed")
        left, right = figure.subplots(1, 2)
        draw_discs(left, frame, colours, by, whole(frame))
        discs = draw_discs(right, frame, colours, by, window)
        x0, x1, z0, z1 = (1e3 * edge for edge in window)
        left.add_patch(Rectangle((x0, z0), x1 - x0, z1 - z0, fill=False, edgecolor="#D55E00", linewidth=1.0))
        for spine in right.spines.values():
            spine.set_edgecolor("#D55E00")
        left.set_ylabel("z (mm)")
        left.set_title(f"{frame.label}, {len(frame):,} clusters")
        right.set_title("the window, true sizes")
        colour_bar(figure, discs, [left, right], colours)
    return figure
