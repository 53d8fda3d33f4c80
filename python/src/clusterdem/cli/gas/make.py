"""Make gas field files of CFD results: CSV, VTK, OpenFOAM, Fluent, EnSight, CGNS, Gmsh and what else VTK reads.

INPUT is a table (.csv, .txt, OpenFOAM's .xy and .raw, exports of Fluent, STAR-CCM+, COMSOL: x, y, z and values at points),
an OpenFOAM case (its folder, reconstructed or not), a Fluent case (.cas or .cas.h5 with the .dat beside it), a
.vtk.series, or any file that pyvista or meshio reads. Values in cells are taken to points by each cell's least-squares
gradient; at walls those of the file hold. Several inputs, or one with several times, give a series: gas.0000.vtk,
gas.0001.vtk, …, for `field gas.*.vtk`; frames of an earlier series there are removed.

Without --grid and --spacing a source on a rectilinear grid keeps its own points. Two numbers of --grid or --spacing
make an x–z plane: the cut through the middle of y unless --slice or --average says otherwise. OpenFOAM cases one cell
thick are planes (empty patches) or bodies of revolution (wedge patches).

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
from ...gas.checks import Finding, check_cover, check_field, check_series, refuse
from ...gas.field import GasField
from ...gas.legacy import write_field
from ...gas.meshes import read_meshes
from ...gas.openfoam import Times
from ...gas.provenance import provenance
from ...gas.quantities import Recipe
from ...gas.resample import Making, Target, resample
from ...gas.sections import KeptFlux
from ...gas.series import read_series
from ...gas.sources import Source, joined
from ...gas.tables import SUFFIXES, read_table
from ..common import positive, tell
from .common import add_box, box_of, checked_box, numbered, remove_old_frames, warn

NOTHING = np.empty(0)
"""Stands for the values of a frame that is written: what it needs no more to be compared."""
MUCH_FLUX = 0.01
"""Difference from the source's flux that is told."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("inputs", nargs="+", type=Path, metavar="INPUT", help="files, or an OpenFOAM case's folder")
    parser.add_argument("-o", "--out", type=Path, default=Path("gas.vtk"), metavar="FILE", help="default gas.vtk")
    parser.add_argument("--ascii", action="store_true", help="numbers as text instead of binary")
    arrays = parser.add_argument_group("arrays, by their names in INPUT, or a number for all points")
    arrays.add_argument("--velocity", metavar="NAME", help="a vector, or U,V,W (0 for none); default: the usual names")
    arrays.add_argument("--velocity-unit", choices=sorted(SPEEDS), help="of INPUT (default: what it tells, else m/s)")
    arrays.add_argument(
        "--velocity-scale",
        type=positive,
        default=1.0,
        metavar="F",
        help="velocities times F: the reference velocity of a result without dimensions, in --velocity-unit",
    )
    kind = arrays.add_mutually_exclusive_group()
    kind.add_argument(
        "--fluctuation", metavar="NAME", help="amplitude: a vector, a scalar for all components, or A,B,C"
    )
    kind.add_argument("--energy", metavar="NAME", help="turbulent kinetic energy k instead: amplitude sqrt(2k)")
    kind = arrays.add_mutually_exclusive_group()
    kind.add_argument(
        "--dissipation",
        metavar="NAME",
        help="with --energy: its dissipation rate epsilon (m^2/s^3), for the lifetime of eddies",
    )
    kind.add_argument("--omega", metavar="NAME", help="or its specific dissipation rate omega (1/s)")
    arrays.add_argument(
        "--lifetime", type=positive, default=0.3, metavar="C", help="of an eddy: C k/epsilon (default 0.3)"
    )
    arrays.add_argument("--density", metavar="NAME", help="kg/m^3")
    kind = arrays.add_mutually_exclusive_group()
    kind.add_argument("--viscosity", metavar="NAME", help="kinematic, m^2/s")
    kind.add_argument("--dynamic-viscosity", metavar="NAME", help="Pa s, divided by the density")
    place = parser.add_argument_group("where it lies in the box: turned, then scaled, then shifted")
    place.add_argument("--axes", default="x,y,z", metavar="A,B,C", help="INPUT's axes along x, y, z; y up: x,-z,y")
    place.add_argument(
        "--length-unit", choices=list(LENGTHS), help="of INPUT's coordinates (default: what it tells, else m)"
    )
    place.add_argument("--scale", type=positive, default=1.0, metavar="F", help="lengths times F (velocities stay)")
    place.add_argument("--shift", type=float, nargs=3, default=(0.0, 0.0, 0.0), metavar=("DX", "DY", "DZ"), help="m")
    place.add_argument(
        "--mirror",
        nargs="+",
        default=(),
        metavar="END",
        help="half domains made whole at ends of INPUT: x- its lowest x, z+ …",
    )
    place.add_argument(
        "--revolve",
        default="",
        metavar="AXIS",
        help="INPUT's axis about which a plane is turned (wedge cases: by themselves)",
    )
    grid = parser.add_argument_group("grid")
    size = grid.add_mutually_exclusive_group()
    size.add_argument("--grid", type=int, nargs="+", default=(), metavar="N", help="points: nx nz, or nx ny nz")
    size.add_argument("--spacing", type=positive, nargs="+", default=(), metavar="H", help="m: one, hx hz, or hx hy hz")
    add_box(parser, "extent of the grid; default: of INPUT")
    plane = grid.add_mutually_exclusive_group()
    plane.add_argument("--slice", type=float, metavar="Y", help="an x-z plane at this y (m; default: the middle)")
    plane.add_argument("--average", type=int, default=0, metavar="N", help="mean of N planes over y instead")
    grid.add_argument(
        "--fill",
        choices=("rest", "nearest"),
        default="",
        help="points outside INPUT's mesh are at rest or take the nearest value; default: at rest within its extent, where "
        "solids are, and refused beyond",
    )
    grid.add_argument(
        "--wall",
        choices=("file", "noslip"),
        default="file",
        help="velocity at walls: as INPUT has it (default), or 0 at all of them",
    )
    grid.add_argument(
        "--keep-flux", action="store_true", help="scale the velocity so that each section has the flux of INPUT"
    )
    time = parser.add_argument_group("time")
    time.add_argument(
        "--time",
        nargs="+",
        default=[],
        metavar="S",
        help="latest, all, or times (s): which of a case (default: the latest of a steady one, all but 0 of others); "
        "of files that hold none: the time of each",
    )
    time.add_argument("--start", type=float, metavar="S", help="time of the first frame (s); the others follow it")
    time.add_argument("--join", action="store_true", help="all INPUTs are parts of one time")


