"""Make gas field files of CFD results: CSV, VTK, OpenFOAM, Fluent, EnSight, CGNS, Gmsh and what else VTK reads.

INPUT is a table (.csv, .txt or Fluent's ASCII export: a heading, then x, y, z and values at points), an OpenFOAM case
(its folder), a Fluent case (.cas or .cas.h5 with the .dat beside it), or any file that pyvista or meshio reads. Values
in cells are taken to points by each cell's least-squares gradient, so that linear fields stay exact also at walls.
Several inputs, or one with several times, give a series: gas.0000.vtk, gas.0001.vtk, …, for `field gas.*.vtk`.

Without --grid and --spacing a source on a rectilinear grid keeps its own points. Two numbers of --grid or --spacing
make an x–z plane: the cut through the middle of y unless --slice or --average says otherwise.

  clusterdem gas make case/ -o gas.vtk --axes x,-z,y --box 0 0.3 0 0.6 --grid 61 121 --energy k
  clusterdem gas make plane.csv -o gas.vtk --velocity u,0,w --length-unit mm --spacing 0.005
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...gas.axes import LENGTHS, SPEEDS, Placement, parse_axes
from ...gas.checks import check_cover, check_field, check_series, refuse
from ...gas.legacy import write_field
from ...gas.meshes import read_meshes
from ...gas.quantities import Recipe
from ...gas.resample import Target, resample
from ...gas.sources import Source
from ...gas.tables import SUFFIXES, read_table
from ..common import positive, tell
from .common import add_box, box_of, checked_box, numbered, warn

NOTHING = np.empty(0)
"""Stands for the values of a frame that is written: what it needs no more to be compared."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("inputs", nargs="+", type=Path, metavar="INPUT", help="files, or an OpenFOAM case's folder")
    parser.add_argument("-o", "--out", type=Path, default=Path("gas.vtk"), metavar="FILE", help="default gas.vtk")
    parser.add_argument("--ascii", action="store_true", help="numbers as text instead of binary")
    arrays = parser.add_argument_group("arrays, by their names in INPUT, or a number for all points")
    arrays.add_argument("--velocity", metavar="NAME", help="a vector, or U,V,W (0 for none); default: the usual names")
    arrays.add_argument("--velocity-unit", choices=sorted(SPEEDS), default="m/s", help="of INPUT (default m/s)")
    kind = arrays.add_mutually_exclusive_group()
    kind.add_argument(
        "--fluctuation", metavar="NAME", help="amplitude: a vector, a scalar for all components, or A,B,C"
    )
    kind.add_argument("--energy", metavar="NAME", help="turbulent kinetic energy k instead: amplitude sqrt(2k)")
    arrays.add_argument("--density", metavar="NAME", help="kg/m^3")
    kind = arrays.add_mutually_exclusive_group()
    kind.add_argument("--viscosity", metavar="NAME", help="kinematic, m^2/s")
    kind.add_argument("--dynamic-viscosity", metavar="NAME", help="Pa s, divided by the density")
    place = parser.add_argument_group("where it lies in the box: turned, then scaled, then shifted")
    place.add_argument("--axes", default="x,y,z", metavar="A,B,C", help="INPUT's axes along x, y, z; y up: x,-z,y")
    place.add_argument("--length-unit", choices=list(LENGTHS), default="m", help="of INPUT's coordinates (default m)")
    place.add_argument("--scale", type=positive, default=1.0, metavar="F", help="lengths times F (velocities stay)")
    place.add_argument("--shift", type=float, nargs=3, default=(0.0, 0.0, 0.0), metavar=("DX", "DY", "DZ"), help="m")
    grid = parser.add_argument_group("grid")
    size = grid.add_mutually_exclusive_group()
    size.add_argument("--grid", type=int, nargs="+", default=(), metavar="N", help="points: nx nz, or nx ny nz")
    size.add_argument("--spacing", type=positive, nargs="+", default=(), metavar="H", help="m: one, hx hz, or hx hy hz")
    add_box(parser, "extent of the grid; default: of INPUT")
    plane = grid.add_mutually_exclusive_group()
    plane.add_argument("--slice", type=float, metavar="Y", help="an x-z plane at this y (m; default: the middle)")
    plane.add_argument("--average", type=int, default=0, metavar="N", help="mean of N planes over y instead")
    grid.add_argument("--fill", choices=("nearest",), help="points outside INPUT's mesh take the nearest value")
    parser.add_argument(
        "--time",
        type=float,
        nargs="+",
        default=(),
        metavar="S",
        help="time of each INPUT; of a case: which (default all)",
    )


