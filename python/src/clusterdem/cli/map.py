"""Maps of solids on a grid: data (.npz, .csv) of every frame and figures over time.

Writes to DIR for each frame map.STEP.npz and map.STEP.csv, for all frames nonuniformity.csv and, as PNG, one
figure per kind of map. A cell's solids fraction is the volume of the primary particles in it over its own, through the
whole depth of the box; for the paper's cases the paper's printed scale, ten times that, stands beside it.

Maps that the engine made while it ran (-var maps yes, *.maps) are taken as they are: their grid is their own, and
there is no nonuniformity.csv.
"""

from __future__ import annotations

import argparse
from dataclasses import astuple, fields
from pathlib import Path

import numpy as np

from ..analysis.grid import Grid, Maps, check_resolution, maps_of
from ..analysis.gridded import is_gridded, read_gridded
from ..analysis.nonuniformity import Uniformity, measure
from ..errors import InputError
from ..frame import Frame
from ..io.output import write_csv, write_npz
from ..io.parallel import over_frames
from ..io.reader import check_same_box, is_later, natural_order
from ..plot.maps import draw_maps, fields_of, panels_of
from ..plot.style import save
from ..published.cases import SCALE
from .common import (
    add_density,
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
    add_density(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("maps"), metavar="DIR", help="folder for the results (default maps)"
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def write_frame(frame: Frame, grid: Grid, maps: Maps, stem: Path, scale: float | None) -> tuple[Path, Path]:
    """Write one frame's maps as .npz and, a row per cell, as .csv."""
    if scale is not None:
        maps = maps | {"fraction_paper": scale * maps["fraction"]}
    box = np.array([grid.box.lo, grid.box.hi])
    edges = {f"{axis}_edges": borders for axis, borders in zip(grid.plane, grid.edges)}
    words = np.array(particles_of(frame) or "")
    npz = write_npz(
        stem.with_name(stem.name + ".npz"),
        {"step": frame.step, "time": frame.time, "box": box, "particles": words, **edges, **maps},
    )
    place = np.meshgrid(*((borders[:-1] + borders[1:]) / 2 for borders in grid.edges), indexing="ij")
    rows = zip(*(values.ravel().tolist() for values in (*place, *maps.values())))
    return npz, write_csv(stem.with_name(stem.name + ".csv"), [*grid.plane, *maps], rows)


def run(options: argparse.Namespace) -> None:
    out: Path = options.out
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
    finish(found)


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
