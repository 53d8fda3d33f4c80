"""Runs variants of a LAMMPS input turn by turn and compares their loop times inside one run of the benchmark.

The machine is shared and noisy: only ratios of times taken side by side mean something, and of those the median.
"""

from __future__ import annotations

import os
import re
import statistics
import subprocess
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
LMP = os.environ.get("CLUSTERDEM_LMP", str(ROOT / "build" / "bin" / "lmp"))
D_P = 1e-4  # diameter of a primary particle [m]


def loop_seconds(folder: Path, script: str, np_: int = 1) -> float:
    """CPU seconds per rank of the time loop of one run of `script` (wall time times the CPU share it got)."""
    (folder / "in.lmp").write_text(script)
    command = [LMP, "-in", "in.lmp", "-log", "none"]
    if np_ > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(np_), *command]
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(
        command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    if done.returncode:
        raise RuntimeError(done.stdout[-2000:] + done.stderr[-2000:])
    wall = float(re.findall(r"Loop time of (\S+)", done.stdout)[-1])
    share = float(re.findall(r"([\d.]+)% CPU use", done.stdout)[-1]) / 100
    return wall * min(share, 1.0)


def alternate(folder: Path, scripts: dict[str, str], rounds: int = 5, np_: int = 1) -> dict[str, list[float]]:
    """Times of every variant, `rounds` of each, taken in turn; the first round warms up and is thrown away."""
    times: dict[str, list[float]] = {name: [] for name in scripts}
    for k in range(rounds + 1):
        for name, script in scripts.items():
            seconds = loop_seconds(folder, script, np_)
            if k:
                times[name].append(seconds)
    return times


def ratios(times: dict[str, list[float]], base: str) -> dict[str, tuple[float, float, float]]:
    """Median, lowest and highest of the ratios of each round to the variant `base`."""
    result = {}
    for name, values in times.items():
        r = [a / b for a, b in zip(values, times[base], strict=True)]
        result[name] = (statistics.median(r), min(r), max(r))
    return result


def write_clusters(path: Path, count: int, n: int = 25, seed: int = 3, lx: float = 0.3, lz: float = 0.6) -> int:
    """A LAMMPS data file of about `count` clusters of n particles in the slab of the cases, none overlapping: a lattice
    with each cluster moved at random inside its own square. Returns how many there are.
    """
    d = D_P * (2 * n) ** (1 / 3)
    nx = round((count * lx / lz) ** 0.5)
    nz = round(count / nx)
    free = 0.98 * 0.5 * (min(lx / nx, lz / nz) - d)
    if free <= 0:
        raise ValueError(f"{count} clusters of {d:.3g} m do not fit")
    rng = np.random.default_rng(seed)
    x, z = np.meshgrid((np.arange(nx) + 0.5) * lx / nx, (np.arange(nz) + 0.5) * lz / nz)
    x = x.ravel() + rng.uniform(-free, free, nx * nz)
    z = z.ravel() + rng.uniform(-free, free, nx * nz)
    order = rng.permutation(nx * nz)
    rows = "".join(f"{k + 1} 1 {d:.17g} 1000 {x[i]:.17g} 0.0015 {z[i]:.17g}\n" for k, i in enumerate(order))
    path.write_text(
        f"clusters of {n} particles\n\n{nx * nz} atoms\n1 atom types\n0 {lx} xlo xhi\n0 0.003 ylo yhi\n0 {lz} zlo zhi\n\n"
        f"Atoms\n\n{rows}"
    )
    return nx * nz
