"""A film (.mp4 or .gif): clusters at true size beside the map of solids fraction, one picture per frame.

The frames are read twice: once for colour scales that hold for the whole film, once to draw.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..analysis.grid import Grid, check_resolution, maps_of
from ..frame import Frame
from ..io.parallel import over_frames
from ..io.reader import read_dumps
from ..plot.film import Picture, Scales, picture, write_film
from ..plot.scatter import colouring_of, quantity
from .common import add_density, add_dumps, add_grid, finish, positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_grid(parser)
    add_density(parser)
    parser.add_argument(
        "--colour", choices=("diameter", "vz", "vx", "speed"), default="diameter", help="what colours the clusters"
    )
    parser.add_argument("--rate", type=positive, default=10.0, metavar="N", help="pictures per second (default 10)")
    parser.add_argument(
        "--dpi", type=int, default=150, choices=range(50, 601), metavar="N", help="resolution (default 150)"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("film.mp4"), metavar="FILE", help=".mp4 or .gif (default film.mp4)"
    )


def run(options: argparse.Namespace) -> None:
    def work(frame: Frame) -> tuple[float, float, float]:
        grid = Grid(frame.box, *options.grid)
        check_resolution(frame, grid)
        values = quantity(frame, options.colour)
        return float(values.min()), float(values.max()), float(maps_of(frame, grid, options.deposit)["mass"].max())

    found = over_frames(options.dumps, work, ("vx", "vz"), options.dt)
    if found.root and found.heads:
        grid = Grid(found.heads[0].box, *options.grid)
        low, high, mass = np.array(found.values).T
        scales = Scales(
            colouring_of(float(low.min()), float(high.max()), options.colour),
            options.colour,
            float(mass.max()) / (options.rho * grid.cell_volume),
        )
        last = found.heads[-1]

        def pictures() -> Iterator[Picture]:
            for frame in read_dumps(options.dumps, ("vx", "vz"), dt=options.dt):
                yield picture(frame, grid, scales, options.deposit, options.rho, options.dpi)
                if (frame.path, frame.step) == (last.path, last.step):
                    return

        tell(write_film(options.out, pictures(), options.rate))
    finish(found)
