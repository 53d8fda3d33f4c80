"""The report of a run: one self-contained HTML page."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

import numpy as np

from .. import __version__
from ..analysis.correlation import pair_correlation
from ..analysis.grid import PAPER_SCALE, Grid, Maps, maps_of
from ..analysis.ledger import Totals, statements, totals_of
from ..analysis.needs import needs_of
from ..analysis.needs import statements as needs_in_words
from ..analysis.needs import table as needs_table
from ..analysis.nonuniformity import Profile, Uniformity, lateral, measure
from ..analysis.sizes import CLASS_NAMES, fine_edges, histogram
from ..errors import InputError
from ..frame import Floats, Frame
from ..io.enginelog import EngineLog, read_log
from ..io.output import write_text
from ..io.parallel import Gathered, over_frames
from ..io.reader import read_file
from ..io.series import event_rates, read_series
from ..plot.maps import FIELDS, draw_maps, panels_of
from ..plot.scatter import draw_scatter
from ..plot.sizes import draw_histograms, draw_sizes
from ..plot.times import draw_lateral, draw_pair_correlation, draw_phases, draw_series, draw_uniformity
from ..published.compare import FOOTNOTE, Moment, compare, moment_of
from ..published.compare import table as comparison_table
from ..published.numbers import CASES
from ..run import RunFolder
from . import html

COLUMNS = ("id", "y", "vx", "vy", "vz", "n")


@dataclass(frozen=True)
class Summary:
    """What every frame leaves behind."""

    moment: Moment
    totals: Totals
    uniformity: Uniformity


@dataclass(frozen=True)
class Shown:
    """What the frames that are drawn leave behind besides."""

    label: str
    maps: Maps
    profile: Profile
    histogram: tuple[Floats, Floats]
    correlation: tuple[Floats, Floats] | None


def _summary(frame: Frame, shape: tuple[int, int], rho_p: float) -> Summary:
    grid = Grid(frame.box, *shape)
    fraction = maps_of(frame, grid, rho_p=rho_p)["fraction"]
    uniformity = measure(fraction, frame.mass, frame.x, frame.z, grid)
    return Summary(moment_of(frame, rho_p), totals_of(frame), uniformity)


def _reread(head: Frame, dt: float | None) -> Frame:
    return next(frame for frame in read_file(head.path, COLUMNS, dt=dt) if frame.step == head.step)


def write_report(
    run: RunFolder,
    path: str | Path | None = None,
    *,
    shape: tuple[int, int] = (30, 30),
    rho_p: float = 2000.0,
    case: str | None = None,
    dt: float | None = None,
) -> tuple[Path, InputError | None]:
    """Write the report of a run.

    Parameters
    ----------
    run : RunFolder
        The run's files.
    path : str or Path, optional
        The page; ``report.html`` in the run's folder by default.
    shape : (int, int)
        Cells along x and z.
    rho_p : float
        Density of the primary particles (kg/m³).
    case : str, optional
        The published case to compare with; by the run's name by default, none if that is no case.
    dt : float, optional
        Step (s), for dumps that hold no time.

    Returns
    -------
    path : Path
        The page.
    error : InputError or None
        What ended the reading of frames early; the report then holds those before.
    """
    path = Path(path) if path is not None else run.path / "report.html"
    case = case or (run.name if run.name in CASES else None)
    found = over_frames(run.dumps, lambda frame: _summary(frame, shape, rho_p), COLUMNS, dt)
    if found.root:
        write_text(path, _page(run, found, shape, rho_p, case, dt))
    return path, found.error


def _page(
    run: RunFolder,
    found: Gathered[Summary],
    shape: tuple[int, int],
    rho_p: float,
    case: str | None,
    dt: float | None,
) -> str:
    heads, grid = found.heads, Grid(found.heads[0].box, *shape)
    log = read_log(run.log) if run.log else EngineLog()
    shown: list[Shown] = []
    last: Frame | None = None
    chosen = panels_of(len(heads))
    for i in chosen:
        last = _reread(heads[i], dt)
        correlation = pair_correlation(last) if i in (chosen[0], chosen[len(chosen) // 2], chosen[-1]) else None
        bins = histogram(last.diameter, last.mass, fine_edges())
        shown.append(
            Shown(last.label, maps_of(last, grid, rho_p=rho_p), lateral(last, shape[0], rho_p), bins, correlation)
        )
    assert last is not None
    parts = [_head(run, found, case, log)]
    if case is not None and not any(math.isnan(head.time) for head in heads):
        parts.append(_comparison(found.values, case))
    parts += [_maps(shown, grid), _sizes(found, shown, last), _events(run), _needs(run), _uniformity(found, shown)]
    parts += [_ledger(run, found), _engine(log), _scene(run, log)]
    return html.page(f"Cluster DEM run {run.name}", "".join(parts))


def _head(run: RunFolder, found: Gathered[Summary], case: str | None, log: EngineLog) -> str:
    first, last = found.values[0].moment, found.values[-1].moment
    head = found.heads[-1]
    about = CASES[case].title if case else f"{len(found.heads)} frames"
    numbers = [
        ("clusters at the start", f"{first.sizes.count:,}"),
        ("clusters at the end", f"{last.sizes.count:,}"),
        ("end of the run", head.label),
        ("mean diameter at the end", f"{1e6 * last.sizes.mean:.1f} µm"),
        ("Sauter diameter at the end", f"{1e6 * last.sizes.sauter:.1f} µm"),
        ("smallest, largest at the end", f"{1e6 * last.sizes.smallest:.1f}, {1e6 * last.sizes.largest:.1f} µm"),
        ("densest cell, true", f"{100 * found.values[-1].uniformity.largest:.3f} %"),
        ("densest cell, paper's scale", f"{100 * PAPER_SCALE * found.values[-1].uniformity.largest:.2f} %"),
    ]
    if log.loop:
        numbers.append(("time in the loop", f"{log.loop:.0f} s on {log.ranks} rank{'s' if log.ranks != 1 else ''}"))
    text = f"<h1>Run {escape(run.name)}</h1>\n" + html.paragraph(about, "lead") + html.facts(numbers)
    if found.error is not None:
        text += html.paragraph(
            f"Not all frames could be read; those before are shown. {Path(found.error.path).name}: {found.error.rule}"
        )
    return text


def _comparison(values: Sequence[Summary], case: str) -> str:
    result = compare([value.moment for value in values], case)
    return (
        "<h2>Beside the published numbers</h2>\n"
        + html.bullets(result.verdicts)
        + html.table(comparison_table(result))
        + html.paragraph(
            "paper: the published values. row A: an independent prototype of the same reading, span over seeds; "
            "differences are to the middle of a span, of shares in points (pt).",
            "note",
        )
        + html.paragraph(FOOTNOTE, "note")
        + html.paragraph(f"What the paper says in words: {result.statement}", "note")
    )


def _maps(shown: Sequence[Shown], grid: Grid) -> str:
    labels = [s.label for s in shown]
    text = "<h2>Where the solids are</h2>\n"
    captions = {
        "fraction": f"Solids volume fraction on {grid.nx} x {grid.nz} cells, one colour scale for all panels. "
        "Left ticks: the true fraction; right ticks: the paper's scale, ten times that.",
        "mean_diameter": "Mean cluster diameter by number in each cell.",
        "velocity_z": "Mass-weighted vertical velocity of the solids. Triangles on the bar: rare cells lie beyond.",
        "temperature": "Granular temperature of the motion in the plane, <(v − <v>)²>/2 in each cell.",
    }
    for field in FIELDS:
        if field.name in captions and all(field.name in s.maps for s in shown):
            figure = draw_maps([s.maps[field.name] for s in shown], labels, grid, field)
            text += html.picture(figure, captions[field.name])
    return text


def _table_by_frame(found: Gathered[Summary], names: Sequence[str], cells: Callable[[Summary], Sequence[str]]) -> str:
    """A row for each of at most 12 frames: its label, then what `cells` makes of it."""
    shown = panels_of(len(found.values), 12)
    rows = [[found.heads[i].label, *cells(found.values[i])] for i in shown]
    return html.table([["frame", *names], *rows])


def _sizes(found: Gathered[Summary], shown: Sequence[Shown], last: Frame) -> str:
    sizes = [value.moment.sizes for value in found.values]
    times = np.array([head.time for head in found.heads])
    steps = np.array([head.step for head in found.heads])

    def cells(summary: Summary) -> list[str]:
        size = summary.moment.sizes
        means = [f"{1e6 * d:.1f}" for d in (size.mean, size.sauter, size.mass_mean, size.smallest, size.largest)]
        return [f"{size.count:,}", *means, *(f"{c:.2f}" for c in size.classes)]

    names = ["clusters", "mean", "Sauter", "mean by mass", "smallest", "largest", *(f"{c} (%)" for c in CLASS_NAMES)]
    return (
        "<h2>Sizes</h2>\n"
        + html.picture(
            draw_sizes(times, steps, sizes),
            "Number of clusters, mean diameters, and the paper's four size classes by number.",
        )
        + html.picture(
            draw_histograms(fine_edges(), [s.histogram for s in shown], [s.label for s in shown]),
            "Size distribution by number and by mass in bins of 50 µm; dotted lines: borders of the four classes.",
        )
        + _table_by_frame(found, names, cells)
        + html.paragraph("Diameters in µm; shares in percent of clusters by number.", "note")
        + html.picture(
            draw_scatter(last),
            "The clusters of the last frame as discs of their true size; right: the framed window.",
            "medium",
        )
    )


def _events(run: RunFolder) -> str:
    if run.series is None:
        return ""
    series = read_series(run.series)
    if not {"time", "clusters"} <= set(series) or len(series["time"]) < 2:
        return ""
    caption = "The engine's own count of clusters, and the rates of breakups and merges between its reports."
    text = "<h2>Events</h2>\n" + html.picture(draw_series(series, event_rates(series)), caption)
    totals = [
        (name, f"{series[name][-1]:,.0f}") for name in ("breakups", "merges", "born", "deferred") if name in series
    ]
    return text + (html.facts(totals) if totals else "")


def _needs(run: RunFolder) -> str:
    needs = needs_of(read_series(run.series)) if run.series is not None else None
    if needs is None:
        return ""
    note = (
        "A term decided an event that the same test would have refused without it, at that instant. What a term costs, and "
        "whether the results stay without it, is measured by running without: clusterdem trade."
    )
    return (
        "<h2>What this scene needs</h2>\n"
        + html.bullets(needs_in_words(needs))
        + html.table(needs_table(needs))
        + html.paragraph(note, "note")
    )


def _uniformity(found: Gathered[Summary], shown: Sequence[Shown]) -> str:
    times = np.array([head.time for head in found.heads])
    steps = np.array([head.step for head in found.heads])
    values = [value.uniformity for value in found.values]

    def cells(summary: Summary) -> list[str]:
        u = summary.uniformity
        percent = [f"{100 * v:.4f}" for v in (u.largest, u.smallest, u.mean, u.deviation, u.poisson)]
        return [*percent, f"{u.dispersion:.3f}", f"{u.number_dispersion:.3f}", f"{100 * u.dense_share:.2f}"]

    names = ["largest (%)", "smallest (%)", "mean (%)", "deviation (%)", "by chance (%)"]
    names += ["dispersion", "by number", "dense share (%)"]
    last = values[-1]
    side = (
        "more uneven than" if last.dispersion > 1.1 else "more even than" if last.dispersion < 0.9 else "as uneven as"
    )
    curves = [(s.correlation, s.label) for s in shown if s.correlation is not None]
    return (
        "<h2>How evenly they lie</h2>\n"
        + html.paragraph(
            f"At the end the cells are {side} the clusters of that moment thrown at random would make them: index of "
            f"dispersion {last.dispersion:.2f} (1 is chance). Fragments that still lie beside their siblings count as uneven. "
            f"The deviation of the cell fractions itself went from {100 * values[0].deviation:.4f} % to {100 * last.deviation:.4f} %."
        )
        + html.picture(
            draw_uniformity(times, steps, values),
            "Extreme cells; index of dispersion (variance of the cells over that of the same clusters thrown at random); "
            "share of mass in cells above twice the mean.",
        )
        + html.picture(draw_lateral([s.profile for s in shown], [s.label for s in shown]), "Profiles across the width.")
        + html.picture(
            draw_pair_correlation([c for c, _ in curves], [label for _, label in curves]),
            "Cluster–cluster g(r) in the plane with the periodic box (MDAnalysis InterRDF); 1 is chance.",
            "small",
        )
        + _table_by_frame(found, names, cells)
        + html.paragraph("Fractions are true ones; ten times as large on the paper's scale.", "note")
    )


def _ledger(run: RunFolder, found: Gathered[Summary]) -> str:
    totals = [value.totals for value in found.values]

    def cells(summary: Summary) -> list[str]:
        t = summary.totals
        particles = "-" if t.particles is None else f"{t.particles:,}"
        change = f"{t.mass / totals[0].mass - 1:+.1e}"
        motion = [f"{value:.5g}" for value in (t.momentum_x, t.momentum_z, t.kinetic)]
        return [f"{t.clusters:,}", particles, f"{t.mass:.9g}", change, *motion]

    names = ["clusters", "particles", "mass (kg)", "change of mass"]
    names += ["momentum x (kg m/s)", "momentum z (kg m/s)", "kinetic energy (J)"]
    said = statements(totals)
    if run.series is not None:
        series = read_series(run.series)
        if "particles" in series:
            low, high = int(series["particles"].min()), int(series["particles"].max())
            said.append(
                f"The engine's own count of particles: {low:,}"
                + (" throughout." if low == high else f" to {high:,} (NOT conserved).")
            )
        if "E_merge" in series:
            said.append(f"Kinetic energy lost in merges: {series['E_merge'][-1]:.4g} J.")
        if "E_birth" in series:
            energy, kinetic = series["E_birth"][-1], totals[-1].kinetic
            said.append(
                f"Elastic energy put in by births: {energy:.4g} J ({abs(energy) / kinetic:.1e} of the kinetic energy at the end)."
            )
    note = "Gas and gravity change momentum and kinetic energy; mass and particles must stay."
    return (
        "<h2>Conservation ledger</h2>\n"
        + html.bullets(said)
        + _table_by_frame(found, names, cells)
        + html.paragraph(note, "note")
    )


def _engine(log: EngineLog) -> str:
    if not log.phases:
        return ""
    total = sum(log.phases.values())
    rows = [["phase", "time (s)", "share (%)"]]
    rows += [
        [name, f"{t:.2f}", f"{100 * t / total:.1f}"]
        for name, t in sorted(log.phases.items(), key=lambda item: -item[1])
    ]
    text = "<h2>Engine time</h2>\n" + html.picture(draw_phases(log.phases), "Time of the engine by phase.", "small")
    text += html.table(rows)
    text += html.paragraph(
        f"{log.steps:,} steps, {log.loop:.1f} s in the loop, {log.ranks} ranks, wall time {log.wall or 'unknown'}.",
        "note",
    )
    return text


def _scene(run: RunFolder, log: EngineLog) -> str:
    rows = [["what", "value"], ["engine", log.version or "unknown"], ["post-processor", f"clusterdem {__version__}"]]
    if run.series is not None:
        with open(run.series, encoding="utf-8", errors="replace") as file:
            first = file.readline()
        if first.startswith("#"):
            rows.append(["settings", first[1:].strip()])
    if "seed" in log.variables:
        rows.append(["seed", log.variables["seed"]])
    if run.command is not None:
        rows.append(["command", run.command.read_text(encoding="utf-8", errors="replace").strip()])
    text = "<h2>Scene</h2>\n" + html.table(rows)
    if log.warnings:
        text += html.paragraph("Warnings of the engine:") + html.bullets(dict.fromkeys(log.warnings))
    if log.script:
        text += html.paragraph("The input, as the engine echoed it:") + html.preformatted("\n".join(log.script))
    return text
