"""How every figure looks: sizes, fonts, colours that the colour-blind can tell apart."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..io.output import atomic

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
"""Okabe and Ito's palette."""

RC: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.2,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 200,
}

WIDTH = 7.2
"""Width of a full-page figure (inch)."""


def styled() -> Any:
    """Context in which figures are drawn."""
    return rc_context(RC)


def new_figure(
    width: float, height: float, layout: Literal["constrained", "compressed"] | None = "constrained"
) -> Figure:
    """An empty figure (inch) with its own canvas; no global state."""
    figure = Figure(figsize=(width, height), layout=layout)
    FigureCanvasAgg(figure)
    return figure


def counted(count: int, noun: str) -> str:
    """A number and what it counts: ``1 cluster``, ``4,000 clusters``."""
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


def save(figure: Figure, path: str | Path, dpi: float | None = None) -> Path:
    """Write a figure whole or not at all."""
    with atomic(path) as name:
        figure.savefig(
            name, dpi=dpi or RC["savefig.dpi"], metadata={"Software": "clusterdem"} if name.suffix == ".png" else None
        )
    return Path(path)
