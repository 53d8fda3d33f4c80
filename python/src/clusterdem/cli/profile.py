"""Lateral profiles of solids fraction, velocity and mean diameter, and g(r).

Writes to DIR lateral.csv (a row per frame and strip across x), strips.csv (six strips from centre to wall),
gr.csv and figures.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from ..analysis.correlation import pair_correlation
from ..analysis.nonuniformity import Profile, lateral, strips
from ..frame import Floats, Frame
from ..io.output import write_csv
from ..io.parallel import over_frames
from ..plot.maps import panels_of
from ..plot.style import save
from ..plot.times import draw_lateral, draw_pair_correlation
from .common import (
    add_density,
    add_dumps,
    add_plane,
    columns_for,
    finish,
    particles_of,
    positive,
    say_particles,
    tell,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    add_density(parser)
    parser.add_argument(
        "--bins", type=int, default=30, choices=range(1, 1001), metavar="N", help="strips across x (default 30)"
    )
    add_plane(parser)
    parser.add_argument(
        "--rmax", type=positive, metavar="MM", help="largest distance of g(r) (mm; default: by the clusters' sizes)"
    )
    parser.add_argument("--no-gr", action="store_true", help="leave out g(r), the slowest part")
    parser.add_argument(
        "--out", type=Path, default=Path("profile"), metavar="DIR", help="folder for the results (default profile)"
    )


def profile_rows(head: Frame, profile: Profile) -> list[tuple[float, ...]]:
    """Rows of a profile's CSV file (SI)."""
    velocity = profile.velocity if profile.velocity is not None else np.full(len(profile.count), np.nan)
    nothing = np.full(len(profile.count), np.nan)
    fraction = nothing if profile.fraction is None else profile.fraction
    columns = (profile.edges[:-1], profile.edges[1:], fraction, velocity, profile.diameter, profile.count)
    return [(head.step, head.time, *(float(v) for v in row)) for row in zip(*columns)]


def run(options: argparse.Namespace) -> None:
    columns = columns_for(options.plane, "x", "y", "z")

    def work(frame: Frame) -> tuple[Profile, Profile, tuple[Floats, Floats] | None, str | None]:
        correlation = None
        if not options.no_gr:
            correlation = pair_correlation(frame, options.rmax and 1e-3 * options.rmax, plane=options.plane)
        across = lateral(frame, options.bins, options.plane), strips(frame, plane=options.plane)
        return (*across, correlation, particles_of(frame))

    found = over_frames(options.dumps, work, columns, options.dt, options.rho)
    if found.root and found.heads:
        out: Path = options.out
        say_particles(value[3] for value in found.values)
        heading = [
            "step",
            "time",
            "from",
            "to",
            "fraction",
            f"velocity_{options.plane[1]}",
            "mean_diameter",
            "clusters",
        ]
        lateral_profiles = [value[0] for value in found.values]
        for name, profiles in (("lateral", lateral_profiles), ("strips", [value[1] for value in found.values])):
            rows = [row for head, profile in zip(found.heads, profiles) for row in profile_rows(head, profile)]
            tell(write_csv(out / f"{name}.csv", heading, rows))
        chosen = panels_of(len(found.heads))
        labels = [found.heads[i].label for i in chosen]
        tell(save(draw_lateral([lateral_profiles[i] for i in chosen], labels), out / "lateral.png"))
        curves = [value[2] for value in found.values]
        known = [(head, curve) for head, curve in zip(found.heads, curves) if curve is not None]
        if known:
            points = [(h.step, h.time, float(a), float(b)) for h, (r, g) in known for a, b in zip(r, g)]
            tell(write_csv(out / "gr.csv", ["step", "time", "r", "g"], points))
            tell(save(draw_pair_correlation([known[i][1] for i in chosen], labels), out / "gr.png"))
    finish(found)
