"""Maps as panels over time, like the paper's Figs. 1, 2 and 4."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.colors import Normalize, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..analysis.grid import Grid
from ..frame import Floats
from .style import WIDTH, new_figure, styled

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
        return TwoSlopeNorm(0.0, low, high), "RdBu_r"
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
    with styled():
        panel = min((WIDTH - 1.75) / max(len(maps), 2), 1.6)
        width = 1.75 + panel * len(maps)
        figure = new_figure(width, min(max(panel * lz / lx + 0.65, 2.0), 8.5), layout="compressed")
        axes = figure.subplots(1, len(maps), sharex=True, sharey=True, squeeze=False)[0]
        image: Any = None
        for axis, values, label in zip(axes, stack, labels):
            image = axis.pcolormesh(1e3 * first, 1e3 * second, values.T, norm=norm, cmap=colours, rasterized=True)
            axis.set_aspect("equal")
            axis.set_title(label)
            axis.set_xlabel(f"{grid.plane[0]} (mm)")
            axis.tick_params(direction="out", length=2.5)
            axis.set_xticks([1e3 * (grid.corner[0] + part * lx) for part in (0, 0.5, 1)])
            for side in ("top", "right"):
                axis.spines[side].set_visible(True)
            axis.set_facecolor("0.85")
        axes[0].set_ylabel(f"{grid.plane[1]} (mm)")
        over = bool(np.nanmax(stack, initial=-np.inf) > norm.vmax) if norm.vmax is not None else False
        under = bool(np.nanmin(stack, initial=np.inf) < norm.vmin) if norm.vmin is not None else False
        extend = {(False, False): "neither", (True, False): "max", (False, True): "min", (True, True): "both"}
        bar = figure.colorbar(image, ax=list(axes), extend=extend[(over, under)], aspect=25, pad=0.02, fraction=0.06)
        bar.outline.set_linewidth(0.5)
        note = f"with {words}" if field.name == "fraction" and words else field.note
        if note:
            figure.supxlabel(note, fontsize=6)
        if field.name == "fraction" and scale is not None:
            bar.ax.yaxis.set_ticks_position("left")
            right = bar.ax.secondary_yaxis(
                "right", functions=(lambda v: scale * np.asarray(v), lambda v: np.asarray(v) / scale)
            )
            right.set_ylabel("solids volume fraction (%)")
            for place, side, text in ((-0.3, "right", "true"), (1.3, "left", f"paper's\nscale, ×{scale:g}")):
                bar.ax.text(place, 1.03, text, ha=side, va="bottom", fontsize=7, transform=bar.ax.transAxes)
        else:
            bar.set_label(field.label)
        if (
            isinstance(norm, TwoSlopeNorm) and norm.vmin is not None and norm.vmax is not None
        ):  # its two sides have scales of their own
            below, above = MaxNLocator(3).tick_values(norm.vmin, 0), MaxNLocator(5).tick_values(0, norm.vmax)
            ticks = [float(t) for t in (*below[:-1], *above) if norm.vmin <= t <= norm.vmax]
            bar.set_ticks(ticks, labels=[f"{t:g}".replace("-", "−") for t in ticks])
    return figure
