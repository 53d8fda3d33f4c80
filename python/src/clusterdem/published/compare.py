"""A run beside the paper's numbers and those of reading A."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..analysis.grid import PAPER_SCALE, RHO_P, Grid, deposit, solids_fraction
from ..analysis.nonuniformity import strips
from ..analysis.sizes import CLASS_NAMES, Sizes, size_summary
from ..frame import Frame
from .numbers import CASES, DIAMETER_RANGE, END, Row, Span

GRID = (30, 30)
"""The paper's grid, on which its largest cell fractions stand."""


@dataclass(frozen=True)
class Moment:
    """What the comparison needs of one frame.

    Parameters
    ----------
    time : float
        Time (s).
    sizes : Sizes
        Size statistics.
    fraction : float
        Largest true cell fraction on the paper's grid.
    strips : tuple of float
        Mean diameter (m) in six strips from centre to wall.
    """

    time: float
    sizes: Sizes
    fraction: float
    strips: tuple[float, ...]


def moment_of(frame: Frame, rho_p: float = RHO_P) -> Moment:
    """Reduce a frame to what the comparison needs."""
    grid = Grid(frame.box, *GRID)
    mass = deposit(grid, frame.x, frame.z).total(frame.mass)
    return Moment(
        frame.time,
        size_summary(frame.diameter, frame.mass),
        float(solids_fraction(mass, grid, rho_p).max()),
        tuple(float(d) for d in strips(frame).diameter),
    )


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
    """

    name: str
    unit: str
    run: float
    targets: tuple[Span | None, ...]
    in_points: bool = False

    def difference(self, source: int) -> float:
        """The run less the source's value (the middle of its span), in % of it or in points; NaN if unknown."""
        span = self.targets[source]
        if span is None or math.isnan(self.run):
            return math.nan
        middle = (span[0] + span[1]) / 2
        return self.run - middle if self.in_points else 100 * (self.run / middle - 1)


@dataclass(frozen=True)
class Comparison:
    """All lines of a case, and the sources' names."""

    case: str
    title: str
    statement: str
    sources: tuple[str, ...]
    lines: tuple[Line, ...]
    verdicts: tuple[str, ...]


def _at(moments: Sequence[Moment], time: float) -> Moment | None:
    return next((m for m in moments if abs(m.time - time) <= 1e-4), None)


def compare(moments: Iterable[Moment], case: str, rows: Sequence[str] = ("paper", "row A")) -> Comparison:
    """Put a run beside the sources.

    Parameters
    ----------
    moments : iterable of Moment
        The run's frames.
    case : str
        ``case1``, ``case2`` or ``case3``.
    rows : sequence of str
        The sources to stand beside it.

    Returns
    -------
    Comparison
    """
    moments = list(moments)
    known = CASES[case]
    sources = [row for row in known.rows if row.name in rows]
    lines: list[Line] = []

    def line(name: str, unit: str, run: float, targets: Iterable[Span | None], in_points: bool = False) -> None:
        lines.append(Line(name, unit, run, tuple(targets), in_points))

    for time in sorted({t for row in sources for t in row.count}):
        moment = _at(moments, time)
        run = math.nan if moment is None else float(moment.sizes.count)
        line(f"clusters at {time:g} s", "", run, (row.count.get(time) for row in sources))
    end = _at(moments, END)
    nothing = math.nan

    def scaled(span: Span | None, factor: float) -> Span | None:
        return None if span is None else (factor * span[0], factor * span[1])

    mean = nothing if end is None else 1e6 * end.sizes.mean
    line(f"mean d at {END:g} s", "µm", mean, (scaled(row.mean, 1e6) for row in sources))
    for i, name in enumerate(CLASS_NAMES):
        share = nothing if end is None else end.sizes.classes[i]
        line(f"{name} µm at {END:g} s", "%", share, (row.classes[i] if row.classes else None for row in sources), True)
    for i, name in ((0, "smallest"), (1, "largest")):
        value = nothing if end is None else 1e6 * (end.sizes.smallest, end.sizes.largest)[i]
        limit = 1e6 * DIAMETER_RANGE[i]
        line(
            f"{name} d at {END:g} s", "µm", value, ((limit, limit) if row.name == "paper" else None for row in sources)
        )
    for time in sorted({t for row in sources for t in row.fraction}):
        moment = _at(moments, time)
        fraction = nothing if moment is None else 100 * PAPER_SCALE * moment.fraction
        line(f"densest cell at {time:g} s*", "%", fraction, (scaled(row.fraction.get(time), 100) for row in sources))
    if case == "case3":
        for i in range(6):
            value = nothing if end is None else 1e6 * end.strips[i]
            name = f"mean d, strip {i + 1} of 6" + (" (centre)" if i == 0 else " (wall)" if i == 5 else "")
            targets = ((1e6 * row.strips[i],) * 2 if row.strips else None for row in sources)
            line(name, "µm", value, targets)
    return Comparison(
        case,
        known.title,
        known.statement,
        tuple(row.name for row in sources),
        tuple(lines),
        tuple(verdicts(moments, known.rows, case)),
    )


