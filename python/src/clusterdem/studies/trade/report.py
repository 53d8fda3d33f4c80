"""The table of a study as CSV and Markdown."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from ...io.output import write_csv, write_text
from ...observables import find
from ..engine import Engine
from .errors import Error
from .study import Study
from .weigh import Weighed

ROUNDING = 1e-12
"""Errors below this come from sums in another order."""


def percent(value: float) -> str:
    """A share as percent, two significant digits."""
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "∞"
    return f"{100 * value:.2g}" if abs(value) < 0.995 else f"{100 * value:.0f}"


def show(error: Error | None) -> str:
    """An error for the table, bold where one run could show it."""
    if error is None:
        return "n/c"
    text = f"{percent(error.value)} ± {percent(error.uncertainty)}" if error.value > ROUNDING else "0"
    return text if error.inside else f"**{text}**"


def seconds(value: float) -> str:
    """Seconds, three significant digits."""
    return "–" if math.isinf(value) else f"{value:.3g}" if value < 999.5 else f"{value:.0f}"


def write_table(path: Path, weighed: Sequence[Weighed], names: Sequence[str]) -> Path:
    """The whole table as CSV; errors, their uncertainties and spreads as shares of 1."""
    heading = ["number", "axis", "setting", "variables", "core_seconds", "wall", "speedup", "finished", "failed"]
    for name in names:
        heading += [f"{name}_error", f"{name}_uncertainty", f"{name}_spread", f"{name}_inside"]
    rows = []
    for number, w in enumerate(weighed):
        variables = " ".join(f"{name}={value}" for name, value in w.setting.variables.items())
        row: list[object] = [number, w.setting.axis, w.setting.name, variables, w.core_seconds, w.wall]
        row += [weighed[0].core_seconds / w.core_seconds, len(w.costs), len(w.failures)]
        for name in names:
            error = w.errors[name]
            row += ["", "", "", ""] if error is None else [error.value, error.uncertainty, error.spread, error.inside]
        rows.append(row)
    return write_csv(path, heading, rows)


def _markdown_row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def as_markdown(study: Study, engine: Engine, weighed: Sequence[Weighed], answer: str) -> str:
    """The report: what was run, the table, the answer, and the runs that failed."""
    fixed = " ".join(f"{name}={value}" for name, value in study.variables.items()) or "the script's defaults"
    lines = [
        f"# {study.path.stem}: {study.input.name}",
        "",
        f"{engine.version}, {study.ranks} rank{'s' if study.ranks > 1 else ''}, {len(study.seeds)} seeds; all runs with "
        f"{fixed}. Errors in % of the reference (number 0) ± their standard error; **bold**: more than the spread "
        "between single seeds of the reference, which stands in the first row; the rest no single run could show. A setting "
        "keeps a tolerance where its largest error and twice the standard error do. n/c: cannot be compared. Core-seconds: time loop × ranks × CPU use, median over seeds.",
        "",
    ]
    heading = ["", "axis", "setting", "core-s", "faster", *(find(name).label for name in study.observables)]
    lines += [_markdown_row(heading), _markdown_row(["---"] * len(heading))]
    spreads = [weighed[0].errors[name] for name in study.observables]
    lines.append(_markdown_row(["", "", "*spread*", "", "", *(f"*{percent(e.spread)}*" if e else "" for e in spreads)]))
    for number, w in enumerate(weighed):
        name = w.setting.name + (f" ({len(w.failures)} of {len(study.seeds)} runs failed)" if w.failures else "")
        faster = f"{weighed[0].core_seconds / w.core_seconds:.2f}" if w.costs else "–"
        cells = [str(number), w.setting.axis, name, seconds(w.core_seconds), faster]
        lines.append(_markdown_row(cells + [show(w.errors[name]) for name in study.observables]))
    lines += ["", answer] if answer else []
    failures = [failure for w in weighed for failure in w.failures]
    if failures:
        lines += ["", "## Runs that failed", ""]
        lines += ["\n".join(["```", failure.text, "```", ""]) for failure in failures]
    return "\n".join(lines).rstrip() + "\n"


def write_report(path: Path, study: Study, engine: Engine, weighed: Sequence[Weighed], answer: str) -> Path:
    """The report as Markdown."""
    return write_text(path, as_markdown(study, engine, weighed, answer))
