"""A small box resolved and as clusters under the same gas: python bench/truth.py [--seeds 3] [--figure truth.png]

20,000 primary particles in 30 x 3 x 60 mm, the solids fraction of case 1: resolved (inputs/truth/resolved.in), from
200 packed clumps of 100 and from particles at random, and as clusters (inputs/truth/clusters.in) that start where the
clumps do. Prints what both can say, as mean and standard deviation over seeds of start and gas.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from alternate import ROOT
from clusterdem import Frame, Grid, maps_of, read_file
from measured_run import measured_run
from table import head, row

D_P, RHO_P, VOIDAGE = 1e-4, 2000.0, 0.5
BOX = (0.03, 0.003, 0.06)  # a hundredth of case 1's domain
CELLS = (6, 12)  # of the maps, 5 x 5 mm
M_P = np.pi / 6 * D_P**3 * RHO_P


def scatter(rng: np.random.Generator, count: int, gap: float, flat: bool) -> np.ndarray:
    """Points at random in the periodic box, no two nearer than `gap`; in its middle plane if `flat`."""
    box = np.array(BOX)
    shape = np.maximum(1, (box / gap).astype(int))  # bins at least one gap wide
    held: dict[tuple[int, ...], list[np.ndarray]] = {}
    points: list[np.ndarray] = []
    for _ in range(200 * count):
        point = rng.random(3) * box
        if flat:
            point[1] = box[1] / 2
        home = (point / box * shape).astype(int)
        around = {tuple((home + shift) % shape) for shift in product((-1, 0, 1), repeat=3)}
        apart = (other - point for where in around for other in held.get(where, []))
        if all(np.sum((d - box * np.round(d / box)) ** 2) >= gap**2 for d in apart):
            held.setdefault(tuple(home), []).append(point)
            points.append(point)
            if len(points) == count:
                return np.array(points)
    raise ValueError(f"no room for {count} points {gap} m apart")


def clump(rng: np.random.Generator, n: int) -> np.ndarray:
    """Places of n particles around the origin at the voidage of a cluster: face-centred cubic, turned at random."""
    edge = D_P * (4 * np.pi / 6 / (1 - VOIDAGE)) ** (1 / 3)  # four particles in each cube
    reach = int(n ** (1 / 3)) + 2
    corner = np.arange(-reach, reach + 1)
    cubes = np.stack(np.meshgrid(corner, corner, corner), axis=-1).reshape(-1, 3)
    sites = edge * np.concatenate([cubes + shift for shift in ([0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5])])
    nearest = sites[np.argsort(np.sum((sites - rng.random(3) * edge) ** 2, axis=1))[:n]]
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return (nearest - nearest.mean(axis=0)) @ turn


def write_data(path: Path, places: np.ndarray, diameter: float, density: float) -> None:
    """A LAMMPS data file of equal spheres."""
    places = np.mod(places, BOX)
    rows = "".join(
        f"{k} 1 {diameter:.17g} {density} {x:.17g} {y:.17g} {z:.17g}\n" for k, (x, y, z) in enumerate(places, 1)
    )
    bounds = "".join(f"0 {length} {axis}lo {axis}hi\n" for length, axis in zip(BOX, "xyz", strict=True))
    path.write_text(f"equal spheres\n\n{len(places)} atoms\n1 atom types\n{bounds}\nAtoms\n\n{rows}")


def write_starts(folder: Path, seed: int, particles: int = 20_000, n: int = 100) -> None:
    """clusters.data, the same resolved as clumps.data, and as many particles at random, random.data."""
    rng = np.random.default_rng(seed)
    diameter = D_P * (n / (1 - VOIDAGE)) ** (1 / 3)
    centres = scatter(rng, particles // n, diameter + 1.5 * D_P, flat=True)
    write_data(folder / "clusters.data", centres, diameter, RHO_P * (1 - VOIDAGE))
    clumps = np.concatenate([centre + clump(rng, n) for centre in centres])
    write_data(folder / "clumps.data", clumps, D_P, RHO_P)
    write_data(folder / "random.data", scatter(rng, particles // n * n, D_P, flat=False), D_P, RHO_P)


@dataclass(frozen=True)
class Way:
    """One way to compute the box."""

    name: str
    script: str
    data: str
    options: str = ""


WAYS = (
    Way("resolved, from clumps of 100", "resolved", "clumps.data"),
    Way("resolved, at random", "resolved", "random.data"),
    Way("clusters, drag as one body", "clusters", "clusters.data"),
    Way("clusters, drag of their particles", "clusters", "clusters.data", "-var unshielded 1"),
    Way("the same, no events", "clusters", "clusters.data", "-var unshielded 1 -var events no"),
)


def frames_of(way: Way, folder: Path, seed: int, options: str) -> tuple[list[Frame], float]:
    """Frames of one run and its CPU seconds."""
    inputs = ROOT / "inputs/truth"
    arguments = ["-in", str(inputs / f"{way.script}.in"), "-var", "inputs", str(inputs), "-var", "data", way.data]
    run = measured_run(folder, [*arguments, "-var", "seed", str(seed), *way.options.split(), *options.split()])
    paths = sorted(folder.glob(f"{way.script}.*.dump"))
    frames = [frame for path in paths for frame in read_file(path)]
    for path in paths:
        path.unlink()
    return frames, run.seconds


def map_of(frame: Frame) -> np.ndarray:
    """Primary particles per cell; a cluster's go to the cells that it overlaps."""
    grid = Grid(frame.box, *CELLS)
    return maps_of(frame, grid, method="overlap", fractions=False)["mass"] / M_P


