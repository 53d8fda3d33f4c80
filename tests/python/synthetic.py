"""Random clusters and dumps made of them, for tests."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from clusterdem.frame import Box, Frame

BOX = Box((0.0, 0.0, 0.0), (0.3, 0.003, 0.6), (True, False, True))
NAMES = "id x y z vx vy vz diameter mass n l N_st N_cc N_smf ug_x ug_y ug_z fd_x fd_y fd_z Re tau".split()


def random_frame(count: int = 500, step: int = 0, time: float = 0.0, seed: int = 1, box: Box = BOX) -> Frame:
    """Clusters of 3 to 2000 particles anywhere in the box."""
    rng = np.random.default_rng([seed, step])
    n = rng.integers(3, 2001, count).astype(float)
    lx, _, lz = box.lengths
    columns = {
        "id": np.arange(1.0, count + 1),
        "x": box.lo[0] + lx * rng.random(count),
        "y": np.full(count, (box.lo[1] + box.hi[1]) / 2),
        "z": box.lo[2] + lz * rng.random(count),
        "vx": rng.normal(0, 0.3, count),
        "vy": np.zeros(count),
        "vz": rng.normal(1.5, 0.4, count),
        "diameter": 1e-4 * np.cbrt(2 * n),
        "mass": n * np.pi / 6 * 1e-12 * 2000,
        "n": n,
    }
    for name in NAMES:
        columns.setdefault(name, rng.random(count))
    return Frame(step, time, box, columns)


def dump_text(
    frame: Frame, names: list[str] | None = None, *, units: bool = True, time: bool = True, end: str = " \n"
) -> str:
    """A frame as LAMMPS' ``dump custom`` writes it."""
    names = names or NAMES
    flags = " ".join("pp" if periodic else "ff" for periodic in frame.box.periodic)
    head = ["ITEM: UNITS", "si"] if units else []
    head += ["ITEM: TIME", repr(frame.time)] if time else []
    head += ["ITEM: TIMESTEP", str(frame.step), "ITEM: NUMBER OF ATOMS", str(len(frame)), f"ITEM: BOX BOUNDS {flags}"]
    head += [f"{lo!r} {hi!r}" for lo, hi in zip(frame.box.lo, frame.box.hi)]
    head.append("ITEM: ATOMS " + " ".join(names))
    whole = {"id", "n"}
    columns = [[f"{v:.0f}" if name in whole else f"{v:.17g}" for v in frame[name]] for name in names]
    return "\n".join(head) + "\n" + "".join(" ".join(row) + end for row in zip(*columns))


def write_dump(path: Path, frame: Frame, names: list[str] | None = None, **options: bool) -> Path:
    """Write one frame to one file."""
    path.write_text(dump_text(frame, names, **options), encoding="ascii")
    return path


def write_run(folder: Path, frames: int = 3, count: int = 400) -> list[Path]:
    """A small run: one file per frame at 0, 0.01, … s."""
    folder.mkdir(parents=True, exist_ok=True)
    return [
        write_dump(folder / f"case1.{10000 * i:07d}.dump", random_frame(count * (i + 1), 10000 * i, 0.01 * i))
        for i in range(frames)
    ]


SKEW = Box((-0.05, 0.2, -0.3), (0.07, 0.25, 0.7), (True, False, False))
"""A box different in all directions, with its corner off the origin."""


def skew_frame(count: int = 300, step: int = 0, time: float = 0.0, box: Box = SKEW) -> Frame:
    """Clusters that differ in every direction: more of them low, heavy ones to one side, each axis with its own motion."""
    rng = np.random.default_rng([7, step])
    spread = {"x": rng.beta(2, 3, count), "y": rng.beta(1, 2, count), "z": rng.beta(1, 4, count)}
    columns = {axis: low + (high - low) * spread[axis] for axis, low, high in zip("xyz", box.lo, box.hi, strict=True)}
    n = rng.integers(1, 60, count) * (1 + 3 * (columns["x"] > 0.02))
    columns |= {
        "id": rng.permutation(count) + 1.0,
        "type": rng.integers(1, 4, count).astype(float),
        "vx": rng.normal(0.3, 0.1, count),
        "vy": rng.normal(-0.2, 0.5, count),
        "vz": rng.normal(1.0, 0.9, count) + columns["z"],
        "diameter": 1e-3 * np.cbrt(2 * n),
        "mass": n * np.pi / 6 * 1e-9 * 2500,
        "n": n.astype(float),
    }
    return Frame(step, time, box, columns)


SKEW_NAMES = "id type x y z vx vy vz diameter mass n".split()


def write_skew_run(
    folder: Path, counts: list[int], box: Box = SKEW, dt: float = 0.01
) -> tuple[list[Path], list[Frame]]:
    """A run of skew frames, one file each; the frames as they are, in the same order."""
    folder.mkdir(parents=True, exist_ok=True)
    frames = [skew_frame(count, 100 * i, dt * i, box) for i, count in enumerate(counts)]
    return [write_dump(folder / f"skew.{f.step:06d}.dump", f, SKEW_NAMES) for f in frames], frames


def rows_of(path: Path) -> list[dict[str, float]]:
    """A CSV file of numbers."""
    with open(path, newline="") as file:
        return [{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)]
