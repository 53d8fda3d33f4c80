"""The sections of a report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

import numpy as np

from .. import __version__
from ..analysis.grid import Grid, Maps
from ..analysis.ledger import Flow, judge_particles, statements
from ..analysis.needs import needs_of
from ..analysis.needs import statements as needs_in_words
from ..analysis.needs import table as needs_table
from ..analysis.sizes import class_names
from ..errors import InputError
from ..io.series import event_rates
from ..plot.maps import draw_maps, fields_of, panels_of
from ..plot.scatter import draw_scatter
from ..plot.sizes import draw_histograms, draw_sizes
from ..plot.style import counted
from ..plot.times import draw_pair_correlation, draw_phases, draw_profiles, draw_series, draw_uniformity
from ..published.cases import CASES
from ..published.compare import FOOTNOTE, RULE, compare
from ..published.compare import table as comparison_table
from . import html
from .summary import Story, Summary


def head(story: Story) -> str:
    """The run's name and its key figures."""
    about = CASES[story.case].title if story.case else counted(len(story.heads) or len(story.made), "frame")
    numbers: list[tuple[str, str]] = []
    if story.heads:
        last = story.values[-1]
        numbers = [
            ("clusters at the start", f"{story.values[0].sizes['count']:,.0f}"),
            ("clusters at the end", f"{last.sizes['count']:,.0f}"),
            ("end of the run", story.heads[-1].label),
        ]
        if last.sizes["count"]:
            numbers += [
                ("mean diameter at the end", f"{1e6 * last.sizes['mean_diameter']:.1f} µm"),
                ("Sauter diameter at the end", f"{1e6 * last.sizes['sauter_diameter']:.1f} µm"),
                (
                    "smallest, largest at the end",
                    f"{1e6 * last.sizes['smallest_diameter']:.1f}, {1e6 * last.sizes['largest_diameter']:.1f} µm",
                ),
            ]
        numbers.append(("densest cell, true", f"{100 * last.uniformity.largest:.3f} %"))
        if story.scale:
            numbers.append(("densest cell, paper's scale", f"{100 * story.scale * last.uniformity.largest:.2f} %"))
    log = story.run.log
    if log.loop:
        numbers.append(("time in the loop", f"{log.loop:.0f} s on {log.ranks} rank{'s' if log.ranks != 1 else ''}"))
    text = f"<h1>Run {escape(story.run.name)}</h1>\n" + html.paragraph(about, "lead") + html.facts(numbers)
    if story.particles:
        text += html.paragraph(f"Solids fractions with {story.particles}.", "note")
    if story.error is not None:
        where = f"{Path(story.error.path).name}: " if isinstance(story.error, InputError) else ""
        text += html.paragraph(f"Not all frames could be read; those before are shown. {where}{story.error.rule}")
    return text


def comparison(story: Story) -> str:
    """The run beside the published numbers."""
    assert story.case is not None
    result = compare([value.moment for value in story.values if value.moment], story.case)
    return (
        "<h2>Beside the published numbers</h2>\n"
        + html.bullets([*result.notes, *result.verdicts])
        + html.table(comparison_table(result))
        + html.paragraph(
            "paper: the published values. row A: an independent prototype of the same reading, span over seeds; "
            "differences are to the middle of a span, of shares in points (pt).",
            "note",
        )
        + html.paragraph(RULE, "note")
        + html.paragraph(FOOTNOTE, "note")
        + html.paragraph(f"What the paper says in words: {result.statement}", "note")
    )


def _captions(story: Story, grid: Grid) -> dict[str, str]:
    beside = f" Right ticks: the paper's scale, {story.scale:g} times that." if story.scale else ""
    return {
        "fraction": f"Solids volume fraction on {grid.nx} x {grid.nz} cells, one colour scale for all panels.{beside}",
        "mean_diameter": "Mean cluster diameter by number in each cell.",
        f"velocity_{grid.plane[1]}": "Mass-weighted velocity of the solids along "
        f"{grid.plane[1]}. Triangles on the bar: rare cells lie beyond.",
        "temperature": "Granular temperature of the motion in the plane, <(v − <v>)²>/2 about each cell's own mean: of n "
        "clusters (n − 1)/n of what more of them would show.",
    }


def _panels(story: Story, maps: Sequence[Maps], labels: Sequence[str], grid: Grid) -> str:
    text, captions = "", _captions(story, grid)
    for field in fields_of(grid.plane):
        if field.name in captions and all(field.name in one for one in maps):
            figure = draw_maps([one[field.name] for one in maps], labels, grid, field, story.scale, story.particles)
            text += html.picture(figure, captions[field.name])
    return text


def maps(story: Story) -> str:
    """Where the solids are."""
    title = "<h2>Where the solids are</h2>\n"
    if not story.one_box:
        return title + html.paragraph("The box changes from frame to frame: maps need one box, and are left out.")
    return title + _panels(story, [s.maps for s in story.shown], [s.label for s in story.shown], story.grid)


