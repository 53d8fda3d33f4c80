"""Gas fields for `fix drag/cluster … field FILE`: make them of CFD results, check them, draw them.

The files are legacy VTK on a rectilinear grid, in SI units, and open in ParaView as they are.
"""

from __future__ import annotations

import argparse

from . import check, draw, jet, make

PARTS = (make, check, draw, jet)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parts = parser.add_subparsers(required=True, metavar="WHAT")
    for module in PARTS:
        summary = (module.__doc__ or "").strip()
        part = parts.add_parser(
            module.__name__.rpartition(".")[2],
            help=summary.splitlines()[0],
            description=summary,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(part)
        part.set_defaults(part=module.run)


def run(options: argparse.Namespace) -> None:
    options.part(options)
