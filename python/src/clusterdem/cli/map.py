"""Maps of solids on an x–z grid: data (.npz, .csv) of every frame and figures over time.

Writes to DIR for each frame map.STEP.npz and map.STEP.csv, for all frames nonuniformity.csv and, as PNG, one
figure per kind of map. A cell's true solids fraction is mass / (rho · dx · dz · thickness in y); the paper's printed
scale, ten times that, stands beside it.

Maps that the engine made while it ran (-var maps yes, *.maps) are taken as they are: their grid is their own, and
there is no nonuniformity.csv.
"""

from __future__ import annotations

import argparse
from dataclasses import astuple, fields
from pathlib import Path

import numpy as np

from ..analysis.grid import Grid, Maps, check_resolution, maps_of
from ..analysis.nonuniformity import Uniformity, measure
from ..errors import InputError
from ..frame import Frame
from ..io.gridded import is_gridded, read_gridded
from ..io.output import write_csv, write_npz
from ..io.parallel import over_frames
from ..io.reader import check_follows, natural_order
from ..plot.maps import FIELDS, draw_maps, panels_of
from ..plot.style import save
from .common import add_density, add_dumps, add_grid, finish, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_grid(parser)
    add_density(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("maps"), metavar="DIR", help="folder for the results (default maps)"
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def write_frame(frame: Frame, grid: Grid, maps: Maps, stem: Path) -> tuple[Path, Path]:
    """Write one frame's maps as .npz and, a row per cell, as .csv."""
    box = np.array([grid.box.lo, grid.box.hi])
    npz = write_npz(
        stem.with_name(stem.name + ".npz"),
        {"step": frame.step, "time": frame.time, "box": box, "x_edges": grid.x_edges, "z_edges": grid.z_edges, **maps},
    )
    x = (grid.x_edges[:-1] + grid.x_edges[1:]) / 2
    z = (grid.z_edges[:-1] + grid.z_edges[1:]) / 2
    place = np.meshgrid(x, z, indexing="ij")
    rows = zip(*(values.ravel().tolist() for values in (*place, *maps.values())))
    return npz, write_csv(stem.with_name(stem.name + ".csv"), ["x", "z", *maps], rows)


def run(options: argparse.Namespace) -> None:
    out: Path = options.out
    if is_gridded(options.dumps[0]):
        _run_gridded(options)
        return

    def work(frame: Frame) -> tuple[str, Uniformity]:
        grid = Grid(frame.box, *options.grid)
        check_resolution(frame, grid)
        maps = maps_of(frame, grid, options.deposit, options.rho)
        stem = out / f"map.{frame.step:010d}"
        write_frame(frame, grid, maps, stem)
        return stem.name, measure(maps["fraction"], frame.mass, frame.x, frame.z, grid)

    found = over_frames(options.dumps, work, ("vx", "vz"), options.dt)
    if found.root and found.heads:
        names = [field.name for field in fields(Uniformity)]
        rows = [(head.step, head.time, *astuple(value)) for head, (_, value) in zip(found.heads, found.values)]
        for name, _ in found.values:
            tell(out / f"{name}.npz", out / f"{name}.csv")
        tell(write_csv(out / "nonuniformity.csv", ["step", "time", *names], rows))
        if not options.no_figures:
            grid = Grid(found.heads[0].box, *options.grid)
            tell(*_figures(out, [name for name, _ in found.values], found.heads, grid))
    finish(found)


def _run_gridded(options: argparse.Namespace) -> None:
    names: list[str] = []
    heads: list[Frame] = []
    grid: Grid | None = None
    for path in natural_order(options.dumps):
        for head, its_grid, maps in read_gridded(path, options.rho):
            if heads:
                check_follows(heads[-1], head)
            if grid is not None and grid.shape != its_grid.shape:
                raise InputError(path, f"the grid differs from that of {heads[-1].path}", head.line)
            grid = its_grid
            heads.append(head)
            names.append(f"map.{head.step:010d}")
            tell(*write_frame(head, grid, maps, options.out / names[-1]))
    if grid is not None and not options.no_figures:
        tell(*_figures(options.out, names, heads, grid))


def _figures(out: Path, names: list[str], heads: list[Frame], grid: Grid) -> list[Path]:
    chosen = panels_of(len(heads))
    labels = [heads[i].label for i in chosen]
    data = [np.load(out / f"{names[i]}.npz") for i in chosen]
    written = []
    for field in FIELDS:
        if all(field.name in maps for maps in data):
            figure = draw_maps([maps[field.name] for maps in data], labels, grid, field)
            written.append(save(figure, out / f"{field.name}.png"))
    return written
