"""Maps as panels over time, like the paper's Figs. 1, 2 and 4."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ..analysis.grid import Grid
from ..frame import Floats
from .panels import BAR, bar_ticks, label_ends, panels_for, write_ticks
from .style import styled

MOST_PANELS = 6


@dataclass(frozen=True)
class Field:
    """How one kind of map is drawn: name in the data, colour-bar label, factor to the label's unit, colours, what to know."""

    name: str
    label: str
    factor: float = 1.0
    colours: str = "viridis"
    from_zero: bool = True
    diverging: bool = False
    clipped: bool = False
    note: str = ""


ABOUT_ITS_MEAN = "about each cell's own mean: of n clusters of one mass (n − 1)/n of what more of them would show"


def fields_of(plane: str) -> list[Field]:
    """Every kind of map in a plane."""
    return [
        Field("fraction", "solids volume fraction, true (%)", 100.0),
        Field("number_density", "clusters per volume (1/cm³)", 1e-6),
        Field("mean_diameter", "mean cluster diameter (µm)", 1e6, "cividis", from_zero=False),
        *(
            Field(f"velocity_{axis}", f"solids velocity $v_{axis}$ (m/s)", 1.0, "viridis", False, True, True)
            for axis in reversed(plane)
        ),
        Field("temperature", "granular temperature (m²/s²)", 1.0, "magma", clipped=True, note=ABOUT_ITS_MEAN),
    ]


def error_of(field: Field) -> Field:
    """How the standard error of an average is drawn."""
    label = f"standard error of\n{field.label}"
    return replace(field, label=label, colours="magma", from_zero=True, diverging=False, clipped=False, note="")


def panels_of(count: int, most: int = MOST_PANELS) -> list[int]:
    """Indices of at most ``most`` of ``count`` frames, evenly spread, the first and last among them."""
    if count <= most:
        return list(range(count))
    return sorted({round(i * (count - 1) / (most - 1)) for i in range(most)})


def _scale(values: Floats, field: Field) -> tuple[Normalize, str]:
    """One colour scale for all panels, and its colours."""
    known = values[np.isfinite(values)]
    if not known.size:
        return Normalize(0, 1), field.colours
    low, high = float(known.min()), float(known.max())
    if field.clipped:  # rare cells must not wash out the rest
        low, high = (float(v) for v in np.percentile(known, (0.25, 99.75)))
    if field.diverging and low < -0.02 * high and high > -0.02 * low:
        most = max(-low, high)  # symmetric: equal speeds both ways have equally strong colours
        return Normalize(-most, most), "RdBu_r"
    if field.from_zero and low >= 0:
        low = 0.0
    return Normalize(low, high if high > low else low + 1.0), field.colours


def draw_maps(
    maps: Sequence[Floats],
    labels: Sequence[str],
    grid: Grid,
    field: Field,
    scale: float | None = None,
    words: str = "",
) -> Figure:
    """Panels over time with one colour scale.

    Parameters
    ----------
    maps : sequence of ndarray, shape (nx, nz)
        The map of each panel, in SI units.
    labels : sequence of str
        The panels' titles.
    grid : Grid
        The grid.
    field : Field
        What they show.
    scale : float, optional
        A published scale that stands beside the true solids fraction: so many times as large.
    words : str
        What solids fractions rest on.

    Returns
    -------
    matplotlib.figure.Figure
    """
    stack = np.stack([np.asarray(m) for m in maps]) * field.factor
    norm, colours = _scale(stack, field)
    (lx, lz), (first, second) = grid.sides, grid.edges
    published = scale if field.name == "fraction" else None
    with styled():
        panels = panels_for(len(maps), lx, lz, BAR + (0.75 if published is not None else 0.0))
        figure = panels.figure
        image: Any = None
        for axis, values, label in zip(panels.axes, stack, labels):
            image = axis.pcolormesh(1e3 * first, 1e3 * second, values.T, norm=norm, cmap=colours, rasterized=True)
            axis.set_title(label)
            axis.set_facecolor("0.85")
            if not panels.horizontal:
                label_ends(axis, 1e3 * grid.corner[0], 1e3 * (grid.corner[0] + lx))
                axis.set_xlabel(f"{grid.plane[0]} (mm)")
        if panels.horizontal:
            panels.axes[-1].set_xlabel(f"{grid.plane[0]} (mm)")
        panels.axes[0].set_ylabel(f"{grid.plane[1]} (mm)")
        over = bool(np.nanmax(stack, initial=-np.inf) > norm.vmax) if norm.vmax is not None else False
        under = bool(np.nanmin(stack, initial=np.inf) < norm.vmin) if norm.vmin is not None else False
        extend = {(False, False): "neither", (True, False): "max", (False, True): "min", (True, True): "both"}
        way = "horizontal" if panels.horizontal else "vertical"
        bar = figure.colorbar(image, cax=panels.bar, extend=extend[(over, under)], orientation=way)
        bar.outline.set_linewidth(0.5)
        assert norm.vmin is not None and norm.vmax is not None
        write_ticks(bar, bar_ticks(norm.vmin, norm.vmax))
        note = f"with {words}" if field.name == "fraction" and words else field.note
        if note:
            figure.text(0.5, 0.06 / figure.get_size_inches()[1], note, fontsize=6, ha="center", va="bottom")
        if published is not None:
            _second_scale(bar, published, panels.horizontal)
        else:
            bar.set_label(field.label)
    return figure


def _second_scale(bar: Any, scale: float, horizontal: bool) -> None:
    """The published scale on the other side of the colour bar."""
    there, back = (lambda v: scale * np.asarray(v)), (lambda v: np.asarray(v) / scale)
    if horizontal:
        other = bar.ax.secondary_xaxis("top", functions=(there, back))
        bar.set_label("solids volume fraction (%)")
        bar.ax.text(-0.02, 0.5, "true (below)", ha="right", va="center", fontsize=7, transform=bar.ax.transAxes)
        bar.ax.text(
            1.02,
            0.5,
            f"paper's scale,\n×{scale:g} (above)",
            ha="left",
            va="center",
            fontsize=7,
            transform=bar.ax.transAxes,
        )
    else:
        bar.ax.yaxis.set_ticks_position("left")
        other = bar.ax.secondary_yaxis("right", functions=(there, back))
        other.set_ylabel("solids volume fraction (%)")
        for place, side, text in ((-0.3, "right", "true"), (1.3, "left", f"paper's\nscale, ×{scale:g}")):
            bar.ax.text(place, 1.03, text, ha=side, va="bottom", fontsize=7, transform=bar.ax.transAxes)
