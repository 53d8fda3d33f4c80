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

from ..analysis.grid import check_resolution, maps_of
from ..errors import ArgumentError
from ..frame import Frame
from ..io.parallel import over_frames
from ..io.reader import notes
from ..io.vtk import write_image, write_points, write_series
from .common import (
    add_any_cells,
    add_deposit,
    add_dumps,
    any_grid_for,
    check_any_grid,
    finish,
    particles_of,
    say_particles,
    tell,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_any_cells(parser)
    add_deposit(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("vtk"), metavar="DIR", help="folder for the results (default vtk)"
    )


def run(options: argparse.Namespace) -> None:
    out: Path = options.out
    check_any_grid(options)

    def work(frame: Frame) -> tuple[Path, Path, str | None, str | None]:
        grid = any_grid_for(options, frame)
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
