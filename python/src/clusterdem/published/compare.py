"""A run beside the paper's numbers and those of reading A."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from .. import observables
from ..frame import Floats, Frame
from ..times import nearest
from .cases import CASES, CELL, CLASS_BORDERS, D_P, DIAMETER_RANGE, END, SCALE, Row, Span

HOW = observables.How(cell=CELL, borders=CLASS_BORDERS)
"""Cells of the paper's size, its classes."""

OBSERVED = (
    "count",
    "mean_diameter",
    "size_classes",
    "smallest_diameter",
    "largest_diameter",
    "densest_cell",
    "strip_diameter",
)

SAME_SOLIDS = 0.01
"""Share by which the solids in the domain may differ before numbers of clusters are scaled to those of the case."""

LIMITS = {"count": 0.15, "mean": 0.05, "class": 0.15, "fraction": 0.20}
"""What counts as agreement: so much of the published number, and the spread between seeds besides."""

RULE = (
    "Agrees: within 15 % of the published number (mean d 5 %, densest cell 20 %), and the spread between seeds, half the span "
    "of row A, besides."
)


@dataclass(frozen=True)
class Moment:
    """What the comparison needs of one frame.

    Parameters
    ----------
    time : float
        Time (s).
    particles : float
        Primary particles of the paper's size in the domain.
    observed : dict of str to ndarray
        The observables :data:`OBSERVED`; the densest cell is a true fraction.
    """

    time: float
    particles: float
    observed: dict[str, Floats]

    def number(self, name: str, part: int = 0) -> float:
        """One number of an observable."""
        return float(self.observed[name][part])


def moment_of(frame: Frame) -> Moment:
    """Reduce a frame to what the comparison needs."""
    found = {name: observables.find(name)(frame, HOW) for name in OBSERVED}
    return Moment(frame.time, float(frame.solids.sum()) / (math.pi / 6 * D_P**3), found)


@dataclass(frozen=True)
class Line:
    """One quantity of the comparison.

    Parameters
    ----------
    name, unit : str
        What it is.
    run : float
        The run's value, NaN where the run has no frame at that time.
    targets : tuple of (low, high) or None
        The sources' values, in the order of the table's sources.
    in_points : bool
        Differences in points of percent instead of percent of the target.
    kind : str
        Key of :data:`LIMITS`; empty where it is not judged.
    spread : float
        What seeds differ by, as a share of the number.
    """

    name: str
    unit: str
    run: float
    targets: tuple[Span | None, ...]
    in_points: bool = False
    kind: str = ""
    spread: float = 0.0

    def difference(self, source: int) -> float:
        """The run less the source's value (the middle of its span), in % of it or in points; NaN if unknown."""
        span = self.targets[source]
        if span is None or math.isnan(self.run):
            return math.nan
        middle = (span[0] + span[1]) / 2
        return self.run - middle if self.in_points else 100 * (self.run / middle - 1)

    def agrees(self, source: int) -> bool:
        """Whether the difference is within what counts as agreement."""
        span = self.targets[source]
        if span is None or math.isnan(self.run):
            return False
        middle = (span[0] + span[1]) / 2
        return abs(self.run - middle) <= (LIMITS[self.kind] + self.spread) * abs(middle)


@dataclass(frozen=True)
class Comparison:
    """All lines of a case, the sources' names, and what must be known to read them."""

    case: str
    title: str
    statement: str
    sources: tuple[str, ...]
    lines: tuple[Line, ...]
    notes: tuple[str, ...]
    verdicts: tuple[str, ...]


def _spread(span: Span | None) -> float:
    """Half a span as a share of its middle."""
    return 0.0 if span is None else (span[1] - span[0]) / (span[0] + span[1])


def _scaled(span: Span | None, factor: float) -> Span | None:
    return None if span is None else (factor * span[0], factor * span[1])


