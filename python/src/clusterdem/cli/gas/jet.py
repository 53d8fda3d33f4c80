"""Make the gas field of a plane turbulent jet upward out of a slot (Görtler's solution).

The jet keeps its momentum, widens by 0.23 of the way (full width at half speed) and slows down as 1/sqrt(z); it draws
gas in from both sides, so that the box must not be periodic along x.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...gas.jet import plane_jet
from ...gas.legacy import write_field
from ..common import positive, tell


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("-o", "--out", type=Path, default=Path("jet.vtk"), metavar="FILE", help="default jet.vtk")
    parser.add_argument(
        "--box", type=float, nargs=4, default=(0.0, 0.3, 0.0, 0.6), metavar=("X0", "X1", "Z0", "Z1"),
        help="extent of the field (m); the nozzle is at Z0 (default 0 0.3 0 0.6)",
    )  # fmt: skip
    parser.add_argument("--grid", type=int, nargs=2, default=(151, 301), metavar=("NX", "NZ"), help="default 151 301")
    parser.add_argument("--slot", type=positive, default=0.02, metavar="B", help="width of the slot (m; default 0.02)")
    parser.add_argument("--speed", type=positive, default=10.0, metavar="U", help="in the slot (m/s; default 10)")
    parser.add_argument("--centre", type=float, metavar="X", help="of the slot (m; default: the middle)")
    parser.add_argument(
        "--coflow", type=float, default=0.0, metavar="W", help="upward, around the jet (m/s; default 0)"
    )
    parser.add_argument("--intensity", type=float, default=0.0, metavar="I", help="r.m.s. fluctuation over velocity")
    parser.add_argument("--ascii", action="store_true", help="numbers as text instead of binary")


def run(options: argparse.Namespace) -> None:
    x0, x1, z0, z1 = options.box
    nx, nz = options.grid
    if not (x0 < x1 and z0 < z1):
        raise InputError("--box", "needs X0 < X1 and Z0 < Z1")
    if nx < 2 or nz < 2:
        raise InputError("--grid", "needs two points or more along x and z")
    if options.intensity < 0:
        raise InputError("--intensity", "must not be negative")
    axes = (np.linspace(x0, x1, nx), np.zeros(1), np.linspace(z0, z1, nz))
    centre = (x0 + x1) / 2 if options.centre is None else options.centre
    gas = plane_jet(axes, options.slot, options.speed, centre, z0, options.coflow, options.intensity)
    tell(write_field(options.out, gas, options.ascii))
