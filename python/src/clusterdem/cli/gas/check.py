"""Check gas field files: numbers, units, cover of the box, divergence, times of a series.

Prints what each file holds. Warnings are for the eye; an error (a number that is not finite, a box that is not covered,
a time that is missing) ends with exit code 2, as the engine would end. Files of different grids are no series: check
them one by one.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ...errors import InputError
from ...gas.checks import check_cover, check_field, check_series, describe, describe_conservation, refuse
from ...gas.legacy import read_field
from .common import add_box, box_of, box_of_dump, checked_box


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="gas field files; several are a series")
    add_box(parser, "of the run")
    parser.add_argument("--dump", type=Path, metavar="DUMP", help="take the box from a dump of the run instead")
    parser.add_argument(
        "--edge", nargs=2, action="append", default=[], metavar=("AXIS", "HOW"), help="as in the fix: periodic or clamp"
    )


def run(options: argparse.Namespace) -> None:
    numbers = checked_box(options)
    box = box_of_dump(options.dump) if options.dump else box_of(numbers, options.periodic) if numbers else None
    edges = dict(options.edge)
    if not set(edges) <= set("xyz") or not set(edges.values()) <= {"periodic", "clamp"}:
        raise InputError("--edge", "needs an axis x, y or z, and periodic or clamp")
    found, fields = [], []
    for path in options.files:
        gas = read_field(path)
        print(describe(gas))
        own = check_field(gas)
        if all(finding.level != "error" for finding in own):
            print(describe_conservation(gas))
        if box is not None:
            own += check_cover(gas, box, edges)
        found += own
        fields.append(gas)
    found += check_series(fields)
    once = set()
    for finding in found:
        if not finding.kind or finding.kind not in once:  # a kind of warning is told once for a series
            print(finding)
        once.add(finding.kind)
    refuse(found)
    print("no errors" if any(finding.level == "warning" for finding in found) else "nothing found")
