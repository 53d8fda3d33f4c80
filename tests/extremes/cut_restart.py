"""Restart files cut short anywhere: the engine must refuse each with a message, never read it or hang."""

from __future__ import annotations

import random
import re
import subprocess
from pathlib import Path

import scenes
from lammps_run import run

REFUSED = (
    r"Invalid LAMMPS restart file|Incomplete or corrupted LAMMPS restart file|Unexpected end of file|"
    r"Restart file byte ordering is not recognized"
)
OPTIONS = "test end"  # our per-cluster section is in the file, too
GAS = scenes.GAS.replace("cell 8 1 8 4e-4 5", "own 4e-4 5")


def written(folder: Path, np_: int, name: str = "whole.restart") -> Path:
    """A restart file with every section of our fixes."""
    run(folder, scenes.start() + scenes.fixes(options=OPTIONS, gas=GAS) + f"run 200\nwrite_restart {name}\n", np_)
    return folder / name


def lengths(size: int, count: int, seed: int) -> list[int]:
    """Nothing, the ends, and random places between."""
    dice = random.Random(seed)
    fixed = [0, 1, 15, 16, 20, size // 2, size - 17, size - 16, size - 1]
    return fixed + [dice.randrange(size) for _ in range(max(0, count - len(fixed)))]


def fault_when_read(folder: Path, name: str, np_: int = 1) -> str:
    """Return what went wrong: nothing ("") if the file is refused with a known message."""
    try:
        r = run(folder, scenes.again(name, options=OPTIONS, gas=GAS) + "run 0\n", np_, check=False, timeout=60)
    except subprocess.TimeoutExpired:
        return "hangs"
    if r.code == 0:
        return "is read in silence"
    return "" if re.search(REFUSED, r.output) else f"ends with code {r.code}: {r.output[-300:]}"