def run(options: argparse.Namespace) -> None:
    found: list[Finding] = []
    frames: list[GasField] = []
    shift = 0.0
    for number, (source, alone) in enumerate(_one_ahead(_sources(options))):
        making = _making(options, source)
        gas, kept = resample(source, making)
        if options.start is not None:
            if math.isnan(gas.time):
                raise InputError("--start", f"needs the time of {source.path}, which is unknown: --time")
            shift = shift if number else options.start - gas.time
            gas = dataclasses.replace(gas, time=gas.time + shift)
        gas = dataclasses.replace(gas, provenance=provenance(source, making, gas, kept))
        path = options.out if alone else numbered(options.out, number)
        found += check_field(gas) + _told(source, path, kept, making)
        if making.target.box is not None:
            found += check_cover(gas, box_of(making.target.box, making.target.periodic))
        frames.append(dataclasses.replace(gas, path=str(path), arrays=dict.fromkeys(gas.arrays, NOTHING), solid=None))
        if not alone and math.isnan(gas.time):
            raise InputError(
                source.path, "a frame of a series needs its time: --time (or --join, if all are parts of one)"
            )
        refuse(found)
        if number == 0 and not alone:
            remove_old_frames(options.out)
        tell(write_field(path, gas, options.ascii))
    found += check_series(frames)
    refuse(found)
    warn(found)


def _told(source: Source, path: Path, kept: KeptFlux | None, making: Making) -> list[Finding]:
    """What a user should know of a frame beside what the frame itself shows."""
    found = [Finding("note", source.path, note, note) for note in source.notes]
    names = making.recipe.velocity_names(source.path, source.arrays)
    if not making.no_slip and (slipping := source.slipping(names)):
        rule = f"has no velocity at its walls ({', '.join(slipping[:5])}): the gas slips there; --wall noslip lets it stick"
        found.append(Finding("warning", source.path, rule, "slip"))
    if kept is not None and kept.off > MUCH_FLUX:
        pairs = ", ".join(
            f"{q:.5g} for {s:.5g} at {kept.axis} = {a:.5g} m"
            for q, s, a in zip(kept.grid[[0, -1]], kept.source[[0, -1]], kept.places[[0, -1]])
        )
        done = "corrected by --keep-flux" if making.keep_flux else "a finer grid, or --keep-flux"
        rule = f"flux through the ends of the grid, and of its source (m^2/s or m^3/s): {pairs}; {done}"
        found.append(Finding("note" if making.keep_flux else "warning", str(path), rule, "flux"))
    return found


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
    inputs, times = options.inputs, _times(options.time)
    for path in inputs:
        if not path.exists():
            raise InputError(path, "does not exist")
    if len(inputs) == 1:
        yield from _alone(inputs[0], times)
        return
    one = len(times) if options.join and not isinstance(times, str) else len(inputs)
    if isinstance(times, str) and times or times and len(times) != (1 if options.join else len(inputs)):
        raise InputError("--time", f"needs a time for each of the {one} inputs, not {' '.join(options.time)}")
    parts = []
    for k, path in enumerate(inputs):
        found = list(_read(path, ""))
        if len(found) != 1:
            raise InputError(path, f"holds {len(found)} times: give it alone")
        if times and not isinstance(times, str):
            found[0].time = times[0 if options.join else k]
        if options.join:
            parts.append(found[0])
        else:
            yield found[0]
    if parts:
        yield joined(parts)


