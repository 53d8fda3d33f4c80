"""Mass flow of solids through a plane, from momentum beside it and from clusters that crossed it.

Writes to DIR flow.csv, a row per frame (kg/s): slab_… is Σ m v / h over the clusters in a slab of thickness h about the plane at
that instant; crossed_… the mass of the clusters that crossed between the frame before and this one, over the time between;
up (towards larger coordinates), down (below 0) and net. Clusters are known again by their ID, which a breakup leaves to the
first piece and a merge to the lower one: the larger mass of the two frames counts, and unmatched_percent says how much mass
of the frame before has an ID that is gone. With --average BLOCKS also average.csv, the means over time with standard errors.
"""

from __future__ import annotations

import argparse
from math import isnan
from pathlib import Path

import numpy as np

from ..analysis.averages import TimeAverage, time_average
from ..analysis.flow import Crossings, MassFlow, Section, crossings, farthest, slab_flow
from ..errors import InputError
from ..frame import Floats, Frame
from ..io.output import write_csv
from ..io.parallel import over_frames
from ..io.reader import notes, read_dumps
from ..plot.flow import draw_flow
from ..plot.style import save
from .averages import add_average, averaged, check_average, label_of
from .common import add_dumps, finish, tell

QUANTITIES = ("slab_up", "slab_down", "slab_net", "crossed_up", "crossed_down", "crossed_net")
SLABS = 30
"""Default slabs of a box."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_dumps(parser)
    parser.add_argument("--axis", choices=("x", "y", "z"), default="z", help="the axis across the plane (default z)")
    parser.add_argument(
        "--at", type=float, metavar="M", help="where the plane stands (m; default: the middle of the box)"
    )
    parser.add_argument(
        "--slab", type=float, metavar="M", help=f"thickness of the slab about it (m; default: a {SLABS}th of the box)"
    )
    add_average(parser)
    parser.add_argument(
        "--out", type=Path, default=Path("flow"), metavar="DIR", help="folder for the results (default flow)"
    )
    parser.add_argument("--no-figures", action="store_true", help="data only")


def _section(options: argparse.Namespace, frame: Frame) -> Section:
    number = "xyz".index(options.axis)
    middle = (frame.box.lo[number] + frame.box.hi[number]) / 2
    return Section(options.axis, middle if options.at is None else options.at)


def run(options: argparse.Namespace) -> None:
    check_average(options)
    columns = ("id", options.axis, f"v{options.axis}")

    def work(frame: Frame) -> MassFlow:
        if isnan(frame.time):
            raise InputError(frame.path, "holds no time, which a flow needs: give --dt", frame.line)
        length = frame.box.lengths["xyz".index(options.axis)]
        return slab_flow(frame, _section(options, frame), length / SLABS if options.slab is None else options.slab)

    found = over_frames(options.dumps, work, columns, options.dt, options.rho, one_box="a flow through a plane needs")
    if found.root and found.heads:
        out: Path = options.out
        passed = _crossings(options, found.heads[-1], columns)
        table = _table(found.values, passed)
        counts = [
            (0, 0, float("nan")) if one is None else (one.clusters_up, one.clusters_down, 100 * one.unmatched)
            for one in passed
        ]
        rows = [
            (head.step, head.time, *(float(table[name][i]) for name in QUANTITIES), *counts[i])
            for i, head in enumerate(found.heads)
        ]
        heading = ["step", "time", *QUANTITIES, "clusters_up", "clusters_down", "unmatched_percent"]
        tell(write_csv(out / "flow.csv", heading, rows))
        averages = None
        if options.average is not None:
            chosen = averaged(options, found.heads)
            averages = _averages(options, found.heads, table, chosen)
            lines = [(name, float(one.mean), float(one.error)) for name, one in averages.items()]
            tell(write_csv(out / "average.csv", ["quantity", "mean", "error"], lines))
            print(f"mass flow (kg/s) over {label_of([found.heads[i] for i in chosen])}")
            for name, mean, error in lines:
                print(f"{name:>14}  {mean:12.5g} ± {error:.2g}")
        if not options.no_figures:
            times = np.array([head.time for head in found.heads])
            tell(save(draw_flow(times, table, _section(options, found.heads[0])), out / "flow.png"))
    finish(found)


def _crossings(options: argparse.Namespace, last: Frame, columns: tuple[str, ...]) -> list[Crossings | None]:
    """What crossed between each frame and the one before; None for the first. Two frames are held at a time."""
    passed: list[Crossings | None] = []
    before: Frame | None = None
    for frame in read_dumps(options.dumps, columns, dt=options.dt, density=options.rho):
        if before is None:
            passed.append(None)
        else:
            section = _section(options, frame)
            passed.append(crossings(before, frame, section))
            if section.side(frame.box)[2] and farthest(before, frame, section) > 0.5:
                notes.warning(
                    "between frames clusters go farther than half the box: which way they crossed cannot be told"
                )
        before = frame
        if (frame.path, frame.step) == (last.path, last.step):
            break
    return passed


def _table(slab: list[MassFlow], passed: list[Crossings | None]) -> dict[str, Floats]:
    """Every quantity of each frame (kg/s), shape (F,)."""
    nothing = MassFlow(float("nan"), float("nan"))
    crossed = [nothing if one is None else one.flow for one in passed]
    return {
        f"{name}_{part}": np.array([getattr(flow, part) for flow in flows])
        for name, flows in (("slab", slab), ("crossed", crossed))
        for part in ("up", "down", "net")
    }


def _averages(
    options: argparse.Namespace, heads: list[Frame], table: dict[str, Floats], chosen: list[int]
) -> dict[str, TimeAverage]:
    """Means of the slab over the chosen frames, of the crossings over the intervals between them."""
    times = np.array([heads[number].time for number in chosen])
    intervals = np.diff(times, prepend=times[0])  # of the first none, which has no weight
    found = {}
    for name in QUANTITIES:
        weights = list(intervals) if name.startswith("crossed") else None
        found[name] = time_average(list(table[name][chosen]), len(chosen), options.average, weights)
    return found
