"""Profiles of solids fraction, velocity and mean diameter across the width, the height and a tube, and g(r).

Writes to DIR lateral.csv (a row per frame and strip across the plane's first axis), strips.csv (six strips from centre to
wall), height.csv (along the plane's second axis), gr.csv and figures; with --radial also radial.csv, over the radius of
a tube along the plane's second axis, in annuli with their own volumes. A cluster counts where its centre lies.

With --average BLOCKS also NAME_average.csv, the average of each profile over the frames with its standard error
(NAME_error) from so many blocks of frames in a row. Velocities count by mass, diameters by number of clusters.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from ..analysis.averages import average_of
from ..analysis.correlation import pair_correlation
from ..analysis.profiles import WEIGHTS, Profile, Tube, height, lateral, radial, strips
from ..errors import ArgumentError
from ..frame import Floats, Frame
from ..io.output import write_csv
from ..io.parallel import over_frames
from ..io.reader import notes
from ..plot.maps import panels_of
from ..plot.style import save
from ..plot.times import draw_average, draw_pair_correlation, draw_profiles
from .averages import add_average, averaged, check_average, columns_of, label_of
from .common import (
    add_dumps,
    add_plane,
    columns_for,
    finish,
    particles_of,
    positive,
    say_particles,
    tell,
)

MOST_BINS = 1000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument(
        "--bins",
        type=int,
        default=30,
        choices=range(1, MOST_BINS + 1),
        metavar="N",
        help="strips across the width, and along the height (default 30)",
    )
    add_plane(parser)
    parser.add_argument(
        "--rmax", type=positive, metavar="MM", help="largest distance of g(r) (mm; default: by the clusters' sizes)"
    )
    parser.add_argument("--no-gr", action="store_true", help="leave out g(r), the slowest part")
    parser.add_argument(
        "--radial", type=int, metavar="N", help="also a profile over the radius of a tube, in N annuli of equal width"
    )
    parser.add_argument(
        "--centre",
        type=float,
        nargs=2,
        metavar="M",
        help="where the tube's axis lies along the two other axes, in the order x, y, z (m; default: the box's middle)",
    )
    parser.add_argument(
        "--radius", type=float, metavar="M", help="the tube's radius (m; default: half the box's narrower side)"
    )
    add_average(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("profile"), metavar="DIR", help="folder for the results (default profile)"
    )


HEADING = ("step", "time", "from", "to")


def profile_rows(head: Frame, profile: Profile) -> list[tuple[float, ...]]:
    """Rows of a profile's CSV file (SI)."""
    columns = (profile.edges[:-1], profile.edges[1:], *profile.columns.values())
    return [(head.step, head.time, *(float(v) for v in row)) for row in zip(*columns)]


def _tube(options: argparse.Namespace, frame: Frame) -> Tube:
    centre = None if options.centre is None else (options.centre[0], options.centre[1])
    return Tube.in_box(frame.box, options.plane[1], centre, options.radius)


def _check(options: argparse.Namespace) -> None:
    check_average(options)
    for name in ("centre", "radius"):
        if options.radial is None and getattr(options, name) is not None:
            raise ArgumentError(name, "is of the tube of a radial profile: give --radial N too")
    if options.radial is not None and not 1 <= options.radial <= MOST_BINS:
        raise ArgumentError("radial", f"must be 1 to {MOST_BINS} annuli, not {options.radial}")


def run(options: argparse.Namespace) -> None:
    columns = columns_for(options.plane, "x", "y", "z")
    _check(options)

    def work(frame: Frame) -> tuple[dict[str, Profile], tuple[Floats, Floats] | None, str | None, int]:
        correlation = None
        if not options.no_gr:
            correlation = pair_correlation(frame, options.rmax and 1e-3 * options.rmax, plane=options.plane)
        profiles = {
            "lateral": lateral(frame, options.bins, options.plane),
            "strips": strips(frame, plane=options.plane),
            "height": height(frame, options.bins, options.plane),
        }
        outside = 0
        if options.radial is not None:
            profiles["radial"] = radial(frame, _tube(options, frame), options.radial)
            outside = len(frame) - int(profiles["radial"].count.sum())
        return profiles, correlation, particles_of(frame), outside

    found = over_frames(options.dumps, work, columns, options.dt, options.rho)
    if found.root and found.heads:
        out: Path = options.out
        say_particles(value[2] for value in found.values)
        if outside := sum(value[3] for value in found.values):
            notes.warning("the radial profile leaves out %d clusters beyond the tube's radius", outside)
        chosen = panels_of(len(found.heads))
        labels = [found.heads[i].label for i in chosen]
        for name in found.values[0][0]:
            profiles = [value[0][name] for value in found.values]
            rows = [row for head, profile in zip(found.heads, profiles) for row in profile_rows(head, profile)]
            tell(write_csv(out / f"{name}.csv", [*HEADING, *profiles[0].columns], rows))
            if name != "strips":
                tell(save(draw_profiles([profiles[i] for i in chosen], labels), out / f"{name}.png"))
            if options.average is not None:
                tell(*_average(options, name, profiles, found.heads))
        curves = [value[1] for value in found.values]
        known = [(head, curve) for head, curve in zip(found.heads, curves) if curve is not None]
        if known:
            points = [(h.step, h.time, float(a), float(b)) for h, (r, g) in known for a, b in zip(r, g)]
            tell(write_csv(out / "gr.csv", ["step", "time", "r", "g"], points))
            tell(save(draw_pair_correlation([known[i][1] for i in chosen], labels), out / "gr.png"))
    finish(found)


def _average(options: argparse.Namespace, name: str, profiles: list[Profile], heads: list[Frame]) -> list[Path]:
    """Write and draw the average of a profile over the frames."""
    chosen = averaged(options, heads)
    over = [profiles[number] for number in chosen]
    for profile in over:
        if not np.allclose(profile.edges, over[0].edges, rtol=1e-9):
            raise ArgumentError("average", "needs one box for all frames: this one changes")
    means = average_of((profile.columns for profile in over), len(over), options.average, WEIGHTS)
    columns = columns_of(means)
    edges = over[0].edges
    rows = (tuple(map(float, row)) for row in zip(edges[:-1], edges[1:], *columns.values()))
    path = write_csv(options.out / f"{name}_average.csv", ["from", "to", *columns], rows)
    figure = draw_average(means, over[0], label_of([heads[number] for number in chosen]))
    return [path, save(figure, options.out / f"{name}_average.png")]