def run(options: argparse.Namespace) -> None:
    recipe, placement, target = _recipe(options), _placement(options), _target(options)
    found, frames = [], []
    for number, (source, alone) in enumerate(_one_ahead(_sources(options))):
        gas = resample(source, recipe, placement, target, options.fill == "nearest")
        found += check_field(gas)
        if target.box is not None:
            found += check_cover(gas, box_of(target.box, target.periodic))
        path = options.out if alone else numbered(options.out, number)
        frames.append(dataclasses.replace(gas, path=str(path), arrays=dict.fromkeys(gas.arrays, NOTHING)))
        if not alone and math.isnan(gas.time):
            raise InputError(source.path, "a frame of a series needs its time: --time")
        refuse(found)
        tell(write_field(path, gas, options.ascii))
    found += check_series(frames)
    refuse(found)
    warn(found)


def _one_ahead(sources: Iterator[Source]) -> Iterator[tuple[Source, bool]]:
    """Each source, and whether it is the only one; not more than two are in memory."""
    first = next(sources, None)
    second = next(sources, None)
    if first is not None:
        yield first, second is None
    if second is not None:
        yield second, False
    first = second = None
    for source in sources:
        yield source, False


def _sources(options: argparse.Namespace) -> Iterator[Source]:
    """Every frame; times by the files, or by --time."""
    inputs, times = options.inputs, options.time
    for path in inputs:
        if not path.exists():
            raise InputError(path, "does not exist")
    if len(inputs) == 1:
        yield from _alone(inputs[0], times)
        return
    if times and len(times) != len(inputs):
        raise InputError("--time", f"needs a time for each of the {len(inputs)} inputs, not {len(times)}")
    for k, path in enumerate(inputs):
        found = list(_read(path, ()))
        if len(found) != 1:
            raise InputError(path, f"holds {len(found)} times: give it alone")
        if times:
            found[0].time = times[k]
        yield found[0]


def _alone(path: Path, times: list[float]) -> Iterator[Source]:
    """A file with several times gives those that are wished; one without takes the one that is given."""
    for source in _read(path, times):
        if len(times) == 1 and math.isnan(source.time):
            source.time = times[0]
        elif times and math.isnan(source.time):
            raise InputError(path, f"holds no times, but --time gives {len(times)}")
        yield source


def _read(path: Path, times: tuple[float, ...] | list[float]) -> Iterator[Source]:
    if path.is_file() and path.suffix.lower() in SUFFIXES:
        yield read_table(path)
    else:
        yield from read_meshes(path, times)


def _recipe(options: argparse.Namespace) -> Recipe:
    def names(text: str | None, option: str) -> tuple[str, ...]:
        words = tuple(text.split(",")) if text else ()
        if len(words) not in (0, 1, 3) or not all(words):
            raise InputError(option, f"must be one name, or three with commas, not {text}")
        return words

    if options.dynamic_viscosity and not options.density:
        raise InputError("--dynamic-viscosity", "needs --density, to divide by")
    return Recipe(
        names(options.velocity, "--velocity"),
        names(options.fluctuation, "--fluctuation"),
        options.energy or "",
        options.density or "",
        options.viscosity or "",
        options.dynamic_viscosity or "",
        SPEEDS[options.velocity_unit],
    )


def _placement(options: argparse.Namespace) -> Placement:
    order, signs = parse_axes(options.axes)
    dx, dy, dz = options.shift
    return Placement(order, signs, LENGTHS[options.length_unit] * options.scale, (dx, dy, dz))


def _target(options: argparse.Namespace) -> Target:
    for option, words in (("--grid", options.grid), ("--spacing", options.spacing)):
        least = 2 if option == "--grid" else 1
        if words and not least <= len(words) <= 3:
            raise InputError(option, f"needs {'two' if least == 2 else 'one'} to three numbers, not {len(words)}")
    if options.average < 0:
        raise InputError("--average", "must be 1 or more planes")
    return Target(checked_box(options), options.grid, options.spacing, options.periodic, options.slice, options.average)
