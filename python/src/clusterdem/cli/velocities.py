"""Velocities of the clusters: histograms, means, variances and the granular temperature over time.

Writes to DIR velocities.csv (a row per frame: clusters; mean and variance along each axis and the granular temperature, n_… by
number and m_… by mass), histogram.csv (a row per frame, axis and bin, what lies beyond the bins in rows of its own) and
figures. Variances are about the frame's own mean, with N − 1 by number and its counterpart by mass; the temperature is their mean.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from ..analysis.sizes import histogram
from ..analysis.velocities import Moments, check_axes, velocity_moments, velocity_of
from ..errors import ArgumentError
from ..frame import Floats, Frame
from ..io.output import write_csv
from ..io.parallel import communicator, over_frames
from ..plot.style import save
from ..plot.velocities import draw_temperature, draw_velocities
from .common import add_dumps, finish, tell

MOST_BINS = 100_000
WEIGHTS = {"n": "number", "m": "mass"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument("--axes", default="xz", help="the axes that count, such as z or xyz (default xz)")
    parser.add_argument("--bins", type=int, default=40, metavar="N", help="bins of the histogram (default 40)")
    parser.add_argument(
        "--range", type=float, nargs=2, metavar=("LOW", "HIGH"), help="its ends (m/s; default: all velocities)"
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("velocities"),
        metavar="DIR",
        help="folder for the results (default velocities)",
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def _edges(options: argparse.Namespace, columns: list[str]) -> list[Floats]:
    """Bin borders of each axis (m/s): as given, or around the velocities of all frames."""
    if not 1 <= options.bins <= MOST_BINS:
        raise ArgumentError("bins", f"must be 1 to {MOST_BINS:,}, not {options.bins}")
    if options.range is not None:
        low, high = options.range
        if not -np.inf < low < high < np.inf:
            raise ArgumentError("range", f"needs two velocities that rise (m/s), not {low:g} {high:g}")
        return [np.linspace(low, high, options.bins + 1)] * len(columns)

    def ends(frame: Frame) -> Floats:
        values = [velocity_of(frame, axis) for axis in options.axes]
        return np.array([(v.min(initial=np.inf), v.max(initial=-np.inf)) for v in values])

    every = np.array(over_frames(options.dumps, ends, columns, options.dt, options.rho).values)
    if comm := communicator():
        every = comm.bcast(every)
    return [
        _around(float(every[:, i, 0].min()), float(every[:, i, 1].max()), options.bins) for i in range(len(columns))
    ]


def _around(low: float, high: float, bins: int) -> Floats:
    """Bin borders that hold all velocities from ``low`` to ``high`` (m/s), also where these are one or none."""
    if not low < high:
        low, high = (low - 1, low + 1) if low == high else (-1.0, 1.0)
    edges = np.linspace(low, high, bins + 1)
    edges[-1] = np.nextafter(high, np.inf)  # the fastest lies in the last bin
    return edges


def run(options: argparse.Namespace) -> None:
    columns = [f"v{axis}" for axis in check_axes(options.axes)]
    edges = _edges(options, columns)

    def work(frame: Frame) -> tuple[int, dict[str, Moments], list[tuple[Floats, Floats]]]:
        moments = {key: velocity_moments(frame, options.axes, by) for key, by in WEIGHTS.items()}
        return (
            len(frame),
            moments,
            [histogram(velocity_of(frame, axis), frame.mass, borders) for axis, borders in zip(options.axes, edges)],
        )

    found = over_frames(options.dumps, work, columns, options.dt, options.rho)
    if found.root and found.heads:
        out: Path = options.out
        heading = ["step", "time", "clusters"]
        for key in WEIGHTS:
            heading += [f"{key}_{what}_{axis}" for what in ("mean", "variance") for axis in options.axes] + [
                f"{key}_temperature"
            ]
        rows = [
            [
                head.step,
                head.time,
                count,
                *(v for one in moments.values() for v in (*one.mean.tolist(), *one.variance.tolist(), one.temperature)),
            ]
            for head, (count, moments, _) in zip(found.heads, found.values)
        ]
        tell(write_csv(out / "velocities.csv", heading, rows))
        lines = (
            (head.step, head.time, axis, low, high, float(n), float(m))
            for head, (_, _, histograms) in zip(found.heads, found.values)
            for axis, borders, (number, mass) in zip(options.axes, edges, histograms)
            for low, high, n, m in zip([-np.inf, *borders], [*borders, np.inf], number, mass)
        )
        heading = ["step", "time", "axis", "from", "to", "number_percent", "mass_percent"]
        tell(write_csv(out / "histogram.csv", heading, lines))
        if not options.no_figures:
            labels = [head.label for head in found.heads]
            figure = draw_velocities(edges, [value[2] for value in found.values], labels, options.axes)
            tell(save(figure, out / "histogram.png"))
            times = np.array([head.time for head in found.heads])
            steps = np.array([head.step for head in found.heads])
            figure = draw_temperature(times, steps, [value[1] for value in found.values], options.axes)
            tell(save(figure, out / "velocities.png"))
    finish(found)
