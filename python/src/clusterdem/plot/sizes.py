"""Figures of N(t), mean diameters, size classes and histograms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..frame import Floats
from .maps import panels_of
from .style import COLOURS, WIDTH, new_figure, styled


def time_axis(times: Floats, steps: NDArray[np.int64]) -> tuple[Floats, str]:
    """What to draw against: milliseconds, or steps where a time is unknown."""
    if np.isnan(times).any():
        return steps.astype(np.float64), "step"
    return 1e3 * times, "time (ms)"


def top(values: Sequence[float] | Floats) -> float:
    """The largest known value, for the end of an axis; 1 where there is none."""
    known = [float(value) for value in np.ravel(values) if np.isfinite(value) and value > 0]
    return max(known, default=1.0)


def draw_sizes(times: Floats, steps: NDArray[np.int64], sizes: Mapping[str, Floats], classes: Sequence[str]) -> Figure:
    """N(t), mean diameters and size classes over time.

    Parameters
    ----------
    times, steps : ndarray, shape (F,)
        Times (s) and steps of the frames.
    sizes : mapping of str to ndarray, shape (F, M)
        The observables count, mean_diameter, sauter_diameter, mass_mean_diameter and size_classes of the frames.
    classes : sequence of str
        Names of the classes (µm).
    """
    t, label = time_axis(times, steps)
    with styled():
        figure = new_figure(WIDTH, 2.4)
        number, mean, share = figure.subplots(1, 3)
        number.plot(t, sizes["count"][:, 0] / 1000, "o-", color=COLOURS[0], markersize=3)
        number.set_ylabel("clusters (thousands)")
        number.set_ylim(0, 1.05e-3 * top(sizes["count"]))
        for name, text, colour, mark in (
            ("mean_diameter", "by number", COLOURS[0], "o"),
            ("sauter_diameter", "Sauter", COLOURS[1], "s"),
            ("mass_mean_diameter", "by mass", COLOURS[2], "^"),
        ):
            mean.plot(t, 1e6 * sizes[name][:, 0], mark + "-", color=colour, label=text, markersize=3)
        mean.set_ylabel("mean diameter (µm)")
        mean.set_ylim(0, 1.08e6 * top(sizes["mass_mean_diameter"]))
        mean.legend(frameon=False, loc="lower left", ncols=1, handlelength=1.5)
        shares = sizes["size_classes"]  # NaN without clusters: a gap
        colours = colormaps["viridis"](np.linspace(0.1, 0.95, len(classes)))
        base = np.zeros(len(t))
        for i, name in enumerate(classes):
            label_i = name.replace("-", "–") + " µm"
            if len(t) > 1:
                share.fill_between(t, base, base + shares[:, i], color=colours[i], label=label_i, linewidth=0)
            else:
                share.bar([0.0], shares[:, i], bottom=base, color=colours[i], label=label_i)
            base = base + shares[:, i]
        share.set_ylabel("clusters (% by number)")
        share.set_ylim(0, 100)
        share.margins(x=0)
        figure.legend(*share.get_legend_handles_labels(), loc="outside lower right", ncols=4, frameon=False)
        for axis in (number, mean, share):
            axis.set_xlabel(label)
    return figure


def draw_histograms(
    edges: Floats, histograms: Sequence[tuple[Floats, Floats]], labels: Sequence[str], borders: Sequence[float] = ()
) -> Figure:
    """Histograms by number and by mass, a line per frame; what lies beyond the borders is said in the legend.

    Parameters
    ----------
    edges : ndarray, shape (B + 1,)
        Bin borders (m).
    histograms : sequence of (by_number, by_mass), each shape (B + 2,)
        Percent per bin, below all and above all of them first and last.
    labels : sequence of str
        The frames' names.
    borders : sequence of float
        Class borders to be marked (m).
    """
    with styled():
        figure = new_figure(WIDTH, 2.6)
        axes = figure.subplots(1, 2, sharex=True)
        chosen = panels_of(len(histograms))
        colours = colormaps["viridis"](np.linspace(0.0, 0.92, len(chosen)))
        for which, (axis, title) in enumerate(zip(axes, ("by number", "by mass"))):
            for colour, i in zip(colours, chosen):
                shares = np.nan_to_num(histograms[i][which])
                beyond = float(shares[0] + shares[-1])
                label = labels[i] + (f" ({beyond:.2g} % beyond)" if beyond > 0 and which == 0 else "")
                axis.stairs(shares[1:-1], 1e6 * edges, color=colour, label=label, linewidth=1.1)
            for border in borders:
                axis.axvline(1e6 * border, color="0.6", linewidth=0.6, linestyle=":", zorder=0)
            axis.set_xlabel("cluster diameter (µm)")
            axis.set_ylabel(f"share per bin (% {title})")
            axis.set_xlim(1e6 * edges[0], 1e6 * edges[-1])
            if any(np.nansum(shares[which][1:-1]) > 0 for shares in histograms):
                axis.set_yscale("log")
            axis.set_ylim(0.01, 110)
            axis.set_yticks([0.01, 0.1, 1, 10, 100], labels=["0.01", "0.1", "1", "10", "100"])
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside right upper", frameon=False)
    return figure
