"""Options and endings that several commands share."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ..analysis.cells import Cells
from ..analysis.grid import Grid
from ..analysis.space import SpaceGrid
from ..errors import ArgumentError
from ..frame import Frame
from ..io.parallel import Gathered
from ..published.cases import case_of
from ..run import FILE


def positive(text: str) -> float:
    """A number above zero, for argparse."""
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError("must be a positive number")
    return value


def add_dumps(parser: argparse.ArgumentParser) -> None:
    """The dump files and what is needed to read them."""
    parser.add_argument("dumps", nargs="+", metavar="DUMP", help="dump files (text, packed too, or binary), any order")
    parser.add_argument("--dt", type=positive, metavar="S", help="timestep (s), for dumps that hold no time")
    add_density(parser)


def add_density(parser: argparse.ArgumentParser) -> None:
    """The density of the primary particles."""
    parser.add_argument(
        "--rho",
        "--density",
        type=positive,
        metavar="KG/M3",
        help="density of the primary particles (default: what the run's log or the dump's columns tell, else 2000); "
        "of the spheres themselves in dumps with neither mass nor density",
    )


def add_cells(parser: argparse.ArgumentParser) -> None:
    """The grid."""
    parser.add_argument(
        "--grid",
        type=int,
        nargs=2,
        default=(30, 30),
        metavar=("NX", "NZ"),
        help="cells along the plane's two axes (default 30 30)",
    )
    add_plane(parser)


def add_any_cells(parser: argparse.ArgumentParser) -> None:
    """The grid, in a plane or in space."""
    parser.add_argument(
        "--grid",
        type=int,
        nargs="+",
        default=(30, 30),
        metavar="N",
        help="cells along the plane's two axes, or along x, y and z (default 30 30)",
    )
    add_plane(parser)


def add_plane(parser: argparse.ArgumentParser) -> None:
    """The plane of maps and profiles."""
    parser.add_argument(
        "--plane", default="xz", metavar="AXES", help="the plane: two of x, y, z, the one across first (default xz)"
    )


def add_grid(parser: argparse.ArgumentParser) -> None:
    """The grid and how clusters are put on it."""
    add_cells(parser)
    add_deposit(parser)


def add_deposit(parser: argparse.ArgumentParser) -> None:
    """How clusters are put on the cells."""
    parser.add_argument(
        "--deposit",
        choices=("nearest", "overlap"),
        default="nearest",
        help="a cluster's mass to its centre's cell, or to each cell its exact share (default nearest)",
    )


def grid_for(options: argparse.Namespace, frame: Frame) -> Grid:
    """The grid of the options on a frame's box."""
    nx, nz = options.grid
    return Grid(frame.box, nx, nz, options.plane)


def check_any_grid(options: argparse.Namespace) -> None:
    """Refuse another number of cells than two or three, and a plane for three."""
    words = " ".join(str(cells) for cells in options.grid)
    if len(options.grid) not in (2, 3):
        raise ArgumentError("grid", f"must be two numbers of cells, in a plane, or three, in space, not {words}")
    columns_for(options.plane)  # refuses what is no plane
    if len(options.grid) == 3 and options.plane != "xz":
        raise ArgumentError("plane", f"is for two numbers of cells: {words} are cells in space")


def any_grid_for(options: argparse.Namespace, frame: Frame) -> Cells:
    """The grid of the options on a frame's box, in a plane or in space."""
    if len(options.grid) == 2:
        return grid_for(options, frame)
    nx, ny, nz = options.grid
    return SpaceGrid(frame.box, (nx, ny, nz))


def columns_for(plane: str, *more: str) -> tuple[str, ...]:
    """Columns that maps in a plane need: coordinates, velocities, and what tells the primary particles."""
    if len(plane) != 2 or len(set(plane)) != 2 or not set(plane) <= set("xyz"):
        raise ArgumentError("plane", f"must be two of x, y, z, such as xz, not {plane}")
    return (*plane, *(f"v{axis}" for axis in plane), "n", "type", *more)


def paper_case(dumps: Sequence[str | Path]) -> str | None:
    """The paper's case that dumps are of, by their names; None if they are of none."""
    names = {found["name"] if (found := FILE.match(Path(dump).name)) else "" for dump in dumps}
    return case_of(names.pop()) if len(names) == 1 else None


def particles_of(frame: Frame) -> str | None:
    """What a frame's primary particles are, in words; None without clusters."""
    return frame.particles.words if len(frame) else None


def say_particles(found: Iterable[str | None]) -> str:
    """Print what solids fractions rest on, and return it."""
    words = "; ".join(dict.fromkeys(word for word in found if word))
    if words:
        print(f"solids fractions with {words}")
    return words


def tell(*paths: Path) -> None:
    """Print written paths, one a line."""
    for path in paths:
        print(path)


def finish(gathered: Gathered[Any]) -> None:
    """Raise what ended the reading early, now that the finished frames are written."""
    if gathered.error is not None:
        raise gathered.error
