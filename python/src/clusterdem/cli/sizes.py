"""Sizes over time: N(t), means, Sauter diameter, the paper's four classes, a fine histogram.

Writes to DIR sizes.csv (a row per frame), histogram.csv (a row per frame and bin) and figures; prints the table. With
--series also events.csv, the engine's own count of clusters and the rates of breakups and merges.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from ..analysis.sizes import CLASS_NAMES, Sizes, fine_edges, histogram, size_summary
from ..errors import ArgumentError
from ..frame import Floats, Frame
from ..io.output import write_csv
from ..io.parallel import over_frames
from ..io.series import event_rates, read_series
from ..plot.sizes import draw_histograms, draw_sizes
from ..plot.style import save
from ..plot.times import draw_series
from .common import add_dumps, finish, positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument(
        "--bin", type=positive, default=50.0, metavar="UM", help="bin width of the fine histogram (µm, default 50)"
    )
    parser.add_argument(
        "--top", type=positive, default=1600.0, metavar="UM", help="end of the fine histogram (µm, default 1600)"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("sizes"), metavar="DIR", help="folder for the results (default sizes)"
    )
    parser.add_argument("--series", type=Path, metavar="FILE", help="the engine's table over time, NAME.N.txt")
    parser.add_argument("--no-figures", action="store_true", help="data only")


HEADING = (
    "step time clusters mass mean mass_mean sauter d_min d_max "
    "n_lt300 n_300_600 n_600_900 n_gt900 m_lt300 m_300_600 m_600_900 m_gt900"
).split()


def row_of(head: Frame, s: Sizes) -> list[float]:
    """A line of sizes.csv (m, kg, percent)."""
    means = [s.mean, s.mass_mean, s.sauter, s.smallest, s.largest]
    return [head.step, head.time, s.count, s.mass, *means, *s.classes, *s.mass_classes]


def run(options: argparse.Namespace) -> None:
    if not 1 <= options.top / options.bin <= 100_000:
        raise ArgumentError("bin", "must divide --top into 1 to 100,000 bins")
    edges = fine_edges(1e-6 * options.bin, 1e-6 * options.top)

    def work(frame: Frame) -> tuple[Sizes, tuple[Floats, Floats]]:
        return size_summary(frame.diameter, frame.mass), histogram(frame.diameter, frame.mass, edges)

    series = None if options.series is None else read_series(options.series, ("time", "clusters"))
    found = over_frames(options.dumps, work, (), options.dt)
    if found.root and found.heads:
        sizes = [size for size, _ in found.values]
        histograms = [h for _, h in found.values]
        out: Path = options.out
        print(_text(found.heads, sizes), end="")
        tell(write_csv(out / "sizes.csv", HEADING, (row_of(*pair) for pair in zip(found.heads, sizes))))
        middle = (edges[:-1] + edges[1:]) / 2
        lines = (
            (head.step, head.time, float(d), float(n), float(m))
            for head, (number, mass) in zip(found.heads, histograms)
            for d, n, m in zip(middle, number, mass)
        )
        tell(write_csv(out / "histogram.csv", ["step", "time", "diameter", "number_percent", "mass_percent"], lines))
        if not options.no_figures:
            times = np.array([head.time for head in found.heads])
            steps = np.array([head.step for head in found.heads])
            tell(save(draw_sizes(times, steps, sizes), out / "sizes.png"))
            labels = [head.label for head in found.heads]
            tell(save(draw_histograms(edges, histograms, labels), out / "histogram.png"))
        if series is not None:
            rates = event_rates(series)
            tell(write_csv(out / "events.csv", list(rates), zip(*(values.tolist() for values in rates.values()))))
            if not options.no_figures:
                tell(save(draw_series(series, rates), out / "events.png"))
    finish(found)


def _text(heads: list[Frame], sizes: list[Sizes]) -> str:
    names = "  ".join(f"{name:>8}" for name in CLASS_NAMES)
    lines = [f"{'frame':>16}  {'clusters':>8}  {'mean':>6}  {'Sauter':>6}  {'d_min':>6}  {'d_max':>6}  {names}"]
    for head, s in zip(heads, sizes):
        means = "  ".join(f"{1e6 * d:6.1f}" for d in (s.mean, s.sauter, s.smallest, s.largest))
        lines.append(f"{head.label:>16}  {s.count:8d}  {means}  " + "  ".join(f"{c:8.2f}" for c in s.classes))
    lines.append("diameters in µm, classes in percent of clusters by number")
    return "\n".join(lines) + "\n"