def _times(words: list[str]) -> Times:
    if words in (["latest"], ["all"]):
        return "latest" if words == ["latest"] else "all"
    try:
        times = [float(word) for word in words]
    except ValueError:
        raise InputError("--time", f"must be latest, all, or times (s), not {' '.join(words)}") from None
    if not all(map(math.isfinite, times)):
        raise InputError("--time", f"must be finite times (s), not {' '.join(words)}")
    return times or ""


def _alone(path: Path, times: Times) -> Iterator[Source]:
    """A file with several times gives those that are wished; one without takes the one that is given."""
    own = times if isinstance(times, str) or not _holds_no_time(path) else ""
    for source in _read(path, own):
        if not isinstance(times, str) and math.isnan(source.time) and not source.steady:
            if len(times) > 1:
                raise InputError(path, f"holds no times, but --time gives {len(times)}")
            source.time = times[0]
        yield source


def _holds_no_time(path: Path) -> bool:
    return path.is_file() and path.suffix.lower() in SUFFIXES


def _read(path: Path, times: Times) -> Iterator[Source]:
    if _holds_no_time(path):
        yield read_table(path)
    elif path.suffix == ".series":
        yield from read_series(path, times)
    else:
        yield from read_meshes(path, times)


def _making(options: argparse.Namespace, source: Source) -> Making:
    return Making(
        _recipe(options, source),
        _placement(options, source),
        _target(options),
        options.fill,
        options.wall == "noslip",
        options.mirror,
        options.revolve,
        options.keep_flux,
    )


def _unit(option: str, given: str | None, told: str, known: dict[str, float], usual: str, source: Source) -> float:
    """A unit that is given, or that the file tells; an error where they differ."""
    if given and told in known and told != given:
        raise InputError(option, f"{given}, but {source.path} says {told}: leave the option out")
    return known[given or (told if told in known else usual)]


def _recipe(options: argparse.Namespace, source: Source) -> Recipe:
    def names(text: str | None, option: str) -> tuple[str, ...]:
        words = tuple(text.split(",")) if text else ()
        if len(words) not in (0, 1, 3) or not all(words):
            raise InputError(option, f"must be one name, or three with commas, not {text}")
        return words

    rate = "--dissipation" if options.dissipation else "--omega" if options.omega else ""
    if rate and not options.energy:
        raise InputError(rate, "needs --energy, whose dissipation it is")
    if rate and options.velocity_scale != 1:
        raise InputError(rate, "must have its unit, but --velocity-scale says that INPUT has no dimensions")
    if options.dynamic_viscosity and not options.density:
        raise InputError("--dynamic-viscosity", "needs --density, to divide by")
    velocity = names(options.velocity, "--velocity")
    columns = Recipe(velocity).velocity_names(source.path, source.arrays)
    told = next((source.units[name] for name in columns if name in source.units), "")
    speed = _unit("--velocity-unit", options.velocity_unit, told, SPEEDS, "m/s", source)
    return Recipe(
        velocity,
        names(options.fluctuation, "--fluctuation"),
        options.energy or "",
        options.dissipation or "",
        options.omega or "",
        options.lifetime,
        options.density or "",
        options.viscosity or "",
        options.dynamic_viscosity or "",
        speed * options.velocity_scale,
    )


def _placement(options: argparse.Namespace, source: Source) -> Placement:
    length = _unit("--length-unit", options.length_unit, source.units.get("", ""), LENGTHS, "m", source)
    order, signs = parse_axes(options.axes)
    dx, dy, dz = options.shift
    return Placement(order, signs, length * options.scale, (dx, dy, dz))


def _target(options: argparse.Namespace) -> Target:
    for option, words in (("--grid", options.grid), ("--spacing", options.spacing)):
        least = 2 if option == "--grid" else 1
        if words and not least <= len(words) <= 3:
            raise InputError(option, f"needs {'two' if least == 2 else 'one'} to three numbers, not {len(words)}")
    if options.average < 0:
        raise InputError("--average", "must be 1 or more planes")
    return Target(checked_box(options), options.grid, options.spacing, options.periodic, options.slice, options.average)
