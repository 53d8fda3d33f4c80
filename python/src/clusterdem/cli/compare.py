"""Two runs, or groups of runs, beside each other; or a run beside the paper's numbers (--case).

clusterdem compare RUN RUN compares two folders of runs, clusterdem compare RUN RUN … --with RUN RUN … two groups of them, such as
the seeds of two settings, at the times that all have. Writes to DIR compare.csv (a row per time and number: both groups' means and
spreads between runs, the difference, in percent where that has a meaning, its standard error, and p, how likely two groups of one
kind differ by so much: Welch's test) and compare.png; prints the last time. A group of one run is judged by the other's
spread; of two single runs nothing is known of the spread, so give more seeds.

clusterdem compare DUMP … --case CASE prints a table of the solids in the domain, N(t), mean diameter, the paper's four size classes
(percent of clusters by number) and the largest cell fraction, each with the difference to the published value and to reading A
of the model. Frames count for the time that they are nearest to, within 1 % of it. Where the domain holds less solids than the
case, numbers of clusters are scaled to the case's.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from .. import observables
from ..analysis.sizes import check_borders
from ..comparison import DEFAULT, Compared, compare_runs
from ..errors import ArgumentError, InputError
from ..io.output import write_csv, write_text
from ..io.parallel import communicator, over_frames
from ..plot.compare import draw_compared
from ..plot.style import save
from ..published.cases import CASES, CLASS_BORDERS
from ..published.compare import as_text, compare, moment_of
from ..run import Run
from .common import add_density, finish, paper_case, positive, tell

OF_RUNS = {"with_": "with", "time": "time", "observe": "observe", "observables": "observables", "classes": "classes"}
"""Options that belong to two groups of runs, by their names in the parsed options."""

HEADING = (
    "time observable part unit first first_spread second second_spread difference difference_percent standard_error p"
).split()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("words", nargs="+", metavar="RUN", help="folders of runs; with --case dump files, any order")
    parser.add_argument("--dt", type=positive, metavar="S", help="timestep (s), for dumps that hold no time")
    add_density(parser)
    parser.add_argument(
        "--with", dest="with_", nargs="+", metavar="RUN", help="the second group of runs (default: the second of two)"
    )
    parser.add_argument("--time", type=float, nargs="+", metavar="S", help="times to compare at (s; default: all)")
    parser.add_argument(
        "--observe", nargs="+", metavar="NAME", help=f"observables to compare (default {' '.join(DEFAULT)})"
    )
    parser.add_argument(
        "--observables", type=Path, metavar="FILE.py", help="a file of your own that registers observables"
    )
    parser.add_argument(
        "--classes", type=positive, nargs="+", metavar="UM", help="borders of the size classes (µm, ascending)"
    )
    parser.add_argument("--case", choices=sorted(CASES), help="the paper's case to compare one run's dumps with")
    parser.add_argument("--rows", nargs="+", metavar="ROW", help="with --case: sources, paper, 'row A' … 'row E'")
    parser.add_argument(
        "--out",
        type=Path,
        metavar="PATH",
        help="folder for the results (default compare); with --case the table's file",
    )


def run(options: argparse.Namespace) -> None:
    if options.case is not None:
        _published(options)
    elif (comm := communicator()) is None or comm.rank == 0:
        _runs(options)


def _groups(options: argparse.Namespace) -> tuple[list[str], list[str]]:
    """Folders of the two groups."""
    if options.rows is not None:
        raise ArgumentError("rows", "are sources beside a published case: give --case too")
    first, second = options.words, options.with_
    if second is None:
        if len(first) != 2:
            words = f"of {len(first)} runs" if len(first) > 1 else "to compare a run with"
            raise ArgumentError("with", f"must name the second group {words} (dump files are compared with --case)")
        first, second = first[:1], first[1:]
    return first, second


def _runs(options: argparse.Namespace) -> None:
    if options.observables:
        observables.load(options.observables)
    first, second = ([_run(folder, options) for folder in group] for group in _groups(options))
    borders = tuple(1e-6 * border for border in options.classes or ())
    check_borders(borders)
    if not borders and all(paper_case(one.dumps) for one in [*first, *second]):
        borders = CLASS_BORDERS
    how = observables.How(borders=borders)
    compared = compare_runs(first, second, options.observe or DEFAULT, how, options.time)
    out: Path = options.out or Path("compare")
    names = [_name(group) for group in (first, second)]
    rows = _rows(compared)
    print(f"first: {names[0]}; second: {names[1]}; ± is the standard deviation between runs")
    print(_text([row for row in rows if row[0] == compared.times[-1]], compared.times[-1]), end="")
    tell(write_csv(out / "compare.csv", HEADING, rows))
    tell(save(draw_compared(compared, names), out / "compare.png"))


def _run(folder: str, options: argparse.Namespace) -> Run:
    try:
        return Run(folder, dt=options.dt, density=options.rho)
    except ArgumentError as error:  # several runs in one folder
        raise InputError(folder, f"a run's name {error.rule}: give each a folder of its own") from None


def _name(group: list[Run]) -> str:
    """A group's name: its first folder, and how many runs there are."""
    folder = group[0].path.resolve().name
    return folder if len(group) == 1 else f"{folder} … {group[-1].path.resolve().name} ({len(group)} runs)"