def maps_made_by_run(story: Story) -> str:
    """The same, of maps that the run made itself."""
    note = "Maps that the run made itself; it wrote no clusters."
    panels = _panels(story, [one for _, _, one in story.made], [frame.label for frame, _, _ in story.made], story.grid)
    return "<h2>Where the solids are</h2>\n" + html.paragraph(note, "note") + panels


def _table_by_frame(story: Story, names: Sequence[str], cells: Callable[[int, Summary], Sequence[str]]) -> str:
    """A row for each of at most 12 frames: its label, then what `cells` makes of its number and summary."""
    shown = panels_of(len(story.values), 12)
    rows = [[story.heads[i].label, *cells(i, story.values[i])] for i in shown]
    return html.table([["frame", *names], *rows])


def _figure(value: float, form: str) -> str:
    return "-" if np.isnan(value) else format(value, form)


def sizes(story: Story) -> str:
    """Number of clusters, diameters, classes."""
    classes = class_names(story.how.borders)
    diameters = ("mean_diameter", "sauter_diameter", "mass_mean_diameter", "smallest_diameter", "largest_diameter")

    def cells(number: int, summary: Summary) -> list[str]:
        return [
            f"{summary.sizes['count']:,.0f}",
            *(_figure(1e6 * summary.sizes[name], ".1f") for name in diameters),
            *(_figure(float(share), ".2f") for share in summary.classes),
        ]

    drawn = {name: np.array([[v.sizes[name]] for v in story.values]) for name in ("count", *diameters)}
    drawn["size_classes"] = np.stack([v.classes for v in story.values])
    names = ["clusters", "mean", "Sauter", "mean by mass", "smallest", "largest", *(f"{name} (%)" for name in classes)]
    return (
        "<h2>Sizes</h2>\n"
        + html.picture(
            draw_sizes(story.times, story.steps, drawn, classes),
            "Number of clusters, mean diameters, size classes by number.",
        )
        + html.picture(
            draw_histograms(
                story.edges, [s.histogram for s in story.shown], [s.label for s in story.shown], story.how.borders
            ),
            f"Size distribution by number and by mass in bins of {1e6 * story.edges[1]:.3g} µm; dotted: borders of the classes.",
        )
        + _table_by_frame(story, names, cells)
        + html.paragraph("Diameters in µm; shares in percent of clusters by number.", "note")
        + html.picture(
            draw_scatter(story.shown[-1].frame, plane=story.plane),
            "The clusters of the last frame as discs of their true size; right: the framed window.",
            "medium",
        )
    )


def events(story: Story) -> str:
    """The engine's own count of clusters, and the rates of its events."""
    series = story.run.series
    if series is None or not {"time", "clusters"} <= set(series) or len(series["time"]) < 2:
        return ""
    caption = "The engine's own count of clusters, and the rates of breakups and merges between its reports."
    text = "<h2>Events</h2>\n" + html.picture(draw_series(series, event_rates(series)), caption)
    totals = [
        (name, f"{series[name][-1]:,.0f}") for name in ("breakups", "merges", "born", "deferred") if name in series
    ]
    return text + (html.facts(totals) if totals else "")


def needs(story: Story) -> str:
    """Which terms decided."""
    found = needs_of(story.run.series) if story.run.series is not None else None
    if found is None:
        return ""
    note = (
        "A term decided an event that the same test would have refused without it, at that instant. What a term costs, and "
        "whether the results stay without it, is measured by running without: clusterdem trade."
    )
    return (
        "<h2>What this scene needs</h2>\n"
        + html.bullets(needs_in_words(found))
        + html.table(needs_table(found))
        + html.paragraph(note, "note")
    )


def uniformity(story: Story) -> str:
    """Cell statistics against chance."""
    title = "<h2>How evenly they lie</h2>\n"
    if not story.one_box:
        return title + html.paragraph("The box changes from frame to frame: its cells are not those of another frame.")
    values = [value.uniformity for value in story.values]

    def cells(number: int, summary: Summary) -> list[str]:
        u = summary.uniformity
        percent = [_figure(100 * v, ".4f") for v in (u.largest, u.smallest, u.mean, u.deviation, u.poisson)]
        others = [_figure(v, ".3f") for v in (u.dispersion, u.number_dispersion)]
        return [*percent, *others, _figure(100 * u.dense_share, ".2f")]

    names = ["largest (%)", "smallest (%)", "mean (%)", "deviation (%)", "by chance (%)"]
    names += ["dispersion", "by number", "dense share (%)"]
    last = values[-1]
    side = (
        "more uneven than" if last.dispersion > 1.1 else "more even than" if last.dispersion < 0.9 else "as uneven as"
    )
    said = (
        "No clusters at the end."
        if np.isnan(last.dispersion)
        else f"At the end the cells are {side} the clusters of that moment thrown at random would make them: index of "
        f"dispersion {last.dispersion:.2f} (1 is chance). Fragments that still lie beside their siblings count as uneven. "
        f"The deviation of the cell fractions itself went from {100 * values[0].deviation:.4f} % to {100 * last.deviation:.4f} %."
    )
    beside = f" Fractions are true ones; {story.scale:g} times as large on the paper's scale." if story.scale else ""
    return (
        title
        + html.paragraph(said)
        + html.picture(
            draw_uniformity(story.times, story.steps, values, story.scale),
            "Extreme cells; index of dispersion (variance of the cells over that of the same clusters thrown at random); "
            "share of solids in cells above twice the mean.",
        )
        + _table_by_frame(story, names, cells)
        + html.paragraph(f"Fractions with {story.particles}.{beside}" if story.particles else "", "note")
    )


