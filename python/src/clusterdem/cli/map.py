"""Maps of solids on a grid: data (.npz, .csv) of every frame and figures over time.

Writes to DIR for each frame map.STEP.npz and map.STEP.csv, for all frames nonuniformity.csv and, as PNG, one
figure per kind of map. A cell's solids fraction is the volume of the primary particles in it over its own, through the
whole depth of the box; for the paper's cases the paper's printed scale, ten times that, stands beside it.

Maps that the engine made while it ran (-var maps yes, *.maps) are taken as they are: their grid is their own, and
there is no nonuniformity.csv.

With --average BLOCKS also the average over the frames, average.npz and average.csv, each map with its standard error
(NAME_error) from so many blocks of frames in a row, and figures of both. Velocities and temperatures count by mass,
diameters by number of clusters, the rest frame by frame.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..analysis.averages import average_of
from ..analysis.grid import WEIGHTS, Grid, Maps, check_resolution, maps_of
from ..analysis.gridded import is_gridded, read_gridded
from ..analysis.nonuniformity import Uniformity, measure
from ..errors import InputError
from ..frame import Floats, Frame
from ..io.output import write_csv, write_npz
from ..io.parallel import over_frames
from ..io.reader import check_same_box, is_later, natural_order
from ..plot.maps import draw_maps, error_of, fields_of, panels_of
from ..plot.style import save
from ..published.cases import SCALE
from .averages import add_average, averaged, check_average, columns_of, label_of
from .common import (
    add_dumps,
    add_grid,
    columns_for,
    finish,
    grid_for,
    paper_case,
    particles_of,
    say_particles,
    tell,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_grid(parser)
    add_average(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("maps"), metavar="DIR", help="folder for the results (default maps)"
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def write_frame(frame: Frame, grid: Grid, maps: Maps, stem: Path, scale: float | None) -> tuple[Path, Path]:
    """Write one frame's maps as .npz and, a row per cell, as .csv."""
    if scale is not None:
        maps = maps | {"fraction_paper": scale * maps["fraction"]}
    words = np.array(particles_of(frame) or "")
    return _write(stem, {"step": frame.step, "time": frame.time}, words, grid, maps)


def _edges(grid: Grid) -> dict[str, Floats]:
    return {f"{axis}_edges": borders for axis, borders in zip(grid.plane, grid.edges)}


def _write(stem: Path, when: Mapping[str, Any], words: NDArray[np.str_], grid: Grid, maps: Maps) -> tuple[Path, Path]:
    box = np.array([grid.box.lo, grid.box.hi])
    npz = write_npz(
        stem.with_name(stem.name + ".npz"), {**when, "box": box, "particles": words, **_edges(grid), **maps}
    )
    place = np.meshgrid(*((borders[:-1] + borders[1:]) / 2 for borders in grid.edges), indexing="ij")
    rows = zip(*(values.ravel().tolist() for values in (*place, *maps.values())))
    return npz, write_csv(stem.with_name(stem.name + ".csv"), [*grid.plane, *maps], rows)


def run(options: argparse.Namespace) -> None:
    out: Path = options.out
    check_average(options)
    scale = SCALE if paper_case(options.dumps) else None
    columns = columns_for(options.plane)
    if is_gridded(options.dumps[0]):
        _run_gridded(options, scale)
        return

    def work(frame: Frame) -> tuple[str, Uniformity, str | None]:
        grid = grid_for(options, frame)
        check_resolution(frame, grid)
        maps = maps_of(frame, grid, options.deposit)
        stem = out / f"map.{frame.step:010d}"
        write_frame(frame, grid, maps, stem, scale)
        return stem.name, measure(maps["fraction"], frame, grid, options.deposit), particles_of(frame)

    found = over_frames(options.dumps, work, columns, options.dt, options.rho, "maps need")
    if found.root and found.heads:
        names = [field.name for field in fields(Uniformity)]
        rows = [(head.step, head.time, *astuple(value[1])) for head, value in zip(found.heads, found.values)]
        words = say_particles(value[2] for value in found.values)
        for name, _, _ in found.values:
            tell(out / f"{name}.npz", out / f"{name}.csv")
        tell(write_csv(out / "nonuniformity.csv", ["step", "time", *names], rows))
        if not options.no_figures:
            grid = grid_for(options, found.heads[0])
            tell(*_figures(out, [value[0] for value in found.values], found.heads, grid, scale, words))
        if options.average is not None:
            grid = grid_for(options, found.heads[0])
            tell(*_average(options, [value[0] for value in found.values], found.heads, grid, scale, words))
    finish(found)


def _average(
    options: argparse.Namespace, names: list[str], heads: list[Frame], grid: Grid, scale: float | None, words: str
) -> list[Path]:
    """Write and draw the average of the maps that the frames' files hold."""
    out: Path = options.out
    chosen = averaged(options, heads)
    over = [heads[number] for number in chosen]
    files = [out / f"{names[number]}.npz" for number in chosen]

    def frames() -> Iterator[Maps]:
        for file in files:
            with np.load(file) as data:
                yield {name: data[name] for name in data.files if name not in facts}

    facts = {"step", "time", "box", "particles", *_edges(grid)}
    found = average_of(frames(), len(over), options.average, WEIGHTS)
    when = {"step": [head.step for head in over], "time": [head.time for head in over], "blocks": options.average}
    written = list(_write(out / "average", when, np.array(words), grid, columns_of(found)))
    if not options.no_figures:
        for field in fields_of(grid.plane):
            if field.name in found:
                one, label = found[field.name], [label_of(over)]
                figure = draw_maps([one.mean], label, grid, field, scale, words)
                written.append(save(figure, out / f"average_{field.name}.png"))
                figure = draw_maps([one.error], label, grid, error_of(field), words=words)
                written.append(save(figure, out / f"error_{field.name}.png"))
    return written


def _run_gridded(options: argparse.Namespace, scale: float | None) -> None:
    names: list[str] = []
    heads: list[Frame] = []
    grid: Grid | None = None
    words, error = "", None
    try:
        for path in natural_order(options.dumps):
            for head, its_grid, maps in read_gridded(path, options.rho):
                if heads and not is_later(heads[-1], head):
                    continue
                if heads:
                    check_same_box(heads[-1], head, "maps need")
                else:
                    words = say_particles([head.primary.words if head.primary else None])
                if grid is not None and grid.shape != its_grid.shape:
                    raise InputError(path, f"the grid differs from that of {heads[-1].path}", head.line)
                grid = its_grid
                heads.append(head)
                names.append(f"map.{head.step:010d}")
                tell(*write_frame(head, grid, maps, options.out / names[-1], scale))
    except InputError as broken:
        error = broken
    if grid is not None and not options.no_figures:
        tell(*_figures(options.out, names, heads, grid, scale, words))
    if grid is not None and options.average is not None:
        tell(*_average(options, names, heads, grid, scale, words))
    if error is not None:
        raise error


def _figures(
    out: Path, names: list[str], heads: list[Frame], grid: Grid, scale: float | None, words: str
) -> list[Path]:
    chosen = panels_of(len(heads))
    labels = [heads[i].label for i in chosen]
    data = [np.load(out / f"{names[i]}.npz") for i in chosen]
    written = []
    for field in fields_of(grid.plane):
        if all(field.name in maps for maps in data):
            figure = draw_maps([maps[field.name] for maps in data], labels, grid, field, scale, words)
            written.append(save(figure, out / f"{field.name}.png"))
    return written
