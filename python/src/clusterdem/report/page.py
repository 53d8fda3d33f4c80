"""The report of a run: one self-contained HTML page."""

from __future__ import annotations

import math
from pathlib import Path

from ..analysis.gridded import read_gridded
from ..errors import ArgumentError, InputError
from ..io.output import write_text
from ..io.parallel import over_frames
from ..published.cases import case_of
from ..run import Run
from . import html, sections
from .summary import COLUMNS, Story, how_of, made_by_run, shown_of, summary_of


def write_report(
    run: Run,
    path: str | Path | None = None,
    *,
    shape: tuple[int, int] = (30, 30),
    plane: str = "xz",
    case: str | None = None,
) -> tuple[Path, InputError | ArgumentError | None]:
    """Write the report of a run.

    Parameters
    ----------
    run : Run
        The run; of one without dumps of clusters the maps that it made itself are shown, or its table and log alone.
    path : str or Path, optional
        The page; ``report.html`` in the run's folder by default.
    shape : (int, int)
        Cells along the plane's axes.
    plane : str
        The plane of maps and profiles.
    case : str, optional
        The published case to compare with; by the run's name by default, none if that is no case.

    Returns
    -------
    path : Path
        The page.
    error : InputError, ArgumentError or None
        What ended the reading of frames early; the report then holds those before.

    Raises
    ------
    InputError
        If the first frame cannot be read.
    ArgumentError
        If the density of the primary particles is needed and not known.
    """
    path = Path(path) if path is not None else run.path / "report.html"
    case = case or case_of(run.name)
    if not run.dumps:
        story = Story(run, case, plane, shape)
        try:
            story.made = made_by_run(read_gridded(file, run.density) for file in run.maps)
        except InputError as error:
            story.error = error
        write_text(path, _page(story))
        return path, story.error
    how = how_of(run, case, plane)
    found = over_frames(
        run.dumps, lambda frame: summary_of(frame, shape, how, case is not None), COLUMNS, run.dt, run.density
    )
    if found.root:
        story = Story(run, case, plane, shape, how, found.heads, found.values, found.error)
        story.shown = shown_of(story)
        write_text(path, _page(story))
    return path, found.error


def _page(story: Story) -> str:
    parts = [sections.head(story)]
    timed = bool(story.heads) and not any(math.isnan(head.time) for head in story.heads)
    if story.case is not None and timed:
        parts.append(sections.comparison(story))
    if story.made:
        parts.append(sections.maps_made_by_run(story))
    if story.heads:
        parts += [sections.maps(story), sections.sizes(story)]
    parts += [sections.events(story), sections.needs(story)]
    if story.heads:
        parts += [sections.uniformity(story), sections.profiles(story), sections.ledger(story)]
    parts += [sections.engine(story), sections.scene(story)]
    return html.page(f"Cluster DEM run {story.run.name}", "".join(parts))
