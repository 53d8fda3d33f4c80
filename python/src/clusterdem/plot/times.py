"""Non-uniformity, lateral profiles, g(r), event rates and engine time as figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..analysis.averages import TimeAverage
from ..analysis.nonuniformity import Uniformity
from ..analysis.profiles import Profile
from ..frame import Floats
from .sizes import time_axis, top
from .style import COLOURS, WIDTH, new_figure, styled


def _shades(count: int) -> NDArray[np.float64]:
    return np.asarray(colormaps["viridis"](np.linspace(0.0, 0.88, count)))


def draw_uniformity(
    times: Floats, steps: NDArray[np.int64], found: Sequence[Uniformity], scale: float | None = None
) -> Figure:
    """Extreme cells (beside them a published scale), deviation against chance, the dense cells' share, over time."""
    t, label = time_axis(times, steps)
    with styled():
        figure = new_figure(WIDTH, 2.5)
        extremes, dispersion, dense = figure.subplots(1, 3)
        for name, colour, mark in (("largest", 1, "^"), ("mean", 0, "o"), ("smallest", 2, "v")):
            values = [100 * getattr(u, name) for u in found]
            extremes.plot(t, values, mark + "-", color=COLOURS[colour], label=name, markersize=3)
        extremes.set_ylabel("cell solids fraction, true (%)")
        extremes.set_ylim(0, 130 * top([u.largest for u in found]))
        extremes.legend(
            frameon=False, ncols=3, loc="upper left", columnspacing=0.6, handlelength=0.8, handletextpad=0.3
        )
        if scale is not None:
            right = extremes.secondary_yaxis(
                "right", functions=(lambda v: scale * np.asarray(v), lambda v: np.asarray(v) / scale)
            )
            right.set_ylabel(f"paper's scale, ×{scale:g} (%)")
        dispersion.plot(t, [u.dispersion for u in found], "o-", color=COLOURS[0], label="by solids", markersize=3)
        dispersion.plot(
            t, [u.number_dispersion for u in found], "s-", color=COLOURS[1], label="by number", markersize=3
        )
        dispersion.axhline(1.0, color="0.4", linewidth=0.8, linestyle="--", label="chance (Poisson)")
        dispersion.set_ylabel("index of dispersion")
        dispersion.set_ylim(
            0, 1.35 * max(1.0, top([value for u in found for value in (u.dispersion, u.number_dispersion)]))
        )
        dispersion.legend(frameon=False, loc="upper left")
        dense.plot(t, [100 * u.dense_share for u in found], "o-", color=COLOURS[0], markersize=3)
        dense.set_ylabel("solids in dense cells (%)")
        dense.set_ylim(bottom=0)
        for axis in (extremes, dispersion, dense):
            axis.set_xlabel(label)
    return figure


def _panels(profile: Profile) -> list[tuple[str, str, float]]:
    """Name, label and factor to the label's unit of what is drawn of a profile."""
    along = profile.along
    return [
        ("fraction", "solids fraction, true (%)", 100.0),
        (f"velocity_{along}", f"solids velocity $v_{along}$ (m/s)", 1.0),
        ("mean_diameter", "mean diameter (µm)", 1e6),
    ]


def _profile_axes(profile: Profile, known: Sequence[tuple[str, str, float]]) -> tuple[Figure, list[Axes]]:
    figure = new_figure(WIDTH, 2.5)
    axes = list(np.atleast_1d(figure.subplots(1, len(known))))
    for axis, (_, label, _) in zip(axes, known):
        axis.set_xlabel(f"{profile.across} (mm)")
        axis.set_ylabel(label)
        axis.margins(x=0)
    return figure, axes


