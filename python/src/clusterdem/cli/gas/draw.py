"""Draw gas field files: speed with streamlines, divergence, profiles along the height, further arrays."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...gas.checks import check_field, refuse
from ...gas.figure import draw_gas
from ...gas.legacy import read_field
from ...plot.style import save
from ..common import tell
from .common import numbered


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="gas field files; a picture each")
    parser.add_argument("-o", "--out", type=Path, default=Path("gas.png"), metavar="FILE", help="default gas.png")
    parser.add_argument("--slice", type=float, metavar="Y", help="which y of a 3-D field (m; default: the middle)")


def run(options: argparse.Namespace) -> None:
    for k, path in enumerate(options.files):
        gas = read_field(path)
        refuse(check_field(gas))
        path = options.out if len(options.files) == 1 else numbered(options.out, k)
        tell(save(draw_gas(gas, options.slice), path))
