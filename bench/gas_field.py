"""What gas from a file costs against uniform gas: python bench/gas_field.py

Instructions per cluster-step by valgrind's callgrind (the difference of two runs, so that set-up and reading are left out), on
1,000 clusters that move in case 1's gas without gusts or events.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from alternate import write_clusters
from instructions import APART, DRAG, TOGETHER, counted

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "engine"))
from gas_files import uneven, write_field

STEPS = (20, 80)
LX, LY, LZ = 0.3, 0.003, 0.6
FLAT = np.array([0.0])
GUSTS = "fluctuation 0.75 0 0.75 cell 30 1 30 5e-3 1 "
GAS = {
    "uniform": "velocity 0 0 2",
    "steady, x-z": "field flat.vtk",
    "steady, x-z, uneven planes": "field uneven.vtk",
    "steady, x-z, density and viscosity": "field rich.vtk",
    "steady, x-y-z": "field solid.vtk",
    "between two frames, x-z": "field frame.*.vtk",
}


def flow(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, ...]:
    """Vortices one box long in a rising gas."""
    a, c = 2 * np.pi * x / LX, 2 * np.pi * z / LZ
    return 0.5 * np.sin(a) * np.cos(c), 0 * x, 2 - np.cos(a) * np.sin(c)


def write_fields(folder: Path) -> None:
    """On grids of 151 x 301 points, 2 mm apart, the solid one four planes deep."""
    x, z = np.linspace(0, LX, 151), np.linspace(0, LZ, 301)
    write_field(folder / "flat.vtk", (x, FLAT, z), flow)
    write_field(folder / "uneven.vtk", (uneven(0, LX, 151), FLAT, uneven(0, LZ, 301)), flow)
    write_field(folder / "rich.vtk", (x, FLAT, z), flow, density=1.2, viscosity=1.53e-5)
    write_field(folder / "solid.vtk", (x, np.linspace(0, LY, 4), z), flow)
    for k in range(2):
        write_field(folder / f"frame.{k}.vtk", (x, FLAT, z), flow, time=float(k) - 0.5)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_fields(folder)
        count = write_clusters(folder / "clusters.data", 1_000)
        for title, motion, refresh, kinds in (
            ("drag every step", APART, 1, list(GAS)),
            ("nve/cluster, drag held for 50 steps", TOGETHER, 50, ["uniform", "between two frames, x-z"]),
        ):
            for gas in kinds:
                command = DRAG.format(refresh).replace("velocity 0 0 2", GAS[gas]).replace(GUSTS, "")
                few, many = (sum(counted(folder, motion, command, steps).values()) for steps in STEPS)
                each = (many - few) / (STEPS[1] - STEPS[0]) / count
                print(f"{title}, {gas}: {each:.0f} instructions per cluster-step", flush=True)


if __name__ == "__main__":
    main()