def profiles(story: Story) -> str:
    """Profiles across the width, and g(r)."""
    curves = [(s.correlation, s.label) for s in story.shown if s.correlation is not None]
    text = "<h2>Profiles</h2>\n" + html.picture(
        draw_profiles([s.profile for s in story.shown], [s.label for s in story.shown]), "Profiles across the width."
    )
    if curves:
        text += html.picture(
            draw_pair_correlation([c for c, _ in curves], [label for _, label in curves]),
            "Cluster–cluster g(r) across the sides that repeat; 1 is chance.",
            "small",
        )
    return text


def ledger(story: Story) -> str:
    """What must be conserved."""
    totals, flows, series = [value.totals for value in story.values], story.flows, story.run.series

    def cells(number: int, summary: Summary) -> list[str]:
        t, flow = summary.totals, flows[number]
        particles = "-" if t.particles is None else f"{t.particles:,}"
        moved = ["-", "-"] if flow is None else [f"{flow.fed:,}", f"{flow.left:,}"]
        motion = [_figure(value, ".5g") for value in (t.momentum_x, t.momentum_z, t.kinetic)]
        return [f"{t.clusters:,}", particles, *moved, f"{t.mass:.9g}", *motion]

    names = ["clusters", "particles", "fed", "left", "mass (kg)"]
    names += ["momentum x (kg m/s)", "momentum z (kg m/s)", "kinetic energy (J)"]
    said = statements(totals, flows)
    if series is not None:
        if "particles" in series:
            fed, left = (series.get(name, np.zeros(len(series["particles"]))) for name in ("fed", "left"))
            own = [Flow(int(f), int(le)) for f, le in zip(fed, left)]
            said.append(f"The engine's own count. {judge_particles([int(n) for n in series['particles']], own)}")
        if "E_merge" in series:
            said.append(f"Kinetic energy lost in merges: {series['E_merge'][-1]:.4g} J.")
        if "E_birth" in series:
            energy, kinetic = series["E_birth"][-1], totals[-1].kinetic
            share = f" ({abs(energy) / kinetic:.1e} of the kinetic energy at the end)" if kinetic > 0 else ""
            said.append(f"Elastic energy put in by births: {energy:.4g} J{share}.")
    note = "Gas and gravity change momentum and kinetic energy; particles and their mass stay, but for what is fed and leaves."
    return (
        "<h2>Conservation ledger</h2>\n"
        + html.bullets(said)
        + _table_by_frame(story, names, cells)
        + html.paragraph(note, "note")
    )


def engine(story: Story) -> str:
    """The engine's time by phase."""
    log = story.run.log
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


def scene(story: Story) -> str:
    """What ran: engine, settings, seed, command, input."""
    run, log = story.run, story.run.log
    rows = [["what", "value"], ["engine", log.version or "unknown"], ["post-processor", f"clusterdem {__version__}"]]
    if run.title:
        rows.append(["settings", run.title])
    if run.seed is not None:
        rows.append(["seed", run.seed])
    if run.primary is not None:
        rows.append(["primary particles", run.primary.words.removeprefix("primary particles of ")])
    if run.time_step is not None:
        low, high = (f"{value:.3g}" for value in run.time_step)
        rows.append(["time step", f"{low} s" if low == high else f"{low} to {high} s"])
    if log.loop:
        use = log.core_seconds / (log.loop * log.ranks)
        about = f"{log.loop:.3g} s in the loop × {log.ranks} rank{'s' if log.ranks != 1 else ''} × {use:.0%} CPU use"
        rows.append(["core-seconds", f"{log.core_seconds:.3g} ({about})"])
    if run.command is not None:
        rows.append(["command", run.command])
    text = "<h2>Scene</h2>\n" + html.table(rows)
    if log.warnings:
        text += html.paragraph("Warnings of the engine:") + html.bullets(dict.fromkeys(log.warnings))
    if log.script:
        text += html.paragraph("The input, as the engine echoed it:") + html.preformatted("\n".join(log.script))
    return text
