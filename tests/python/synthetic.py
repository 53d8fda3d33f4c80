"""Random clusters and dumps made of them, for tests."""

from __future__ import annotations

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
