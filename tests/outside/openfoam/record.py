"""Makes `recorded/` anew: small results of OpenFOAM for the tests that run without it.

usage: record.py
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

import numpy as np
from openfoam_runs import HERE, sampled, set_up, solve, tool

KEPT = {"U", "k", "C"}


def keep(case: Path, target: Path) -> None:
    """The mesh, the dictionaries and the fields that the tests read."""
    for path in sorted(case.rglob("*")):
        name = path.relative_to(case)
        mesh = "polyMesh" in name.parts and path.name in ("points", "faces", "owner", "neighbour", "boundary")
        settings = name.parts[0] == "system" and path.name in ("controlDict", "fvSchemes")
        if path.is_file() and (mesh or settings or path.name in KEPT):
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            data = path.read_bytes()  # collated files have the folder in their header, before what is counted in bytes
            (target / name).write_bytes(data.replace(str(case).encode() + b"/", b"", 1))


def main() -> None:
    recorded = HERE / "recorded"
    shutil.rmtree(recorded, ignore_errors=True)
    with tempfile.TemporaryDirectory() as scratch:
        for layout in ("whole", "processors", "collated"):
            case = set_up("chan", Path(scratch) / layout, ("(40 80 1)", "(12 20 1)"))
            solve(case, layout)
            keep(case, recorded / f"chan_{layout}")
            if layout == "whole":
                rng = np.random.default_rng(18)
                points = np.stack([rng.uniform(0, 0.3, 150), rng.uniform(0, 0.6, 150), np.full(150, 0.005)], axis=1)
                points[:50, 0] = rng.uniform(0, 0.025, 50)  # in the cells along a wall
                found = sampled(case, points, ("U", "k"))
                rows = np.concatenate([points, found["U"], found["k"]], axis=1)
                np.savetxt(
                    recorded / "chan_sampled.txt", rows, "%.9g", header="x y z Ux Uy Uz k, by OpenFOAM's cellPointFace"
                )
        for name, cells in (("hanging", None), ("dual", None), ("wedge", ("(25 60 1)", "(5 6 1)"))):
            case = set_up(name, Path(scratch) / name, cells)
            tool(case, "postProcess", "-func", "writeCellCentres", "-time", "0")
            keep(case, recorded / name)


if __name__ == "__main__":
    main()
