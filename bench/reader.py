"""Read 20 frames of 80,000 clusters and bin their mass on a 30 x 30 grid: this package beside its peers.

    python bench/reader.py [--frames 20] [--clusters 80000] [--rounds 3] [--folder DIR]

Every way runs in a process of its own, one after the other, in as many rounds; the best round counts. Imports are not
counted. Prints seconds, the ratio to this package, peak memory, and whether the map is the same.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

NAMES = "id type x y z vx vy vz diameter mass n".split()
X, Z, MASS = (NAMES.index(name) for name in ("x", "z", "mass"))


def write_frames(folder: Path, frames: int, clusters: int) -> list[Path]:
    """Frames as LAMMPS writes them by default: %g-like numbers, about 115 bytes a row."""
    rng = np.random.default_rng(1)
    paths = []
    for step in range(frames):
        n = rng.integers(3, 2001, clusters)
        block = np.column_stack(
            [np.arange(1, clusters + 1), np.ones(clusters), 0.3 * rng.random(clusters), np.full(clusters, 0.0015)]
            + [
                0.6 * rng.random(clusters),
                *rng.normal(1, 0.3, (3, clusters)),
                1e-4 * np.cbrt(2.0 * n),
                n * 1.0471975511965976e-09,
                n,
            ]
        )
        path = folder / f"bench.{step:07d}.dump"
        head = (
            f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{clusters}\nITEM: BOX BOUNDS pp ff pp\n"
            f"0.0 0.3\n0.0 0.003\n0.0 0.6\nITEM: ATOMS {' '.join(NAMES)}"
        )
        formats = ["%d", "%d"] + ["%.10g"] * 8 + ["%d"]
        np.savetxt(path, block, formats, header=head, comments="")
        paths.append(path)
    return paths


def binned(x: np.ndarray, z: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """Mass on the 30 x 30 grid."""
    cell = np.clip((x / 0.01).astype(int), 0, 29) * 30 + np.clip((z / 0.02).astype(int), 0, 29)
    return np.bincount(cell, mass, 900)


def way_clusterdem() -> Callable[[Path], np.ndarray]:
    from clusterdem import Grid, deposit, read_file

    def read(path: Path) -> np.ndarray:
        (frame,) = read_file(path, ())
        return deposit(Grid(frame.box, 30, 30), frame.x, frame.z).total(frame.mass).ravel()

    return read


def way_clusterdem_all_columns() -> Callable[[Path], np.ndarray]:
    from clusterdem import Grid, deposit, read_file

    def read(path: Path) -> np.ndarray:
        (frame,) = read_file(path)
        return deposit(Grid(frame.box, 30, 30), frame.x, frame.z).total(frame.mass).ravel()

    return read


def way_polars() -> Callable[[Path], np.ndarray]:
    import polars as pl

    def read(path: Path) -> np.ndarray:
        table = pl.read_csv(path, skip_rows=9, has_header=False, separator=" ")
        columns = [table.to_series(i).cast(pl.Float64).to_numpy() for i in range(table.width)]
        return binned(columns[X], columns[Z], columns[MASS])

    return read


def way_polars_three_columns() -> Callable[[Path], np.ndarray]:
    import polars as pl

    def read(path: Path) -> np.ndarray:
        table = pl.read_csv(path, skip_rows=9, has_header=False, separator=" ", columns=[X, Z, MASS])
        x, z, mass = (table.to_series(i).to_numpy() for i in range(3))
        return binned(x, z, mass)

    return read


def way_numpy() -> Callable[[Path], np.ndarray]:
    def read(path: Path) -> np.ndarray:
        values = np.loadtxt(path, skiprows=9)
        return binned(values[:, X], values[:, Z], values[:, MASS])

    return read


def way_numpy_three_columns() -> Callable[[Path], np.ndarray]:
    def read(path: Path) -> np.ndarray:
        x, z, mass = np.loadtxt(path, skiprows=9, usecols=(X, Z, MASS), unpack=True)
        return binned(x, z, mass)

    return read


def way_mdanalysis() -> Callable[[Path], np.ndarray]:
    import warnings

    import MDAnalysis

    warnings.simplefilter("ignore")

    def read(path: Path) -> np.ndarray:
        universe = MDAnalysis.Universe(
            path,
            format="LAMMPSDUMP",
            topology_format="LAMMPSDUMP",
            additional_columns=["mass"],
            lengthunit="m",
            timeunit="s",
        )
        ts = universe.trajectory.ts
        return binned(ts.positions[:, 0].astype(float), ts.positions[:, 2].astype(float), ts.data["mass"].astype(float))

    return read


def way_ovito() -> Callable[[Path], np.ndarray]:
    from ovito.io import import_file

    def read(path: Path) -> np.ndarray:
        particles = import_file(str(path)).compute(0).particles
        position = particles.positions[...]
        return binned(position[:, 0], position[:, 2], particles["Mass"][...])

    return read


WAYS = {name.removeprefix("way_"): way for name, way in list(globals().items()) if name.startswith("way_")}


def measure(name: str, folder: Path) -> None:
    """In a process of its own: time one way and print the result as JSON."""
    import time

    try:
        read = WAYS[name]()
    except ImportError as error:
        print(json.dumps({"missing": str(error)}))
        return
    start = time.perf_counter()
    total = sum(read(path) for path in sorted(folder.glob("bench.*.dump")))
    seconds = time.perf_counter() - start
    peak = next(line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM"))
    print(json.dumps({"seconds": seconds, "peak": int(peak) / 1024, "map": np.asarray(total).tolist()}))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--clusters", type=int, default=80_000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--folder", type=Path)
    parser.add_argument("--one", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        measure(options.one, options.folder)
        return
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or Path(temporary)
        paths = write_frames(folder, options.frames, options.clusters)
        size = sum(path.stat().st_size for path in paths) / 1e6
        print(
            f"{options.frames} frames of {options.clusters:,} clusters, {size:.0f} MB of text, best of {options.rounds}"
        )
        best: dict[str, dict] = {}
        for _ in range(options.rounds):
            for name in WAYS:
                command = [sys.executable, __file__, "--one", name, "--folder", str(folder)]
                done = subprocess.run(command, capture_output=True, text=True)
                result = (
                    json.loads(done.stdout.strip().split("\n")[-1])
                    if done.returncode == 0
                    else {"missing": done.stderr.strip()[-60:]}
                )
                if "missing" in result or result["seconds"] < best.get(name, {}).get("seconds", np.inf):
                    best[name] = result
    ours = best["clusterdem"]
    print(f"{'way':26} {'seconds':>8} {'ratio':>6} {'peak MB':>8}  map")
    for name, result in sorted(best.items(), key=lambda item: item[1].get("seconds", np.inf)):
        if "missing" in result:
            print(f"{name:26} {'-':>8} {'-':>6} {'-':>8}  not measured: {result['missing']}")
            continue
        apart = np.abs(np.array(result["map"]) - ours["map"]).max() / np.max(ours["map"])
        same = "the same" if apart < 1e-12 else f"differs by {apart:.0e} of the largest cell"
        print(
            f"{name:26} {result['seconds']:8.2f} {result['seconds'] / ours['seconds']:6.2f} {result['peak']:8.0f}  {same}"
        )


if __name__ == "__main__":
    main()
