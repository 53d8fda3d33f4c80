"""Sizes over time: N(t), means, Sauter diameter, size classes, a histogram.

Writes to DIR sizes.csv (a row per frame), histogram.csv (a row per frame and bin, what lies beyond the bins in rows of its
own) and figures; prints the table. Classes and bins follow from the data unless they are given; the paper's cases have the
paper's four classes. With --series also events.csv, the engine's own count of clusters and the rates of breakups and merges.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from .. import observables
from ..analysis.sizes import borders_of, check_borders, class_names, edges_of, histogram
from ..errors import ArgumentError
from ..frame import Floats, Frame
from ..io.output import write_csv
from ..io.parallel import over_frames, size_range
from ..io.series import event_rates, read_series
from ..plot.sizes import draw_histograms, draw_sizes
from ..plot.style import save
from ..plot.times import draw_series
from ..published.cases import CLASS_BORDERS
from .common import add_dumps, finish, paper_case, positive, tell

COLUMNS = {
    "clusters": "count",
    "mass": "mass",
    "mean": "mean_diameter",
    "mass_mean": "mass_mean_diameter",
    "sauter": "sauter_diameter",
    "d_min": "smallest_diameter",
    "d_max": "largest_diameter",
}
"""Columns of sizes.csv and the observables in them (m, kg); shares in percent by class follow: n_… by number, m_… by mass."""

CLASSES = {"n": "size_classes", "m": "mass_classes"}
MOST_BINS = 100_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument("--bin", type=positive, metavar="UM", help="bin width of the histogram (µm)")
    parser.add_argument("--top", type=positive, metavar="UM", help="end of the histogram (µm)")
    parser.add_argument(
        "--classes", type=positive, nargs="+", metavar="UM", help="borders of the size classes (µm, ascending)"
    )
    parser.add_argument(
        "--observe", nargs="+", default=[], metavar="NAME", help="further observables, as columns of sizes.csv"
    )
    parser.add_argument(
        "--observables", type=Path, metavar="FILE.py", help="a file of your own that registers observables"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("sizes"), metavar="DIR", help="folder for the results (default sizes)"
    )
    parser.add_argument("--series", type=Path, metavar="FILE", help="the engine's table over time, NAME.N.txt")
    parser.add_argument("--no-figures", action="store_true", help="data only")


def _edges(options: argparse.Namespace, low: float, high: float) -> Floats:
    if options.bin is None and options.top is None:
        return edges_of(low, high)
    top = 1e-6 * options.top if options.top else max(high, 1e-6 * options.bin) * (1 + 1e-9)
    width = 1e-6 * options.bin if options.bin else edges_of(low, top)[1]
    count = int(np.ceil(top / width * (1 - 1e-9)))
    if not 1 <= count <= MOST_BINS:
        raise ArgumentError("bin", f"must divide the histogram's {1e6 * top:g} µm into 1 to {MOST_BINS:,} bins")
    edges: Floats = float(width) * np.arange(count + 1.0)
    return edges


def run(options: argparse.Namespace) -> None:
    if options.observables:
        observables.load(options.observables)
    own = [observables.find(name) for name in options.observe]
    borders = tuple(1e-6 * border for border in options.classes) if options.classes else ()
    if options.classes:
        check_borders(borders)
    elif paper_case(options.dumps):
        borders = CLASS_BORDERS
    all_given = borders and options.bin and options.top
    low, high = (np.inf, 0.0) if all_given else size_range(options.dumps, options.rho)
    how = observables.How(borders=borders or borders_of(low, high))
    edges = _edges(options, low, high)
    names = dict.fromkeys([*COLUMNS.values(), *CLASSES.values(), *(one.name for one in own)])

    def work(frame: Frame) -> tuple[dict[str, Floats], tuple[Floats, Floats]]:
        found = {name: observables.find(name)(frame, how) for name in names}
        return found, histogram(frame.diameter, frame.mass, edges)

    series = None if options.series is None else read_series(options.series, ("time", "clusters"))
    columns = observables.columns_of(options.observe) if own else ()
    found = over_frames(options.dumps, work, columns, options.dt, options.rho)
    if found.root and found.heads:
        sizes = {name: np.stack([value[name] for value, _ in found.values]) for name in names}
        histograms = [h for _, h in found.values]
        out: Path = options.out
        classes = class_names(how.borders)
        print(_text(found.heads, sizes, classes), end="")
        heading = [*COLUMNS, *(f"{kind}_{_word(name)}" for kind in CLASSES for name in classes)]
        heading += [text for one in own for text in one.headings(how)]
        table = np.hstack([sizes[name] for name in names])
        rows = ([head.step, head.time, int(row[0]), *row[1:].tolist()] for head, row in zip(found.heads, table))
        tell(write_csv(out / "sizes.csv", ["step", "time", *heading], rows))
        ends = list(zip([-np.inf, *edges], [*edges, np.inf]))
        lines = (
            (head.step, head.time, low, high, float(n), float(m))
            for head, (number, mass) in zip(found.heads, histograms)
            for (low, high), n, m in zip(ends, number, mass)
            if high > 0
        )
        heading = ["step", "time", "from", "to", "number_percent", "mass_percent"]
        tell(write_csv(out / "histogram.csv", heading, lines))
        if not options.no_figures:
            times = np.array([head.time for head in found.heads])
            steps = np.array([head.step for head in found.heads])
            tell(save(draw_sizes(times, steps, sizes, classes), out / "sizes.png"))
            labels = [head.label for head in found.heads]
            tell(save(draw_histograms(edges, histograms, labels, how.borders), out / "histogram.png"))
        if series is not None:
            rates = event_rates(series)
            tell(write_csv(out / "events.csv", list(rates), zip(*(values.tolist() for values in rates.values()))))
            if not options.no_figures:
                tell(save(draw_series(series, rates), out / "events.png"))
    finish(found)


def _word(name: str) -> str:
    """A class as part of a column's name: lt300, 300_600, gt900."""
    return name.replace("<", "lt").replace(">", "gt").replace("-", "_")


def _text(heads: list[Frame], sizes: dict[str, Floats], classes: tuple[str, ...]) -> str:
    widths = [max(8, len(name)) for name in classes]
    names = "  ".join(f"{name:>{width}}" for name, width in zip(classes, widths))
    lines = [f"{'frame':>16}  {'clusters':>8}  {'mean':>6}  {'Sauter':>6}  {'d_min':>6}  {'d_max':>6}  {names}"]
    shown = ("mean_diameter", "sauter_diameter", "smallest_diameter", "largest_diameter")
    for i, head in enumerate(heads):
        means = "  ".join(f"{1e6 * sizes[name][i, 0]:6.1f}" for name in shown)
        shares = "  ".join(f"{share:{width}.2f}" for share, width in zip(sizes["size_classes"][i], widths))
        lines.append(f"{head.label:>16}  {int(sizes['count'][i, 0]):8d}  {means}  {shares}")
    lines.append("diameters in µm, classes in percent of clusters by number")
    return "\n".join(lines) + "\n"
