"""Clusters drawn at their true size, the whole box and a window, one figure per frame."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..errors import ArgumentError
from ..frame import Frame
from ..io.parallel import over_frames
from ..plot.scatter import draw_scatter
from ..plot.style import save
from .common import add_dumps, add_plane, columns_for, finish, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument(
        "--colour", choices=("diameter", "vx", "vy", "vz", "speed"), default="diameter", help="what colours the discs"
    )
    parser.add_argument(
        "--window",
        type=float,
        nargs=4,
        metavar=("X0", "X1", "Z0", "Z1"),
        help="window (m; default: the middle of the box)",
    )
    add_plane(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("scatter"), metavar="DIR", help="folder for the figures (default scatter)"
    )


def run(options: argparse.Namespace) -> None:
    window = options.window
    if window is not None and not (window[0] < window[1] and window[2] < window[3]):
        raise ArgumentError("window", "needs X0 < X1 and Z0 < Z1")

    columns = columns_for(options.plane, "vx", "vy", "vz")

    def work(frame: Frame) -> Path:
        return save(
            draw_scatter(frame, options.colour, window, options.plane), options.out / f"scatter.{frame.step:010d}.png"
        )

    found = over_frames(options.dumps, work, columns, options.dt, options.rho)
    if found.root:
        tell(*found.values)
    finish(found)