def verdicts(moments: Sequence[Moment], rows: Sequence[Row], case: str) -> list[str]:
    """Say plainly what agrees: clusters within 15 %, mean d within 5 %, classes within 5 points, densest cell within 20 %."""
    end = _at(moments, END)
    if end is None:
        return [f"No frame at {END:g} s: the end state cannot be compared."]
    said = []
    for row in rows:
        if row.name not in ("paper", "row A"):
            continue
        tests = []
        for time, span in sorted(row.count.items()):
            if (moment := _at(moments, time)) is not None:
                tests.append((f"clusters at {time:g} s", _apart(moment.sizes.count, span), 15.0, "%"))
        if row.mean is not None:
            tests.append(("mean diameter", _apart(end.sizes.mean, row.mean), 5.0, "%"))
        for name, share, (low, high) in zip(CLASS_NAMES, end.sizes.classes, row.classes):
            apart = share - high if share > high else min(share - low, 0.0)
            tests.append((f"share {name} µm", apart, 5.0, "points"))
        for time, span in sorted(row.fraction.items()):
            if (moment := _at(moments, time)) is not None:
                tests.append((f"densest cell at {time:g} s", _apart(PAPER_SCALE * moment.fraction, span), 20.0, "%"))
        agree = [name for name, apart, limit, _ in tests if abs(apart) <= limit]
        differ = [f"{name} ({apart:+.3g} {unit})" for name, apart, limit, unit in tests if abs(apart) > limit]
        said.append(
            f"{row.name}: agrees in {', '.join(agree) or 'nothing'}; differs in {', '.join(differ) or 'nothing'}."
        )
    if case == "case3":
        d = end.strips
        rises = all(a < b for a, b in zip(d, d[1:]))
        said.append(
            f"Centre to wall the mean diameter {'rises in every strip' if rises else 'does not rise throughout'}: "
            f"{1e6 * d[0]:.0f} to {1e6 * d[-1]:.0f} µm (paper, in words: below 300 in the centre, mostly above 600 at the walls)."
        )
    return said


def _apart(value: float, span: Span) -> float:
    """How far a value lies beyond a span, in % of the span's near end; 0 inside."""
    low, high = span
    return 100 * (value / high - 1 if value > high else min(value / low - 1, 0.0))


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


FOOTNOTE = "* on the 30 x 30 grid and the paper's scale: its printed fractions are ten times the true ones in a slab 3 mm thick."


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

    lines = [f"{comparison.case}: {comparison.title}", "", join(rows[0]), "  ".join("-" * w for w in widths)]
    lines += [join(row) for row in rows[1:]]
    lines += ["", FOOTNOTE, "", *comparison.verdicts]
    return "\n".join(lines) + "\n"