def observe(frame: Frame) -> dict[str, float]:
    """What resolved particles and clusters can both say, means over the mass of solids."""
    slip = frame["ug_x"] - frame["vx"], frame["ug_z"] - frame["vz"]
    cells = map_of(frame)
    mean_z = np.average(frame["vz"], weights=frame.mass)
    mean_x = np.average(frame["vx"], weights=frame.mass)
    scatter = np.average((frame["vz"] - mean_z) ** 2 + (frame["vx"] - mean_x) ** 2, weights=frame.mass)
    return {
        "objects": len(frame),
        "v_z of the whole [m/s]": mean_z,
        "slip up, mean [m/s]": np.average(slip[1], weights=frame.mass),
        "|slip|, mean [m/s]": np.average(np.hypot(*slip), weights=frame.mass),
        "velocity scatter, rms [m/s]": scatter**0.5,
        "dispersion": float(cells.var() / cells.mean() / (1 - 1 / cells.size)),
        "densest cell / mean": float(cells.max() / cells.mean()),
    }


def distance(a: np.ndarray, b: np.ndarray) -> float:
    """L1 of two maps: the share of the solids that lies elsewhere."""
    return float(np.abs(a - b).sum() / (a.sum() + b.sum()))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--particles", type=int, default=20_000)
    parser.add_argument("--options", default="", help='for LAMMPS, e.g. "-var tend 0.02"')
    parser.add_argument("--figure", type=Path, help="also draw the maps of the first seed")
    options = parser.parse_args()

    runs: dict[str, list[list[Frame]]] = {way.name: [] for way in WAYS}
    seconds: dict[str, list[float]] = {way.name: [] for way in WAYS}
    for seed in range(1, options.seeds + 1):
        with tempfile.TemporaryDirectory() as name:
            write_starts(Path(name), seed, options.particles)
            for way in WAYS:
                frames, spent = frames_of(way, Path(name), seed, options.options)
                runs[way.name].append(frames)
                seconds[way.name].append(spent)
                print(f"seed {seed}: {way.name}: {spent:.1f} s", flush=True)

    def show(name: str, values: list[list[float]]) -> None:
        cells = [f"{statistics.mean(v):.3g} ± {statistics.stdev(v) if len(v) > 1 else 0:.2g}" for v in values]
        print(row(name, *cells))

    times = [frame.time for frame in runs[WAYS[0].name][0]]
    for k, time in enumerate(times):
        if k not in (0, (len(times) - 1) // 2, len(times) - 1):
            continue
        print("\n" + head(f"t = {time:.3g} s", *(way.name for way in WAYS)))
        observed = {way.name: [observe(frames[k]) for frames in runs[way.name]] for way in WAYS}
        for what in observed[WAYS[0].name][0]:
            show(what, [[o[what] for o in observed[way.name]] for way in WAYS])
        maps = {way.name: [map_of(frames[k]) for frames in runs[way.name]] for way in WAYS}
        truth = maps[WAYS[0].name]
        show("map: L1 to the first", [[distance(a, b) for a, b in zip(maps[w.name], truth, strict=True)] for w in WAYS])
        if options.seeds > 1:
            show(
                "map: L1 to its own of another seed",
                [[distance(maps[w.name][s], maps[w.name][s - 1]) for s in range(options.seeds)] for w in WAYS],
            )
    print()
    show("CPU seconds", [seconds[way.name] for way in WAYS])
    if options.figure:
        draw(options.figure, {way.name: runs[way.name][0] for way in WAYS})


def draw(path: Path, runs: dict[str, list[Frame]]) -> None:
    """The objects at the start, half-way and at the end, to scale."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    from matplotlib.collections import EllipseCollection

    lx, _, lz = BOX
    first = next(iter(runs.values()))
    shown = [0, (len(first) - 1) // 2, len(first) - 1]
    figure, axes = plt.subplots(
        len(shown), len(runs), figsize=(2.6 * len(runs), 4.6 * len(shown)), sharex=True, sharey=True, squeeze=False
    )
    for column, (name, frames) in enumerate(runs.items()):
        for line, k in enumerate(shown):
            ax, frame = axes[line][column], frames[k]
            size = 1e3 * frame.diameter
            centres = np.column_stack([1e3 * frame.x, 1e3 * frame.z])
            ax.add_collection(
                EllipseCollection(size, size, 0 * size, units="xy", offsets=centres, transOffset=ax.transData,
                                  facecolors="0.25", edgecolors="none")
            )  # fmt: skip
            ax.set(xlim=(0, 1e3 * lx), ylim=(0, 1e3 * lz), aspect="equal")
            ax.set_title(f"{name}\n{frame.label}" if line == 0 else frame.label, fontsize=8)
    figure.supxlabel("x (mm)")
    figure.supylabel("z (mm)")
    figure.tight_layout()
    figure.savefig(path, dpi=70)


if __name__ == "__main__":
    main()
