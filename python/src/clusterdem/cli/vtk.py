"""VTK files for ParaView: open clusters.pvd (points) and maps.pvd (images) as series over time.

Writes to DIR clusters.STEP.vtp and maps.STEP.vti for each frame, and the two .pvd files. With three numbers behind --grid
the images are cells in space, each with solids fraction, mean velocity, granular temperature and more. In ParaView draw the points
with the Point Gaussian representation or a sphere Glyph scaled by the array diameter. OVITO needs no export: it opens
the dumps themselves (Load File, case1.*.dump), finds the series over time, and takes the column diameter (or radius)
as the size of the particles and n, l and the rest as their properties (checked with OVITO 3.17).
"""

from __future__ import annotations

import argparse
from math import isnan
from pathlib import Path

from ..analysis.cells import Cells
from ..analysis.grid import check_resolution, maps_of
from ..analysis.space import SpaceGrid
from ..errors import ArgumentError
from ..frame import Frame
from ..io.parallel import over_frames
from ..io.reader import notes
from ..io.vtk import write_image, write_points, write_series
from .common import (
    add_density,
    add_deposit,
    add_dumps,
    add_plane,
    columns_for,
    finish,
    grid_for,
    particles_of,
    say_particles,
    tell,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument(
        "--grid",
        type=int,
        nargs="+",
        default=(30, 30),
        metavar="N",
        help="cells along the plane's two axes, or along x, y and z (default 30 30)",
    )
    add_plane(parser)
    add_deposit(parser)
    add_density(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("vtk"), metavar="DIR", help="folder for the results (default vtk)"
    )


def _check_grid(options: argparse.Namespace) -> None:
    words = " ".join(str(cells) for cells in options.grid)
    if len(options.grid) not in (2, 3):
        raise ArgumentError("grid", f"must be two numbers of cells, in a plane, or three, in space, not {words}")
    columns_for(options.plane)  # refuses what is no plane
    if len(options.grid) == 3 and options.plane != "xz":
        raise ArgumentError("plane", f"is for two numbers of cells: {words} are cells in space")


def _grid(options: argparse.Namespace, frame: Frame) -> Cells:
    if len(options.grid) == 2:
        return grid_for(options, frame)
    nx, ny, nz = options.grid
    return SpaceGrid(frame.box, (nx, ny, nz))


def run(options: argparse.Namespace) -> None:
    out: Path = options.out
    _check_grid(options)

    def work(frame: Frame) -> tuple[Path, Path, str | None, str | None]:
        grid = _grid(options, frame)
        check_resolution(frame, grid)
        points = write_points(out / f"clusters.{frame.step:010d}.vtp", frame)
        unknown = None
        try:
            maps = maps_of(frame, grid, options.deposit)
        except ArgumentError as error:
            if options.rho is not None:
                raise
            unknown = error.rule
            maps = maps_of(frame, grid, options.deposit, fractions=False)
        image = write_image(out / f"maps.{frame.step:010d}.vti", maps, grid, frame.time)
        return points, image, particles_of(frame) if unknown is None else None, unknown

    found = over_frames(options.dumps, work, None, options.dt, options.rho)
    if found.root and found.heads:
        say_particles(value[2] for value in found.values)
        for rule in dict.fromkeys(value[3] for value in found.values if value[3]):
            notes.warning("solids fractions are left out: %s: --rho", rule)
        times = [float(head.step) if isnan(head.time) else head.time for head in found.heads]
        for which, name in ((0, "clusters"), (1, "maps")):
            files = [Path(str(value[which])) for value in found.values]
            tell(*files, write_series(out / f"{name}.pvd", [(t, file.name) for t, file in zip(times, files)]))
    finish(found)