def compare(moments: Iterable[Moment], case: str, rows: Sequence[str] = ("paper", "row A")) -> Comparison:
    """Put a run beside the sources.

    Parameters
    ----------
    moments : iterable of Moment
        The run's frames; of each time of the sources the nearest counts (:mod:`clusterdem.times`).
    case : str
        ``case1``, ``case2`` or ``case3``.
    rows : sequence of str
        The sources to stand beside it.

    Returns
    -------
    Comparison
    """
    moments = list(moments)
    times = [moment.time for moment in moments]
    known = CASES[case]
    sources = [row for row in known.rows if row.name in rows]
    seeds = next(row for row in known.rows if row.name == "row A")
    notes = []

    def at(time: float) -> Moment | None:
        number = nearest(times, time)
        if number is not None and not math.isclose(times[number], time, rel_tol=1e-6, abs_tol=1e-12):
            notes.append(f"The frame at {times[number]:.6g} s stands for {time:g} s.")
        return None if number is None else moments[number]

    end = at(END)
    domain = end or (moments[-1] if moments else None)
    factor = 1.0
    lines: list[Line] = []
    if domain is not None:
        target = (float(known.particles), float(known.particles))  # all sources have them in common: told once
        lines.append(Line("primary particles", "", domain.particles, (target, *(None for _ in sources[1:]))))
        if domain.particles > 0 and abs(domain.particles / known.particles - 1) > SAME_SOLIDS:
            factor = known.particles / domain.particles
            notes.append(
                f"The domain holds {100 / factor:.3g} % of the case's solids: numbers of clusters are multiplied by {factor:.4g}."
            )
    nothing = math.nan

    def line(
        name: str, unit: str, run: float, of: Sequence[Span | None], kind: str = "", spread: Span | None = None
    ) -> None:
        lines.append(Line(name, unit, run, tuple(of), kind == "class", kind, _spread(spread)))

    for time in sorted({t for row in sources for t in row.count}):
        moment = end if time == END else at(time)
        run = nothing if moment is None else factor * moment.number("count")
        targets = [row.count.get(time) for row in sources]
        line(f"clusters at {time:g} s", "", run, targets, "count", seeds.count.get(time))
    mean = nothing if end is None else 1e6 * end.number("mean_diameter")
    line(f"mean d at {END:g} s", "µm", mean, [_scaled(row.mean, 1e6) for row in sources], "mean", seeds.mean)
    for i, name in enumerate(observables.find("size_classes").parts(HOW)):
        share = nothing if end is None else end.number("size_classes", i)
        targets = [row.classes[i] if row.classes else None for row in sources]
        line(f"{name} µm at {END:g} s", "%", share, targets, "class", seeds.classes[i] if seeds.classes else None)
    for i, name in ((0, "smallest"), (1, "largest")):
        value = nothing if end is None else 1e6 * end.number(f"{name}_diameter")
        limit = 1e6 * DIAMETER_RANGE[i]
        line(
            f"{name} d at {END:g} s", "µm", value, [(limit, limit) if row.name == "paper" else None for row in sources]
        )
    for time in sorted({t for row in sources for t in row.fraction}):
        moment = end if time == END else at(time)
        fraction = nothing if moment is None else 100 * SCALE * moment.number("densest_cell")
        targets = [_scaled(row.fraction.get(time), 100) for row in sources]
        line(f"densest cell at {time:g} s*", "%", fraction, targets, "fraction", seeds.fraction.get(time))
    if case == "case3":
        for i in range(HOW.strips):
            value = nothing if end is None else 1e6 * end.number("strip_diameter", i)
            name = f"mean d, strip {i + 1} of 6" + (" (centre)" if i == 0 else " (wall)" if i == 5 else "")
            line(name, "µm", value, [(1e6 * row.strips[i],) * 2 if row.strips else None for row in sources])
    return Comparison(
        case,
        known.title,
        known.statement,
        tuple(row.name for row in sources),
        tuple(lines),
        tuple(dict.fromkeys(notes)),
        tuple(_verdicts(lines, sources, end, case)),
    )


def _verdicts(lines: Sequence[Line], sources: Sequence[Row], end: Moment | None, case: str) -> list[str]:
    """Say plainly what agrees; how far what differs does stands in the table."""
    if end is None:
        return [f"No frame at {END:g} s: the end state cannot be compared."]
    said = []
    for source, row in enumerate(sources):
        judged = [line for line in lines if line.kind and not math.isnan(line.difference(source))]
        agree = [line.name.rstrip("*") for line in judged if line.agrees(source)]
        differ = [line.name.rstrip("*") for line in judged if not line.agrees(source)]
        said.append(
            f"{row.name}: agrees in {', '.join(agree) or 'nothing'}; differs in {', '.join(differ) or 'nothing'}."
        )
    if case == "case3":
        d = end.observed["strip_diameter"]
        rises = bool((np.diff(d) > 0).all())
        said.append(
            f"Centre to wall the mean diameter {'rises in every strip' if rises else 'does not rise throughout'} "
            "(paper, in words: below 300 µm in the centre, mostly above 600 at the walls)."
        )
    return said


def _show(value: float) -> str:
    if math.isnan(value):
        return "-"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"


def show_span(span: Span | None) -> str:
    """A span as text: one number, low–high, or a dash."""
    if span is None:
        return "-"
    low, high = (_show(value) for value in span)
    return low if low == high else f"{low}–{high}"


def show_difference(line: Line, source: int) -> str:
    """A difference as text, signed, with its unit."""
    value = line.difference(source)
    if math.isnan(value):
        return "-"
    return f"{value:+.1f} {'pt' if line.in_points else '%'}"


FOOTNOTE = "* in cells of 10 x 20 mm and on the paper's scale: its printed fractions are ten times the true ones in a slab 3 mm thick."


def table(comparison: Comparison) -> list[list[str]]:
    """The comparison as rows of text, the heading first."""
    heading = ["quantity", "run"]
    for name in comparison.sources:
        heading += [name, "difference"]
    rows = [heading]
    for line in comparison.lines:
        name = f"{line.name} ({line.unit})" if line.unit else line.name
        row = [name, _show(line.run)]
        for source, span in enumerate(line.targets):
            row += [show_span(span), show_difference(line, source)]
        rows.append(row)
    return rows


def as_text(comparison: Comparison) -> str:
    """The comparison as an aligned table for a terminal."""
    rows = table(comparison)
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]

    def join(row: list[str]) -> str:
        return "  ".join(
            word.ljust(width) if i == 0 else word.rjust(width) for i, (word, width) in enumerate(zip(row, widths))
        )

    lines = [f"{comparison.case}: {comparison.title}", *comparison.notes, "", join(rows[0])]
    lines += ["  ".join("-" * w for w in widths), *(join(row) for row in rows[1:])]
    lines += ["", FOOTNOTE, RULE, "", *comparison.verdicts]
    return "\n".join(lines) + "\n"
