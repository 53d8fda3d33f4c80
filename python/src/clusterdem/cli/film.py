"""A film (.mp4 or .gif): clusters at true size beside the map of solids fraction, one picture per frame.

The frames are read twice: once for colour scales that hold for the whole film, once to draw.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..analysis.grid import check_resolution, solids_fraction
from ..frame import Frame
from ..io.parallel import over_frames
from ..io.reader import read_dumps
from ..plot.film import Picture, Scales, picture, write_film
from ..plot.scatter import colouring_of, quantity
from ..published.cases import SCALE
from .common import add_dumps, add_grid, columns_for, finish, grid_for, paper_case, positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_grid(parser)
    parser.add_argument(
        "--colour",
        choices=("diameter", "vx", "vy", "vz", "speed"),
        default="diameter",
        help="what colours the clusters",
    )
    parser.add_argument("--rate", type=positive, default=10.0, metavar="N", help="pictures per second (default 10)")
    parser.add_argument(
        "--dpi", type=int, default=150, choices=range(50, 601), metavar="N", help="resolution (default 150)"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("film.mp4"), metavar="FILE", help=".mp4 or .gif (default film.mp4)"
    )


def run(options: argparse.Namespace) -> None:
    columns = columns_for(options.plane, "vx", "vy", "vz")

    def work(frame: Frame) -> tuple[float, float, float]:
        grid = grid_for(options, frame)
        check_resolution(frame, grid)
        values = quantity(frame, options.colour)
        densest = float(solids_fraction(frame, grid, options.deposit).max())
        return float(values.min(initial=np.inf)), float(values.max(initial=-np.inf)), densest

    found = over_frames(options.dumps, work, columns, options.dt, options.rho, "a film needs")
    if found.root and found.heads:
        grid = grid_for(options, found.heads[0])
        low, high, densest = np.array(found.values).T
        colours = colouring_of(float(low.min()), float(high.max()), options.colour)
        scales = Scales(colours, options.colour, float(densest.max()), SCALE if paper_case(options.dumps) else None)
        last = found.heads[-1]

        def pictures() -> Iterator[Picture]:
            for frame in read_dumps(options.dumps, columns, dt=options.dt, density=options.rho):
                yield picture(frame, grid, scales, options.deposit, options.dpi)
                if (frame.path, frame.step) == (last.path, last.step):
                    return

        tell(write_film(options.out, pictures(), options.rate))
    finish(found)