def draw_profiles(profiles: Sequence[Profile], labels: Sequence[str]) -> Figure:
    """Solids fraction, velocity and mean diameter of profiles, a line per frame."""
    first = profiles[0]
    known = [panel for panel in _panels(first) if any(np.isfinite(p.columns[panel[0]]).any() for p in profiles)]
    with styled():
        figure, axes = _profile_axes(first, known or _panels(first))
        for axis, (name, _, factor) in zip(axes, known or _panels(first)):
            lines = [factor * profile.columns[name] for profile in profiles]
            for values, profile, shade, label in zip(lines, profiles, _shades(len(profiles)), labels):
                axis.stairs(values, 1e3 * profile.edges, color=shade, label=label, baseline=None, linewidth=1.1)
            if np.nanmin(np.concatenate(lines), initial=0.0) >= 0:
                axis.set_ylim(bottom=0)
        figure.legend(
            *axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(labels), frameon=False
        )
    return figure


def draw_average(means: Mapping[str, TimeAverage], profile: Profile, label: str) -> Figure:
    """Solids fraction, velocity and mean diameter averaged over frames, with two standard errors to either side.

    Parameters
    ----------
    means : mapping of str to TimeAverage, shape (B,)
        The averages by the names of :attr:`Profile.columns`.
    profile : Profile
        One of the profiles, for its bins and axes.
    label : str
        Which frames they are over.
    """
    known = [panel for panel in _panels(profile) if np.isfinite(means[panel[0]].mean).any()]
    edges = 1e3 * profile.edges
    with styled():
        figure, axes = _profile_axes(profile, known or _panels(profile))
        for axis, (name, _, factor) in zip(axes, known):
            mean, error = factor * means[name].mean, 2 * factor * means[name].error
            axis.stairs(mean, edges, color=COLOURS[0], baseline=None, label=label, linewidth=1.1)
            axis.stairs(
                mean + error,
                edges,
                baseline=mean - error,
                fill=True,
                color=COLOURS[0],
                alpha=0.25,
                label="± 2 standard errors",
            )
            axis.set_xlim(edges[0], edges[-1])
            if name == "fraction":
                axis.set_ylim(bottom=0)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False)
    return figure


def draw_pair_correlation(curves: Sequence[tuple[Floats, Floats]], labels: Sequence[str]) -> Figure:
    """g(r), a line per frame."""
    with styled():
        figure = new_figure(3.6, 2.5)
        axis = figure.subplots()
        for (r, g), shade, label in zip(curves, _shades(len(curves)), labels):
            axis.plot(1e3 * r, g, color=shade, label=label)
        axis.axhline(1.0, color="0.4", linewidth=0.8, linestyle="--")
        axis.set_xlabel("distance of centres r (mm)")
        axis.set_ylabel("g(r)")
        axis.set_xlim(left=0)
        axis.set_ylim(bottom=0)
        axis.legend(frameon=False)
    return figure


def draw_series(series: Mapping[str, Floats], rates: Mapping[str, Floats]) -> Figure:
    """The engine's own N(t) and the event rates."""
    with styled():
        figure = new_figure(WIDTH, 2.3)
        number, events = figure.subplots(1, 2)
        number.plot(1e3 * series["time"], series["clusters"] / 1000, color=COLOURS[0])
        number.set_ylabel("clusters (thousands)")
        number.set_ylim(bottom=0)
        for name, colour, style in (("breakups", COLOURS[1], "-"), ("merges", COLOURS[0], "--")):
            if name in rates:
                events.plot(1e3 * rates["time"], rates[name] / 1000, color=colour, label=name, linestyle=style)
        events.set_ylabel("events per millisecond")
        events.set_ylim(bottom=0)
        if len(rates) > 1:
            events.legend(frameon=False)
        for axis in (number, events):
            axis.set_xlabel("time (ms)")
            axis.margins(x=0.01)
    return figure


def draw_phases(phases: Mapping[str, float]) -> Figure:
    """Engine time by phase."""
    total = sum(phases.values())
    names = sorted(phases, key=lambda name: phases[name])
    with styled():
        figure = new_figure(4.2, 0.7 + 0.22 * len(names))
        axis = figure.subplots()
        bars = axis.barh(names, [phases[name] for name in names], color=COLOURS[0], height=0.65)
        axis.bar_label(bars, [f" {100 * phases[name] / total:.1f} %" for name in names], fontsize=7)
        axis.set_xlabel("time (s, average over ranks)")
        axis.margins(x=0.15)
        axis.set_xlim(left=0)
    return figure
