"""What gas from a file costs against uniform gas, on the same clusters: python bench/gas_field.py

Case 1's physics without events. Instructions per cluster-step by valgrind's callgrind (2,000 clusters, difference of two
runs), then loop times as ratios to uniform gas (60,000 clusters, median of five turns).
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from alternate import alternate, ratios, write_clusters
from instructions import APART, DRAG, PAIR, TOGETHER, counted
from layer_cost import SCRIPT

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "engine"))
from gas_files import uneven, write_field

LX, LY, LZ = 0.3, 0.003, 0.6
FLAT = np.array([0.0])
STEPS = (50, 150)
GAS = {
    "uniform": "velocity 0 0 2",
    "steady, x-z": "field flat.vtk",
    "steady, x-z, uneven planes": "field uneven.vtk",
    "steady, x-y-z": "field solid.vtk",
    "steady, x-z, density and viscosity": "field rich.vtk",
    "two frames, x-z": "field frame.*.vtk",
}


def flow(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, ...]:
    """Vortices one box long in a rising gas."""
    a, c = 2 * np.pi * x / LX, 2 * np.pi * z / LZ
    return 0.5 * np.sin(a) * np.cos(c), 0 * x, 2 - np.cos(a) * np.sin(c)


def write_fields(folder: Path) -> None:
    """On grids of 301 x 601 points, 1 mm apart, the solid one 101 x 4 x 201."""
    x, z = np.linspace(0, LX, 301), np.linspace(0, LZ, 601)
    write_field(folder / "flat.vtk", (x, FLAT, z), flow)
    write_field(folder / "uneven.vtk", (uneven(0, LX, 301), FLAT, uneven(0, LZ, 601)), flow)
    write_field(folder / "solid.vtk", (x[::3], np.linspace(0, LY, 4), z[::3]), flow)
    write_field(folder / "rich.vtk", (x, FLAT, z), flow, density=1.2, viscosity=1.53e-5)
    for k in range(2):
        write_field(folder / f"frame.{k}.vtk", (x, FLAT, z), flow, time=float(k))


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_fields(folder)
        for title, motion, refresh in (
            ("drag every step", APART, 1),
            ("nve/cluster, drag held for 50 steps", TOGETHER, 50),
        ):
            drag = {gas: DRAG.format(refresh).replace("velocity 0 0 2", words) for gas, words in GAS.items()}
            count = write_clusters(folder / "clusters.data", 2_000)
            for gas, command in drag.items():
                few, many = (sum(counted(folder, motion, command, steps).values()) for steps in STEPS)
                each = (many - few) / (STEPS[1] - STEPS[0]) / count
                print(f"{title}, {gas}: {each:.0f} instructions per cluster-step", flush=True)
            write_clusters(folder / "clusters.data", 60_000)
            scripts = {
                gas: SCRIPT.format(atoms="cluster", motion=motion, pair=PAIR, ours=command, steps=200)
                for gas, command in drag.items()
            }
            for gas, (median, low, high) in ratios(alternate(folder, scripts), "uniform").items():
                print(f"{title}, {gas}: time {median:.2f} ({low:.2f} to {high:.2f})", flush=True)


if __name__ == "__main__":
    main()
