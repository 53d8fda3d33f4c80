"""Connected groups of clusters that touch: how many, how large, how heavy, how far they reach.

Writes to DIR summary.csv (a row per frame: clusters, groups of two or more, the share of clusters and of mass in them, the
largest), groups.csv (a row per frame and group of two or more clusters, the largest first: clusters, mass, extent along
x, y and z) and, as PNG, how many groups hold so many clusters or more. Centres count with their y (or depth), across
sides that repeat.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..analysis.groups import Groups, groups_of
from ..errors import ArgumentError
from ..frame import Frame
from ..io.output import write_csv
from ..io.parallel import over_frames
from ..plot.groups import draw_groups
from ..plot.style import save
from .common import add_dumps, finish, tell

SUMMARY = (
    "step time clusters groups in_groups_percent mass_in_groups_percent largest largest_mass extent_x extent_y extent_z"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument(
        "--gap",
        type=float,
        default=0.0,
        metavar="UM",
        help="largest gap between surfaces that counts as touching (µm; default 0)",
    )
    parser.add_argument(
        "--out", type=Path, default=Path("groups"), metavar="DIR", help="folder for the results (default groups)"
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def summary_row(head: Frame, found: Groups) -> list[float]:
    """A row of summary.csv."""
    several = found.clusters > 1
    clusters, mass = int(found.clusters.sum()), float(found.mass.sum())
    shares = [
        100 * float(part[several].sum()) / whole if whole else 0.0
        for part, whole in ((found.clusters, clusters), (found.mass, mass))
    ]
    largest = [int(found.clusters[0]), float(found.mass[0]), *found.extent[0].tolist()] if clusters else [0] + 4 * [0.0]
    return [head.step, head.time, clusters, int(several.sum()), *shares, *largest]


def run(options: argparse.Namespace) -> None:
    if not 0 <= options.gap < float("inf"):
        raise ArgumentError("gap", f"must be 0 µm or more, not {options.gap:g}")
    found = over_frames(
        options.dumps, lambda frame: groups_of(frame, 1e-6 * options.gap), ("x", "y", "z"), options.dt, options.rho
    )
    if found.root and found.heads:
        out: Path = options.out
        pairs = list(zip(found.heads, found.values))
        tell(write_csv(out / "summary.csv", SUMMARY.split(), [summary_row(*pair) for pair in pairs]))
        rows = (
            (
                head.step,
                head.time,
                number + 1,
                int(groups.clusters[number]),
                float(groups.mass[number]),
                *groups.extent[number].tolist(),
            )
            for head, groups in pairs
            for number in range(int((groups.clusters > 1).sum()))
        )
        heading = "step time group clusters mass extent_x extent_y extent_z".split()
        tell(write_csv(out / "groups.csv", heading, rows))
        if not options.no_figures:
            tell(save(draw_groups(found.values, [head.label for head in found.heads]), out / "groups.png"))
    finish(found)