def _rows(compared: Compared) -> list[tuple[object, ...]]:
    """Rows of compare.csv, time by time (SI; shares in percent)."""
    rows: list[tuple[object, ...]] = []
    for number, time in enumerate(compared.times):
        for name, found in compared.found.items():
            what, one = observables.find(name), found[number]
            for i, part in enumerate(compared.parts[name]):
                columns = (one.first, one.first_spread, one.second, one.second_spread, one.difference)
                a = float(one.first[i])
                percent = 100 * float(one.difference[i]) / abs(a) if what.relative and a else math.nan
                values = [float(values[i]) for values in columns]
                rows.append((time, name, part, what.unit, *values, percent, float(one.error[i]), float(one.p_value[i])))
    return rows


def _text(rows: list[tuple[object, ...]], time: float) -> str:
    """The rows of one time as an aligned table."""
    lines = [[f"at {time:g} s", "first", "", "second", "", "difference", "", "standard error", "p"]]
    for _, name, part, unit, *numbers in rows:
        first, first_spread, second, second_spread, difference, percent, error, p = map(_number, numbers)
        spreads = [f"± {spread}" if spread else "" for spread in (first_spread, second_spread)]
        what = f"{name} {part}".rstrip() + (f" ({unit})" if unit else "")
        share = f"{float(str(numbers[5])):+.1f} %" if percent else ""
        lines.append([what, first, spreads[0], second, spreads[1], difference, share, error, p])
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    aligned = (
        "  ".join(f"{w:<{n}}" if i in (0, 2, 4) else f"{w:>{n}}" for i, (w, n) in enumerate(zip(line, widths)))
        for line in lines
    )
    return "".join(line.rstrip() + "\n" for line in aligned)


def _number(value: object) -> str:
    """Four digits; nothing where it is not known."""
    number = float(str(value))
    return "" if math.isnan(number) else f"{number:.4g}"


def _published(options: argparse.Namespace) -> None:
    for name, option in OF_RUNS.items():
        if getattr(options, name) is not None:
            raise ArgumentError(option, "is for two groups of runs, without --case")
    sources = options.rows or ["paper", "row A"]
    known = [row.name for row in CASES[options.case].rows]
    unknown = [name for name in sources if name not in known]
    if unknown:
        raise ArgumentError("rows", f"{options.case} has no {unknown[0]!r}; it has {', '.join(known)}")
    found = over_frames(options.words, lambda frame: moment_of(frame), ("n", "type"), options.dt, options.rho)
    if found.root and found.heads:
        for head in found.heads:
            if math.isnan(head.time):
                raise InputError(head.path, "holds no time to compare at: give --dt", head.line)
        text = as_text(compare(found.values, options.case, sources))
        print(text, end="")
        if options.out is not None:
            tell(write_text(options.out, text))
    finish(found)
